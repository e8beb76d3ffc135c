// The verdict on what the user allows: its controls, and its card.

import { batch, computed, effect, signal } from "@preact/signals-core";
import { element } from "../common/elements.ts";
import { skippedFaces } from "../files/fileNotes.ts";
import type { Allowed } from "../scene/colors/scale.ts";
import { field, onChange, sizeOf } from "../state/store.ts";
import { texts } from "../texts/index.ts";
import type { Side } from "../worker/protocol.ts";
import { comparedText } from "./headline.ts";
import { type Judged, type Judgement, judge, type Verdict } from "./judgement.ts";
import { ownLimit, ownLimits } from "./ownLimits.ts";

const limit = field("limit");
const limitBelow = field("limit-below");
const output = element("verdict");
const badge = element("badge");
const compared = element("compared");
/** What is judged; nothing before it is measured. */
const judged = signal<Judged | undefined>(undefined);
const limits = computed((): Allowed | undefined => {
  const above = sizeOf(limit.value);
  if (above === undefined) return undefined;
  // Whoever types it with its sign means the same.
  const below = sizeOf(limitBelow.value.replace(/^-/, ""));
  return { above, below: below ?? above };
});

// The card follows what is judged and what is allowed.
effect(() => draw(judged.value, limits.value));

/** Calls back when the user changes what is allowed. */
export const onLimit = (callback: () => void): void =>
  onChange(() => [limits.value, ownLimits()], callback);

/** What the user allows; undefined without a number. */
export const allowed = (): Allowed | undefined => limits.value;

/** What the user allows of a face. */
export const allowedOf = (side: Side, face: number): Allowed | undefined => {
  const whole = allowed();
  return whole && (ownLimit(side, face) ?? whole);
};

/** Sets what is allowed, or with `undefined` nothing. */
export function setAllowed(above: number | undefined): void {
  batch(() => {
    limitBelow.set("");
    limit.set(above === undefined ? "" : `${above}`);
  });
}

/** Shows the verdict on a distance; without one, none. */
export function showVerdict(now?: Judged): void {
  judged.value = now;
}

/** Adds the measured faces, which can decide where the allowed deviations differ. */
export function addMeasured(measured: NonNullable<Judged["measured"]>): void {
  const now = judged.peek();
  if (now !== undefined) showVerdict({ ...now, measured });
}

/** Whether a narrower interval would decide. */
export function needsPrecision(): boolean {
  const [now, whole] = [judged.peek(), allowed()];
  if (now === undefined || whole === undefined || skippedFaces() > 0) return false;
  const [lower, upper] = now.interval;
  return [whole, ...ownLimits()]
    .flatMap(({ above, below }) => [above, below])
    .some((limit) => lower <= limit && limit < upper);
}

/** The verdict shown, and its words. */
export function shownVerdict(): { verdict: Verdict | undefined; text: string } {
  const verdict = output.dataset.verdict as Verdict | undefined;
  return { verdict, text: verdict === undefined ? "" : (output.textContent ?? "") };
}

function draw(now: Judged | undefined, whole: Allowed | undefined): void {
  if (now === undefined || whole === undefined) {
    for (const node of [output, badge, compared]) node.textContent = "";
    for (const node of [output, badge]) delete node.dataset.verdict;
    output.dataset.doubt = "false";
    return;
  }
  const { verdict, text, isDoubtful = false } = judgement(now, whole);
  output.textContent = text;
  output.dataset.doubt = `${isDoubtful}`;
  badge.textContent = texts.results.verdicts[verdict];
  const distance = element("distance").textContent ?? "";
  compared.textContent = /\d/.test(distance) ? comparedText(distance, whole, verdict) : "";
  for (const node of [output, badge]) node.dataset.verdict = verdict;
}

function judgement(now: Judged, whole: Allowed): Judgement {
  const skipped = skippedFaces();
  if (skipped > 0) return { verdict: "undecided", text: skippedText(skipped) };
  return judge(now, [whole, ...ownLimits()]);
}

const skippedText = (count: number): string => texts.results.facesWereSkipped(count);
