// The panel of changed faces: the limit, the comparison's progress, counts and list.
import type { DiffResult } from "nurbs-hausdorff";
import { element } from "../common/elements.ts";
import { duration, grouped } from "../common/numbers.ts";
import { ownLimits } from "../results/ownLimits.ts";
import { allowed, onLimit } from "../results/verdict.ts";
import { type DiffReply, SIDES } from "../worker/protocol.ts";
import { type Change, changesOf, countsOf, facesOf } from "./changes.ts";
import { FaceList } from "./faceList.ts";

/** The limit proposed where nothing is allowed yet, as a fraction of the diagonal. */
const RELATIVE_LIMIT = 1e-5;

/** What the colours of compared faces mean. */
const COLORS =
  "Changed faces have the colour of their model, undecided ones are violet, others grey.";

const section = element("faces");
const limit = element("face-limit", HTMLInputElement);
const compare = element("compare", HTMLButtonElement);
const progress = element("compare-progress", HTMLProgressElement);
const cancel = element("compare-cancel", HTMLButtonElement);
const summary = element("face-summary");
const clear = element("faces-clear", HTMLButtonElement);

export interface FacesListener {
  /** The user requests a comparison with this limit. */
  compare: (limit: number) => void;
  cancel: () => void;
  /** The result to show in the view, or none. */
  show: (result: DiffResult | undefined) => void;
  /** The face to show in the view, or none. */
  select: (change: Change | undefined) => void;
}

export class FacesPanel {
  readonly #listener: FacesListener;
  readonly #list: FaceList;
  #result: DiffResult | undefined;
  #diagonal = 0;
  /** Whether the user has typed a limit for these models; else it is what is allowed. */
  #isTyped = false;

  constructor(listener: FacesListener) {
    this.#listener = listener;
    this.#list = new FaceList(element("face-list"), element("face-more"), listener.select);
    compare.addEventListener("click", () => {
      if (limit.reportValidity()) listener.compare(limit.valueAsNumber);
    });
    limit.addEventListener("input", () => {
      this.#isTyped = limit.value !== "";
    });
    onLimit(() => this.#proposeLimit());
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

  /** The comparison shown. */
  get result(): DiffResult | undefined {
    return this.#result;
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
        this.#showResult(reply.result);
        break;
      case "cancelled":
        this.clear("cancelled", "Cancelled.");
        break;
      case "failed":
        this.clear("failed", `${reply.code}: ${reply.message}`);
        break;
    }
  }

  /** Ends a comparison in progress, whose result will not come. */
  end(): void {
    if (section.dataset.state === "working") this.clear("cancelled", "Cancelled.");
  }

  /** Removes the result and shows this text. */
  clear(state: "idle" | "cancelled" | "failed" | "outdated", text: string): void {
    this.#setState(state);
    summary.textContent = text;
    this.#result = undefined;
    this.#list.show([], 0);
    clear.hidden = true;
    this.#listener.show(undefined);
  }

  #showResult(result: DiffResult): void {
    this.#setState("done");
    this.#result = result;
    const table = SIDES.map((side) => {
      const { unchanged, changed, undecided } = countsOf(facesOf(result, side));
      const name = side.toUpperCase();
      return `${name}: ${grouped(changed)} changed, ${grouped(undecided)} undecided, ${grouped(unchanged)} unchanged`;
    });
    const own = ownLimits().length > 0 ? ", or than is allowed of it alone" : "";
    const limit = `${result.limit}${own}`;
    const verdict = {
      unchanged: `No face differs by more than ${limit}.`,
      changed: `Faces differ by more than ${limit}:`,
      undecided: `Undecided at ${limit}:`,
    }[result.state];
    const colors = result.state === "unchanged" ? [] : [COLORS];
    summary.replaceChildren(
      ...[verdict, ...table, ...colors, `in ${duration(result.seconds.solve)}`].map((text) => {
        const line = document.createElement("span");
        line.textContent = text;
        return line;
      }),
    );
    section.dataset.result = result.state;
    clear.hidden = false;
    this.#list.show(changesOf(result), result.diagonal);
    this.#listener.show(result);
  }

  #setState(state: string): void {
    section.dataset.state = state;
    delete section.dataset.result;
    element("compare-work").hidden = state !== "working";
  }
}
