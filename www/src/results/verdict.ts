// The verdict on what the user allows, from the interval that contains the distance.
import { element } from "../common/elements.ts";
import { skippedFaces } from "../files/fileNotes.ts";
import type { Allowed } from "../scene/colors/scale.ts";

export type Verdict = "pass" | "fail" | "undecided";

type Interval = readonly [lower: number, upper: number];

/** Returns whether a distance in this interval is allowed: certainly by both, or by neither. */
export function verdictOn([lower, upper]: Interval, { above, below }: Allowed): Verdict {
  if (upper <= Math.min(above, below)) return "pass";
  return lower > Math.max(above, below) ? "fail" : "undecided";
}

const WORDS: Readonly<Record<Verdict, string>> = {
  pass: "certainly within",
  fail: "certainly beyond",
  undecided: "the interval contains it",
};

const input = element("limit", HTMLInputElement);
const inputBelow = element("limit-below", HTMLInputElement);
const output = element("verdict");
const badge = element("badge");
let current: Judged | undefined;

/** What a verdict is about. */
export interface Judged {
  /** The interval that contains the distance. */
  interval: Interval;
  /** The interval for every reading of the files within their gaps. */
  withGaps?: Interval;
  /** The sum of the files' gaps, as text with its unit. */
  gap?: string;
  /** Measured deviations: the extremes of the map, each of which is a deviation that there is. */
  measured?: { lowest: number; highest: number };
}

/** Calls back when the user changes what is allowed. */
export function onLimit(callback: () => void): void {
  for (const one of [input, inputBelow]) {
    one.addEventListener("input", () => {
      draw();
      callback();
    });
  }
}

/** What the user allows; undefined without a number. */
export function allowed(): Allowed | undefined {
  const above = numberOf(input);
  if (above === undefined) return undefined;
  return { above, below: numberOf(inputBelow) ?? above };
}

/** Sets what is allowed, or with `undefined` nothing. */
export function setAllowed(limit: number | undefined): void {
  input.value = limit === undefined ? "" : `${limit}`;
  inputBelow.value = "";
  input.dispatchEvent(new Event("input", { bubbles: true }));
}

/** Shows the verdict on a distance; without one, none. */
export function showVerdict(judged?: Judged): void {
  current = judged;
  draw();
}

/** Adds what the map measured, which can decide where the allowed deviations differ. */
export function addMeasured(measured: NonNullable<Judged["measured"]>): void {
  if (current !== undefined) showVerdict({ ...current, measured });
}

/** Whether a narrower interval would decide. */
export function needsPrecision(): boolean {
  const limits = allowed();
  if (current === undefined || limits === undefined || skippedFaces() > 0) return false;
  const [lower, upper] = current.interval;
  return [limits.above, limits.below].some((limit) => lower <= limit && limit < upper);
}

/** The verdict shown, and its words. */
export function shownVerdict(): { verdict: Verdict | undefined; text: string } {
  return { verdict: output.dataset.verdict as Verdict | undefined, text: output.textContent ?? "" };
}

function draw(): void {
  const limits = allowed();
  if (current === undefined || limits === undefined) {
    output.textContent = "";
    badge.textContent = "";
    for (const node of [output, badge]) delete node.dataset.verdict;
    return;
  }
  const { verdict, text } = judge(current, limits);
  output.textContent = text;
  badge.textContent = verdict.toUpperCase();
  for (const node of [output, badge]) node.dataset.verdict = verdict;
}

function judge(judged: Judged, limits: Allowed): { verdict: Verdict; text: string } {
  const { interval, withGaps = interval, gap = "" } = judged;
  const skipped = skippedFaces();
  if (skipped > 0) return { verdict: "undecided", text: skippedText(skipped) };
  const verdict = verdictOn(interval, limits);
  if (verdict === "undecided") return bySign(judged, limits);
  const isDoubtful = verdictOn(withGaps, limits) !== verdict;
  const doubt = isDoubtful ? `, but the gaps of the files (${gap}) could change that` : "";
  return { verdict, text: `${WORDS[verdict]}${doubt}` };
}

/** The verdict where the interval alone does not decide: by measured deviations beyond a limit. */
function bySign(
  { interval, measured }: Judged,
  limits: Allowed,
): { verdict: Verdict; text: string } {
  if (limits.above === limits.below || measured === undefined) {
    return { verdict: "undecided", text: WORDS.undecided };
  }
  if (measured.highest > limits.above || measured.lowest < -limits.below) {
    return { verdict: "fail", text: "a measured point is beyond" };
  }
  const certain = interval[1] <= Math.max(limits.above, limits.below);
  const text = certain
    ? "within at all measured points, which is certain only for the larger limit"
    : WORDS.undecided;
  return { verdict: "undecided", text };
}

const skippedText = (count: number): string =>
  `${count} ${count === 1 ? "face was" : "faces were"} skipped on reading`;

function numberOf(from: HTMLInputElement): number | undefined {
  const value = from.valueAsNumber;
  return Number.isFinite(value) && value >= 0 ? value : undefined;
}
