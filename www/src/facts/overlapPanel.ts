// The volumes that both models have in common and apart, below the facts.

import { effect, signal } from "@preact/signals-core";
import type { Interval, OverlapResult, VolumesUnknown } from "nurbs-hausdorff";
import { element } from "../common/elements.ts";
import type { ReportTable } from "../common/tables.ts";
import { duration } from "../common/text/numbers.ts";
import {
  isNarrow,
  listedQuantity,
  rangeText,
  shownQuantity,
  wholeText,
} from "../common/text/quantities.ts";
import { commonUnit } from "../files/units.ts";
import { texts } from "../texts/index.ts";
import type { OverlapReply } from "../worker/protocol.ts";

/** Seconds where none is typed. */
const SECONDS = 20;
/** Why there are no volumes. */
const UNKNOWN: Record<VolumesUnknown, string> = {
  "a-open": texts.bodies.aIsNotClosedSo,
  "b-open": texts.bodies.bIsNotClosedSo,
  "both-open": texts.bodies.neitherModelIsClosedSo,
  "too-large": texts.bodies.aMeshHasMoreThan,
  "a-volume": texts.bodies.aBodyOfAHas,
  "b-volume": texts.bodies.aBodyOfBHas,
  "a-bodies": texts.bodies.bodiesOfAMeetOr,
  "b-bodies": texts.bodies.bodiesOfBMeetOr,
  "a-crossed": texts.bodies.aBodyOfAMeetsItself,
  "b-crossed": texts.bodies.aBodyOfBMeetsItself,
  refuted: texts.bodies.volumesContradict,
};
/** Why intervals are wider than requested. */
const STOPS: Record<OverlapResult["stop"], string> = {
  converged: "",
  time: texts.bodies.theTimeWasOverMore,
  cells: texts.bodies.theLimitOnPiecesWas,
  precision: texts.bodies.narrowerOnesWouldNeedFiner,
  cancelled: texts.bodies.cancelled,
};

const section = element("overlap");
const seconds = element("overlap-seconds", HTMLInputElement);
const progress = element("overlap-progress", HTMLProgressElement);
const text = element("overlap-text");
const list = element("overlap-list");

export interface OverlapListener {
  /** The user requests the volumes, in at most so many seconds. */
  measure: (maxSeconds: number) => void;
  cancel: () => void;
}

export class OverlapPanel {
  readonly #result = signal<OverlapResult | undefined>(undefined);

  constructor(listener: OverlapListener) {
    // Also in the unit that is shown, and whenever that changes.
    effect(() => this.#draw(this.#result.value));
    element("overlap-start").addEventListener("click", () => {
      const wanted = seconds.valueAsNumber;
      this.clear("", "working");
      listener.measure(Number.isFinite(wanted) && wanted > 0 ? wanted : SECONDS);
    });
    element("overlap-cancel").addEventListener("click", () => listener.cancel());
  }

  show(reply: OverlapReply): void {
    switch (reply.state) {
      case "working":
        progress.value = reply.fraction;
        break;
      case "done":
        this.clear("", "done");
        this.#result.value = reply.result;
        break;
      case "cancelled":
        this.clear(texts.bodies.cancelled);
        break;
      case "failed":
        this.clear(`${reply.message} (${reply.code})`);
        break;
    }
  }

  /** Whether volumes are shown or being measured. */
  get active(): boolean {
    return section.dataset.state !== "idle";
  }

  /** Ends a measurement in progress, whose result will not come. */
  end(): void {
    if (section.dataset.state === "working") this.clear(texts.bodies.cancelled);
  }

  /** Removes what is shown, and says this. */
  clear(message: string, state = "idle"): void {
    section.dataset.state = state;
    progress.value = 0;
    element("overlap-work").hidden = state !== "working";
    this.#result.value = undefined;
    text.textContent = message;
    list.replaceChildren();
  }

  /** What was found; none before it is measured. */
  get result(): OverlapResult | undefined {
    return this.#result.peek();
  }

  /** The volumes with their intervals. */
  get tables(): ReportTable[] {
    const { result } = this;
    if (result === undefined) return [];
    const { volumesUnknown } = result;
    const rows =
      volumesUnknown === undefined
        ? rowsOf(result).map(([name, interval]) => [name, wholeText(interval)])
        : [[UNKNOWN[volumesUnknown], ""]];
    return [{ title: texts.bodies.volumeInCommonAsPlaced, head: ["", ""], rows }];
  }

  #draw(result: OverlapResult | undefined): void {
    if (result === undefined) return;
    const { volumesUnknown, hint, stop, seconds: spent } = result;
    if (volumesUnknown !== undefined) {
      text.textContent = UNKNOWN[volumesUnknown];
      return;
    }
    list.replaceChildren(...rowsOf(result).flatMap(([name, interval]) => row(name, interval)));
    const ends = [STOPS[stop], hint ?? "", texts.bodies.measuredIn(duration(spent.solve))];
    text.textContent = ends.filter((end) => end !== "").join(" ");
  }
}

/** The volumes in the unit shown, and their ratio. */
function rowsOf({ volumes, ratio }: OverlapResult): [name: string, interval: Interval][] {
  if (volumes === undefined || ratio === undefined) return [];
  const unit = commonUnit();
  const cubic = (name: string, volume: Interval): [string, Interval] => [
    unit === undefined ? name : `${name}, ${unit}³`,
    shownQuantity(volume, 3),
  ];
  return [
    cubic(texts.bodies.inCommon, volumes.intersection),
    cubic(texts.bodies.ofAAlone, volumes.onlyA),
    cubic(texts.bodies.ofBAlone, volumes.onlyB),
    cubic(texts.bodies.together, volumes.union),
    [texts.bodies.inCommonTogether, ratio],
  ];
}

/** A term with a number that the interval holds, and the interval. */
function row(name: string, interval: Interval): HTMLElement[] {
  const [term, number, range] = [
    document.createElement("dt"),
    document.createElement("dd"),
    document.createElement("span"),
  ];
  term.textContent = name;
  range.className = "range";
  range.textContent = rangeText(interval);
  // A number of a wide interval would say more than is known.
  number.append(
    interval.lower > 0 && isNarrow(interval) ? `${listedQuantity(interval)} ` : "",
    range,
  );
  return [term, number];
}
