// The panel of results: distance, interval and details, or an error. The
// section's data attributes hold the same for tests and other programs.

import type { DistanceResult } from "nurbs-hausdorff";
import { agrees, farthestSide } from "../common/direction.ts";
import { element, make } from "../common/elements.ts";
import { placeName } from "../common/text/names.ts";
import {
  certifiedText,
  intervalText,
  shownLength,
  twoDigits,
  upperText,
} from "../common/text/numbers.ts";
import { skippedFaces } from "../files/fileNotes.ts";
import { commonUnit } from "../files/units.ts";
import { texts } from "../texts/index.ts";
import { type Detail, detailsOf } from "./resultDetails.ts";
import { showVerdict } from "./verdict.ts";

/** What stands for a distance that is not known. */
const NONE = "–";
/** The meaning of the interval shown. */
const SO_FAR = texts.results.certifiedSoFar;
const STALLED = texts.results.narrowsSlowlyMayTakeLong;
/** The note on the interval of a cancelled measurement. */
const REACHED = texts.results.cancelledContainsTheDistance;

/** The two directions are computed in turn, each with an interval of its own. */
const ONE_DIRECTION = texts.results.oneDirectionSoFar;

const section = element("result");
const kind = element("kind");
const unit = element("unit");
const distance = element("distance");
const interval = element("interval");
const width = element("width");
const progress = element("progress", HTMLProgressElement);
const error = element("error");
const details = element("facts");
const where = element("where");
const stateText = element("state-text");
let look: () => void = () => {};

/** Shows that a new measurement of the same models was requested. */
export function showPending(): void {
  section.dataset.state = "working";
  progress.value = 0;
}

/** Shows the fraction of the work done, and the interval so far if the method has one. */
export function showWorking(
  fraction: number,
  current: [number, number] | undefined,
  diagonal: number,
  { symmetric, stalled }: { symmetric: boolean; stalled: boolean },
): void {
  progress.value = fraction;
  // The result is there, and its colours are being computed.
  if (section.dataset.state === "colouring") return;
  section.dataset.state = "working";
  if (current === undefined) return;
  const note = symmetric ? ONE_DIRECTION : SO_FAR;
  showInterval(current[0], current[1], diagonal, note);
  if (stalled) width.textContent += STALLED;
}

/**
 * Shows a result; `last` states that no newer measurement was requested, `pending` that
 * its colours follow.
 */
export function showResult(
  result: DistanceResult,
  { last, pending }: { last: boolean; pending: boolean },
): void {
  kind.textContent = kindOf(result);
  section.classList.remove("undistanced");
  stateText.textContent = "";
  unit.textContent = commonUnit() ?? texts.results.modelUnits;
  const ends = [result.lower, result.upper] as const;
  distance.textContent = certifiedText(result.computed, ends, result.diagonal);
  showInterval(result.lower, result.upper, result.diagonal, meaning(result, last));
  const { withGaps } = result;
  showVerdict({
    interval: ends,
    withGaps: [withGaps.lower, withGaps.upper],
    gap: gapText(result),
  });
  showDetails(details, detailsOf(result));
  const { a, b } = result.witness;
  showWhere(result);
  element("doubts").textContent = doubtsText(result);
  Object.assign(section.dataset, {
    method: result.method,
    computed: result.computed,
    lower: result.lower,
    upper: result.upper,
    converged: result.converged,
    a: a.point.join(" "),
    b: b.point.join(" "),
    from: farthestSide(result),
    state: stateOf(last, pending),
  });
}

/** Shows where the distance is attained: a link to the place, where there is one. */
function showWhere(result: DistanceResult): void {
  const text = whereText(result);
  where.title = text;
  if (agrees(result)) {
    where.textContent = text;
    return;
  }
  const link = document.createElement("button");
  link.type = "button";
  link.className = "link";
  // A button does not cut its own text off.
  link.append(make("span", text));
  link.addEventListener("click", () => look());
  where.replaceChildren(link);
}

/** Calls back when the user follows the link to the farthest place. */
export function onWhere(callback: () => void): void {
  look = callback;
}

/** Where the distance is attained. */
function whereText(result: DistanceResult): string {
  // Between models that agree, no place is farther than another.
  if (agrees(result)) {
    const skipped = skippedFaces();
    const left = skipped > 0 ? texts.results.butFacesAreLeftOut(skipped) : "";
    return texts.results.theModelsAgreeNoPlace + left;
  }
  const { a, b } = result.witness;
  const fromA = farthestSide(result) === "a";
  const [onA, onB] = [`A ${placeName(a)}`, `B ${placeName(b)}`];
  const [from, to] = fromA ? [onA, onB] : [onB, onA];
  return texts.results.farthestFrom(from, to);
}

/** What the interval leaves open: the gaps of the files, and faces that were skipped. */
function doubtsText(result: DistanceResult): string {
  const { withGaps, gap, diagonal } = result;
  const skipped = skippedFaces();
  const parts = [
    ...(gap > 0
      ? [
          texts.results.gapsOfTheFilesUp(
            gapText(result),
            intervalText(Math.max(0, withGaps.lower), withGaps.upper, diagonal),
          ),
        ]
      : []),
    ...(skipped > 0 ? [texts.results.skippedOnReading(skipped)] : []),
  ];
  return parts.join("; ");
}

/** The gap of both files, with its unit and whether it is proven. */
function gapText({ gap, gapProven }: DistanceResult): string {
  const known = commonUnit();
  return `${upperText(shownLength(gap))}${known === undefined ? "" : ` ${known}`}${gapProven ? "" : texts.results.measured}`;
}

function stateOf(last: boolean, pending: boolean): string {
  if (!last) return "live";
  return pending ? "colouring" : "done";
}

/** The result's states without a distance, and what the card says of each. */
const CLEARED = {
  asked: texts.results.waitingForTheFilesOf,
  cancelled: texts.results.cancelled,
  failed: texts.results.failed,
  lone: texts.results.oneFileIsOpenDrop,
  paused: texts.results.notMeasuredWhileClearanceAnd,
  working: texts.results.measuring,
};

/**
 * Clears the result: the measurement was cancelled or failed, the models are new, or their
 * clearance is measured instead.
 */
export function clearResult(state: keyof typeof CLEARED): void {
  kind.textContent = texts.results.distance;
  distance.textContent = NONE;
  interval.textContent = CLEARED[state];
  stateText.textContent = CLEARED[state];
  width.textContent = "";
  showVerdict();
  details.replaceChildren();
  for (const node of [where, element("doubts")]) node.textContent = "";
  for (const name of ["method", "computed", "lower", "upper", "converged", "a", "b", "from"]) {
    delete section.dataset[name];
  }
  section.dataset.state = state;
  section.classList.toggle("undistanced", state !== "working");
}

/** Shows the interval that a cancelled measurement had reached. */
export function showReached([lower, upper]: readonly [number, number], diagonal: number): void {
  showInterval(lower, upper, diagonal, REACHED);
  stateText.textContent = texts.results.reachedIn(REACHED, intervalText(lower, upper, diagonal));
  Object.assign(section.dataset, { lower, upper });
}

export function showError(code: string, message: string): void {
  error.hidden = false;
  error.dataset.code = code;
  error.textContent = `${message} (${code})`;
}

export function hideError(): void {
  error.hidden = true;
  delete error.dataset.code;
}

function showInterval(lower: number, upper: number, diagonal: number, note: string): void {
  interval.textContent = intervalText(lower, upper, diagonal);
  width.textContent = texts.results.width(note, twoDigits(shownLength(upper - lower)));
  // One direction's interval decides nothing about the larger of both.
  showVerdict(note === ONE_DIRECTION ? undefined : { interval: [lower, upper] });
}

/** The meaning of the interval. It contains the distance whether the method converged or not. */
function meaning({ method, converged }: DistanceResult, last: boolean): string {
  if (method !== "certified" || converged) return texts.results.containsTheDistance;
  return last ? texts.results.certifiedWiderThanTheTolerance : SO_FAR;
}

/** The kind of the distance, and the direction in which it is attained. */
function kindOf(result: DistanceResult): string {
  const [from, to] = farthestSide(result) === "a" ? ["A", "B"] : ["B", "A"];
  const kind = result.forward === undefined ? texts.results.directed : texts.results.symmetric;
  return texts.results.distanceTo(kind, from, to);
}

/** Fills a list with terms and texts. */
export function showDetails(list: HTMLElement, all: Detail[]): void {
  list.replaceChildren(
    ...all.flatMap(([term, text]) => [definition("dt", term), definition("dd", text)]),
  );
}

/** A term or text in which the letters after `_` become a subscript. */
function definition(name: "dt" | "dd", text: string): HTMLElement {
  const node = document.createElement(name);
  const [before = "", below, after = ""] = text.split(/_(\w+)/);
  node.append(before);
  if (below !== undefined) {
    const sub = document.createElement("sub");
    sub.textContent = below;
    node.append(sub, after);
  }
  return node;
}
