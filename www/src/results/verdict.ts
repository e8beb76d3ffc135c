// The verdict on what the user allows: its controls, and its card.
import { element } from "../common/elements.ts";
import { skippedFaces } from "../files/fileNotes.ts";
import type { Allowed } from "../scene/colors/scale.ts";
import type { Side } from "../worker/protocol.ts";
import { comparedText } from "./headline.ts";
import { type Judged, type Judgement, judge, type Verdict } from "./judgement.ts";
import { onOwnLimits, ownLimit, ownLimits } from "./ownLimits.ts";

const input = element("limit", HTMLInputElement);
const inputBelow = element("limit-below", HTMLInputElement);
const output = element("verdict");
const badge = element("badge");
const compared = element("compared");
let current: Judged | undefined;

/** Calls back when the user changes what is allowed. */
export function onLimit(callback: () => void): void {
  for (const one of [input, inputBelow]) {
    one.addEventListener("input", () => {
      draw();
      callback();
    });
  }
  onOwnLimits(() => {
    draw();
    callback();
  });
}

/** What the user allows; undefined without a number. */
export function allowed(): Allowed | undefined {
  const above = numberOf(input);
  if (above === undefined) return undefined;
  return { above, below: numberOf(inputBelow) ?? above };
}

/** What the user allows of a face. */
export const allowedOf = (side: Side, face: number): Allowed | undefined => {
  const whole = allowed();
  return whole && (ownLimit(side, face) ?? whole);
};

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

/** Adds the measured faces, which can decide where the allowed deviations differ. */
export function addMeasured(measured: NonNullable<Judged["measured"]>): void {
  if (current !== undefined) showVerdict({ ...current, measured });
}

/** Whether a narrower interval would decide. */
export function needsPrecision(): boolean {
  const limits = allowed();
  if (current === undefined || limits === undefined || skippedFaces() > 0) return false;
  const [lower, upper] = current.interval;
  return [limits, ...ownLimits()]
    .flatMap(({ above, below }) => [above, below])
    .some((limit) => lower <= limit && limit < upper);
}

/** The verdict shown, and its words. */
export function shownVerdict(): { verdict: Verdict | undefined; text: string } {
  const verdict = output.dataset.verdict as Verdict | undefined;
  return { verdict, text: verdict === undefined ? "" : (output.textContent ?? "") };
}

function draw(): void {
  const limits = allowed();
  if (current === undefined || limits === undefined) {
    for (const node of [output, badge, compared]) node.textContent = "";
    for (const node of [output, badge]) delete node.dataset.verdict;
    output.dataset.doubt = "false";
    return;
  }
  const { verdict, text, isDoubtful = false } = judgement(current, limits);
  output.textContent = text;
  output.dataset.doubt = `${isDoubtful}`;
  badge.textContent = verdict.toUpperCase();
  const distance = element("distance").textContent ?? "";
  compared.textContent = /\d/.test(distance) ? comparedText(distance, limits, verdict) : "";
  for (const node of [output, badge]) node.dataset.verdict = verdict;
}

function judgement(judged: Judged, limits: Allowed): Judgement {
  const skipped = skippedFaces();
  if (skipped > 0) return { verdict: "undecided", text: skippedText(skipped) };
  return judge(judged, [limits, ...ownLimits()]);
}

const skippedText = (count: number): string =>
  `${count} ${count === 1 ? "face was" : "faces were"} skipped on reading`;

function numberOf(from: HTMLInputElement): number | undefined {
  const value = from.valueAsNumber;
  return Number.isFinite(value) && value >= 0 ? value : undefined;
}
