// The verdict on a limit that the user types, from the interval that contains the distance.
import { element } from "../common/elements.ts";
import { skippedFaces } from "../files/fileNotes.ts";

export type Verdict = "pass" | "fail" | "undecided";

/** Returns whether a distance in this interval is at most the limit. */
export function verdictOn(lower: number, upper: number, limit: number): Verdict {
  if (upper <= limit) return "pass";
  return lower > limit ? "fail" : "undecided";
}

const WORDS: Readonly<Record<Verdict, string>> = {
  pass: "✓ pass: certainly within",
  fail: "✗ fail: certainly beyond",
  undecided: "? undecided: the interval contains it",
};

const input = element("limit", HTMLInputElement);
const output = element("verdict");
let current: Judged | undefined;

/** What a verdict is about. */
export interface Judged {
  /** The interval that contains the distance. */
  interval: readonly [lower: number, upper: number];
  /** The interval for every reading of the files within their gaps. */
  withGaps?: readonly [lower: number, upper: number];
  /** The sum of the files' gaps, as text with its unit. */
  gap?: string;
}

/** Calls back when the user changes the limit. */
export function onLimit(callback: () => void): void {
  input.addEventListener("input", () => {
    draw();
    callback();
  });
}

/** The limit that the user typed; undefined without one. */
export function limit(): number | undefined {
  const value = input.valueAsNumber;
  return Number.isFinite(value) && value >= 0 ? value : undefined;
}

/** Shows the verdict on a distance; without one, none. */
export function showVerdict(judged?: Judged): void {
  current = judged;
  draw();
}

function draw(): void {
  const typed = limit();
  if (current === undefined || typed === undefined) {
    output.textContent = "";
    delete output.dataset.verdict;
    return;
  }
  const { interval, withGaps = interval, gap = "" } = current;
  const skipped = skippedFaces();
  const verdict = skipped > 0 ? "undecided" : verdictOn(...interval, typed);
  output.textContent = skipped > 0 ? skippedText(skipped) : WORDS[verdict];
  if (verdict !== "undecided" && verdictOn(...withGaps, typed) !== verdict) {
    output.textContent += `, but the gaps of the files (${gap}) could change that`;
  }
  output.dataset.verdict = verdict;
}

const skippedText = (count: number): string =>
  `? undecided: ${count} ${count === 1 ? "face was" : "faces were"} skipped on reading`;
