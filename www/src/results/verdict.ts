// The verdict on a limit that the user types, from the interval that contains the distance.
import { element } from "../common/elements.ts";

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
let current: readonly [number, number] | undefined;

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

/** Shows the verdict on a distance in this interval; without one, none. */
export function showVerdict(interval?: readonly [number, number]): void {
  current = interval;
  draw();
}

function draw(): void {
  const typed = limit();
  if (current === undefined || typed === undefined) {
    output.textContent = "";
    delete output.dataset.verdict;
    return;
  }
  const verdict = verdictOn(current[0], current[1], typed);
  output.textContent = WORDS[verdict];
  output.dataset.verdict = verdict;
}
