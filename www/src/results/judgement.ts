// What follows for a verdict from the interval of the distance and from measured faces.

import { FLOAT32_STEP } from "../common/float32.ts";
import type { Allowed } from "../scene/colors/scale.ts";
import { texts } from "../texts/index.ts";
import type { MeasuredFace } from "../worker/map/places.ts";

export type Verdict = "pass" | "fail" | "undecided";

export type Interval = readonly [lower: number, upper: number];

/** The verdict with its reason. */
export interface Judgement {
  verdict: Verdict;
  text: string;
  /** Whether something that the interval does not hold could change the verdict. */
  isDoubtful?: boolean;
}

/** What a verdict is about. */
export interface Judged {
  /** The interval that contains the distance. */
  interval: Interval;
  /** The interval for every reading of the files within their gaps. */
  withGaps?: Interval;
  /** The sum of the files' gaps, as text with its unit. */
  gap?: string;
  /** What points of the faces deviate by at least, and what is allowed of each. */
  measured?: readonly { name: string; face: MeasuredFace; allowed: Allowed }[];
}

const WORDS: Readonly<Record<Verdict, string>> = {
  pass: texts.results.certainlyWithin,
  fail: texts.results.certainlyBeyond,
  undecided: texts.results.theIntervalContainsIt,
};

/** Whether a distance in this interval is allowed: certainly by all limits, or by none. */
export function verdictOn([lower, upper]: Interval, limits: readonly Allowed[]): Verdict {
  const all = limits.flatMap(({ above, below }) => [above, below]);
  if (upper <= Math.min(...all)) return "pass";
  return lower > Math.max(...all) ? "fail" : "undecided";
}

/** Whether deviations of a face are more than is allowed of it, whatever float32 rounds. */
export function exceeds(
  { lowest, highest, distance }: MeasuredFace,
  { above, below }: Allowed,
): boolean {
  const least = 1 - FLOAT32_STEP;
  return (
    highest * least > above || -lowest * least > below || distance * least > Math.max(above, below)
  );
}

/** Judges by the limits of the whole, and of faces that have their own. */
export function judge(judged: Judged, limits: readonly Allowed[]): Judgement {
  const { interval, withGaps = interval, gap = "" } = judged;
  const verdict = verdictOn(interval, limits);
  if (verdict === "undecided") return byFaces(judged, limits);
  const isDoubtful = verdictOn(withGaps, limits) !== verdict;
  const doubt = isDoubtful ? texts.results.butTheGapsOfThe(gap) : "";
  return { verdict, text: `${WORDS[verdict]}${doubt}`, isDoubtful };
}

/** The verdict where the interval alone does not decide: by measured deviations beyond a limit. */
function byFaces({ interval, measured }: Judged, limits: readonly Allowed[]): Judgement {
  const all = limits.flatMap(({ above, below }) => [above, below]);
  if (all.every((limit) => limit === all[0]) || measured === undefined) {
    return { verdict: "undecided", text: WORDS.undecided };
  }
  const beyond = measured.find(({ face, allowed }) => exceeds(face, allowed));
  if (beyond !== undefined) {
    return { verdict: "fail", text: texts.results.aMeasuredPointIsBeyond(beyond.name) };
  }
  const text =
    interval[1] <= Math.max(...all)
      ? texts.results.withinAtAllMeasuredPoints
      : texts.results.withinAtAllNoMore;
  return { verdict: "undecided", text };
}
