// The panel of clearance and clash: the least distance, and the faces that come near each other.

import type { ClearanceResult, FaceGap, GapsResult } from "nurbs-hausdorff";
import { element, fillList } from "../common/elements.ts";
import type { ReportTable } from "../common/tables.ts";
import { placeName } from "../common/text/names.ts";
import { certifiedText, intervalText } from "../common/text/numbers.ts";
import { commonUnit } from "../files/units.ts";
import { texts } from "../texts/index.ts";
import type { ClearanceReply } from "../worker/protocol.ts";

/** Pairs listed; more are counted. */
const MAX_PAIRS = 30;

const section = element("clearance");
const start = element("clearance-start", HTMLButtonElement);
const end = element("clearance-end", HTMLButtonElement);
const below = element("below", HTMLInputElement);
const text = element("clearance-text");
const list = element("gap-list");

/** Whether models clash: they overlap, or their boundaries meet. */
export type Meeting = "apart" | "touching" | "clash";

/** What the view shows of a clearance. */
export interface ShownClearance {
  clearance: ClearanceResult;
  gaps: GapsResult | undefined;
  meeting: Meeting;
}

/** A clearance with what is said of it. */
export interface FoundClearance extends ShownClearance {
  text: string;
}

export interface ClearanceListener {
  /** The user turned the mode on or off, or changed the distance. */
  change: () => void;
  /** The user selected a pair of faces. */
  select: (gap: FaceGap) => void;
}

export class ClearancePanel {
  readonly #listener: ClearanceListener;
  #shown: ShownClearance | undefined;

  constructor(listener: ClearanceListener) {
    this.#listener = listener;
    start.addEventListener("click", () => this.#turn(!this.active));
    end.addEventListener("click", () => this.end());
    below.addEventListener("input", () => {
      if (this.active) listener.change();
    });
  }

  /** Whether clearances are measured instead of deviations. */
  get active(): boolean {
    return start.getAttribute("aria-pressed") === "true";
  }

  /** The distance below which pairs of faces are listed. */
  get below(): number {
    const value = below.valueAsNumber;
    return Number.isFinite(value) && value >= 0 ? value : 0;
  }

  /** What is found, while it is shown: for the report and the JSON in place of a deviation. */
  get found(): FoundClearance | undefined {
    if (this.#shown === undefined) return undefined;
    const { clearance, gaps, meeting } = this.#shown;
    return { clearance, gaps, meeting, text: sentence(clearance, meeting) };
  }

  /** The least distance, and the pairs of faces that come near each other, while they are shown. */
  get tables(): ReportTable[] {
    if (this.#shown === undefined) return [];
    const { clearance, gaps, meeting } = this.#shown;
    const { lower, upper, diagonal } = clearance;
    const pairs = gaps?.pairs.slice(0, MAX_PAIRS) ?? [];
    const rows = [
      [sentence(clearance, meeting), intervalText(lower, upper, diagonal)],
      ...pairs.map(({ lower, upper, witness: { a, b } }) => [
        texts.bodies.aAndB(placeName(a), placeName(b)),
        intervalText(lower, upper, diagonal),
      ]),
    ];
    const head = [texts.report.faces, texts.bodies.distanceIn(commonUnit())];
    return [{ title: texts.bodies.clearanceAndClash, head, rows }];
  }

  /** Ends the mode. */
  end(): void {
    if (this.active) this.#turn(false);
  }

  #turn(on: boolean): void {
    start.setAttribute("aria-pressed", `${on}`);
    start.textContent = on ? texts.bodies.end : texts.bodies.measure;
    // Where the panel's part is folded away, the card ends it too.
    end.hidden = !on;
    section.dataset.state = on ? "working" : "idle";
    if (!on) this.#clear("");
    this.#listener.change();
  }

  /** Shows that a new measurement was requested. */
  showPending(): void {
    section.dataset.state = "working";
  }

  /** Shows a reply, and returns what the view shows of it. */
  show(reply: ClearanceReply): ShownClearance | undefined {
    if (reply.state !== "done") {
      section.dataset.state = reply.state;
      this.#clear(
        reply.state === "failed" ? `${reply.message} (${reply.code})` : texts.bodies.cancelledHere,
      );
      return undefined;
    }
    const { clearance, gaps } = reply;
    const meeting = meetingOf(clearance);
    section.dataset.state = "done";
    section.dataset.meeting = meeting;
    text.textContent = sentence(clearance, meeting);
    const pairs = gaps?.pairs ?? [];
    fillList(list, pairs, MAX_PAIRS, (pair) => this.#row(pair, clearance.diagonal));
    this.#shown = { clearance, gaps, meeting };
    return this.#shown;
  }

  #clear(message: string): void {
    this.#shown = undefined;
    delete section.dataset.meeting;
    text.textContent = message;
    list.replaceChildren();
  }

  #row(pair: FaceGap, diagonal: number): HTMLElement {
    const [item, button] = [document.createElement("li"), document.createElement("button")];
    button.type = "button";
    const { a, b } = pair.witness;
    for (const [letter, point] of [
      ["a", a],
      ["b", b],
    ] as const) {
      const badge = document.createElement("b");
      badge.className = letter;
      badge.textContent = letter.toUpperCase();
      button.append(badge, ` ${placeName(point)} `);
    }
    const size = document.createElement("span");
    size.className = "size";
    size.textContent = intervalText(pair.lower, pair.upper, diagonal);
    button.append(size);
    button.addEventListener("click", () => this.#listener.select(pair));
    item.append(button);
    return item;
  }
}

function meetingOf({ overlap, lower, upper, tolerance }: ClearanceResult): Meeting {
  if (overlap?.kind === "intersecting" || overlap?.kind === "contained") return "clash";
  return lower === 0 && upper <= tolerance ? "touching" : "apart";
}

function sentence(result: ClearanceResult, meeting: Meeting): string {
  const { overlap, lower, upper, diagonal, witness, gap, withGaps } = result;
  if (meeting === "clash") {
    return overlap?.kind === "contained"
      ? texts.bodies.clashAPartOfOne
      : texts.bodies.clashThePartsCertainlyOverlap;
  }
  const unit = commonUnit();
  const size = certifiedText(upper, [lower, upper], diagonal);
  const places = texts.bodies.aAndB(placeName(witness.a), placeName(witness.b));
  if (meeting === "touching")
    return texts.bodies.touchingOrCrossing(places, size, unit ? ` ${unit}` : "");
  // The files leave open what the models of both are, by their gaps.
  const open =
    gap > 0
      ? texts.bodies.withTheGapsOfThe(
          intervalText(Math.max(0, withGaps.lower), withGaps.upper, diagonal),
        )
      : "";
  return texts.bodies.apartByIn(
    size,
    unit ? ` ${unit}` : "",
    intervalText(lower, upper, diagonal),
    open,
    places,
  );
}
