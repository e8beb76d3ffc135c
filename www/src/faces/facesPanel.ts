// The panel of changed faces: the limit, the comparison's progress, counts and list.

import type { DiffResult } from "nurbs-hausdorff";
import { element } from "../common/elements.ts";
import type { ReportTable } from "../common/tables.ts";
import { duration, grouped } from "../common/text/numbers.ts";
import { modelUnit } from "../files/units.ts";
import { ownLimits } from "../results/ownLimits.ts";
import { allowed, onLimit } from "../results/verdict.ts";
import { texts } from "../texts/index.ts";
import { type DiffReply, type PlacedPart, SIDES, type Side } from "../worker/protocol.ts";
import { type Change, changesOf, countsOf, facesOf } from "./changes.ts";
import { FaceList } from "./faceList.ts";
import { isOfSamePlace, kindsOf } from "./kinds.ts";
import { partTables, showParts } from "./partList.ts";

/** The limit proposed where nothing is allowed yet, as a fraction of the diagonal. */
const RELATIVE_LIMIT = 1e-5;

/** Milliseconds after which a limit that is typed is compared by. */
const PAUSE = 300;

/** What the colours of compared faces mean. */
const COLORS = texts.faces.colourNote;

const section = element("faces");
const limit = element("face-limit", HTMLInputElement);
const compare = element("compare", HTMLButtonElement);
const progress = element("compare-progress", HTMLProgressElement);
const cancel = element("compare-cancel", HTMLButtonElement);
const summary = element("face-summary");
const shownRow = element("faces-shown");
const shownSide = element("faces-side", HTMLSelectElement);
const clear = element("faces-clear", HTMLButtonElement);

export interface FacesListener {
  /** The user requests a comparison with this limit. */
  compare: (limit: number) => void;
  cancel: () => void;
  /** The result to show in the view, or none, of one model or of both. */
  show: (result: DiffResult | undefined, side?: Side) => void;
  /** The face to show in the view, or none. */
  select: (change: Change | undefined) => void;
  /** What became of parts, for the tree; none without a comparison. */
  mark: (parts: readonly PlacedPart[]) => void;
  /** The part to look at alone, or all again. */
  look: (part: PlacedPart | undefined) => void;
}

export class FacesPanel {
  readonly #listener: FacesListener;
  readonly #list: FaceList;
  #result: DiffResult | undefined;
  #diagonal = 0;
  /** Whether the user has typed a limit for these models; else it is what is allowed. */
  #isTyped = false;
  /** Whether the models have not been compared yet. */
  #isNew = true;
  #timer = 0;
  #parts: readonly PlacedPart[] = [];
  /** Whether a part is shown alone. */
  #isOfPart = false;

  constructor(listener: FacesListener) {
    this.#listener = listener;
    this.#list = new FaceList(element("face-list"), element("face-more"), listener.select);
    compare.addEventListener("click", () => {
      if (limit.reportValidity()) listener.compare(limit.valueAsNumber);
    });
    limit.addEventListener("input", () => {
      this.#isTyped = limit.value !== "";
      this.#compareAgain();
    });
    onLimit(() => {
      this.#proposeLimit();
      this.#compareAgain();
    });
    shownSide.addEventListener("input", () => this.#showSide());
    limit.addEventListener("keydown", ({ key }) => {
      if (key === "Enter") compare.click();
    });
    cancel.addEventListener("click", () => listener.cancel());
    clear.addEventListener("click", () => this.clear("idle", ""));
  }

  /** Proposes a limit for new models of this size. */
  propose(diagonal: number): void {
    this.#diagonal = diagonal;
    this.#isTyped = false;
    this.#isNew = true;
    this.#proposeLimit();
  }

  /** Proposes the smaller deviation of those allowed on either side, or one digit for the models' size. */
  #proposeLimit(): void {
    if (this.#isTyped) return;
    const { above, below } = allowed() ?? { above: 0, below: 0 };
    const smaller = Math.min(above, below);
    if (smaller > 0) limit.value = `${smaller}`;
    else if (this.#diagonal > 0)
      limit.value = `${Number((RELATIVE_LIMIT * this.#diagonal).toPrecision(1))}`;
  }

  /** Compares again where what is shown is by another limit: a list never outlives its limit. */
  #compareAgain(): void {
    clearTimeout(this.#timer);
    if (!this.active || !limit.checkValidity()) return;
    if (limit.valueAsNumber === this.#result?.limit && ownLimits().length === 0) return;
    this.#timer = window.setTimeout(() => {
      if (this.active && limit.checkValidity()) this.#listener.compare(limit.valueAsNumber);
    }, PAUSE);
  }

  /** Draws the faces of the model that was chosen, or of both. */
  #showSide(): void {
    this.#list.select(undefined);
    const { value } = shownSide;
    this.#listener.show(this.#result, value === "both" ? undefined : (value as Side));
  }

  /** The comparison shown. */
  get result(): DiffResult | undefined {
    return this.#result;
  }

  /** What became of the parts that are not the same. */
  get tables(): ReportTable[] {
    return partTables(this.#parts, this.#diagonal);
  }

  /** Whether a comparison is shown or in progress. */
  get active(): boolean {
    return section.dataset.state === "done" || section.dataset.state === "working";
  }

  show(reply: DiffReply): void {
    switch (reply.state) {
      case "working":
        this.#setState("working");
        progress.value = reply.fraction;
        break;
      case "done":
        this.#showResult(reply.result, reply.parts);
        this.#showParts(reply.parts, reply.result.diagonal);
        break;
      case "cancelled":
        this.clear("cancelled", texts.faces.cancelled);
        break;
      case "failed":
        this.clear("failed", `${reply.code}: ${reply.message}`);
        break;
    }
  }

  /** Ends a comparison in progress, whose result will not come. */
  end(): void {
    if (section.dataset.state === "working") this.clear("cancelled", texts.faces.cancelled);
  }

  /** Removes the result and shows this text. */
  clear(state: "idle" | "cancelled" | "failed" | "outdated", text: string): void {
    this.#setState(state);
    summary.textContent = text;
    this.#result = undefined;
    this.#list.show([], 0);
    this.#showParts([], 0);
    clear.hidden = true;
    shownRow.hidden = true;
    this.#listener.show(undefined);
  }

  #showResult(result: DiffResult, parts: readonly PlacedPart[]): void {
    this.#setState("done");
    this.#result = result;
    const table = SIDES.map((side) => {
      const { unchanged, changed, undecided } = countsOf(facesOf(result, side));
      const name = side.toUpperCase();
      const counts = texts.faces.faceCounts(
        name,
        grouped(changed),
        grouped(undecided),
        grouped(unchanged),
      );
      return `${counts}${ofSamePlace(result, side)}`;
    });
    const own = ownLimits().length > 0 ? texts.faces.orThanIsAllowedOf : "";
    const unit = modelUnit();
    const limit = `${result.limit}${unit === undefined ? "" : ` ${unit}`}${own}`;
    const verdict = {
      unchanged: texts.faces.noFaceDiffersByMore(limit),
      changed: texts.faces.facesDifferByMoreThan(limit),
      undecided: texts.faces.undecidedAt(limit),
    }[result.state];
    const colors = result.state === "unchanged" ? [] : [COLORS];
    summary.replaceChildren(
      ...[verdict, ...table, ...colors, texts.faces.inSeconds(duration(result.seconds.solve))].map(
        (text) => {
          const line = document.createElement("span");
          line.textContent = text;
          return line;
        },
      ),
    );
    section.dataset.result = result.state;
    clear.hidden = false;
    const changes = changesOf(result, parts);
    this.#list.show(changes, result.diagonal);
    shownRow.hidden = false;
    // Both would be drawn over each other: first the one with the larger change.
    const [first] = changes;
    if (this.#isNew) shownSide.value = first?.side ?? "a";
    this.#isNew = false;
    this.#showSide();
  }

  #showParts(parts: readonly PlacedPart[], diagonal: number): void {
    this.#parts = parts;
    this.#listener.mark(parts);
    this.#lookAt(undefined);
    showParts(parts, diagonal, (part) => {
      // Of both revisions, where it is in both.
      const { a = [], b = [] } = part?.facesOf ?? {};
      if (part) shownSide.value = a.length === 0 ? "b" : b.length === 0 ? "a" : "both";
      this.#showSide();
      this.#lookAt(part);
    });
  }

  #lookAt(part: PlacedPart | undefined): void {
    if (part !== undefined || this.#isOfPart) this.#listener.look(part);
    this.#isOfPart = part !== undefined;
  }

  #setState(state: string): void {
    section.dataset.state = state;
    delete section.dataset.result;
    element("compare-work").hidden = state !== "working";
  }
}

/** How many of the changed faces were only extended or shortened. */
function ofSamePlace(result: DiffResult, side: Side): string {
  const count = kindsOf(result, side).filter(isOfSamePlace).length;
  if (count === 0) return "";
  return texts.faces.ofTheChangedOnlyA(grouped(count), side);
}
