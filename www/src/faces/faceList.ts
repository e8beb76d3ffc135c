// The list of changed faces: buttons; arrow keys select the next and the previous.

import { type FaceDifference, facePath } from "nurbs-hausdorff";
import { span } from "../common/elements.ts";
import { attainedText, heldText, intervalText } from "../common/text/numbers.ts";
import { texts } from "../texts/index.ts";
import type { Side } from "../worker/protocol.ts";
import type { Change } from "./changes.ts";
import type { Kind } from "./kinds.ts";

/** Rows shown; a list of more is not read. */
const MAX_ROWS = 200;

/** The row that a key selects, from the selected row and the number of rows. */
const STEPS: Readonly<Record<string, (row: number, rows: number) => number>> = {
  ArrowDown: (row, rows) => Math.min(row + 1, rows - 1),
  ArrowUp: (row) => Math.max(row - 1, 0),
  Home: () => 0,
  End: (_, rows) => rows - 1,
};

export class FaceList {
  readonly #list: HTMLElement;
  readonly #more: HTMLElement;
  readonly #select: (change: Change | undefined) => void;
  #changes: Change[] = [];
  #selected: number | undefined;

  /** Calls `select` with the face that is selected, and without one when none is. */
  constructor(list: HTMLElement, more: HTMLElement, select: (change: Change | undefined) => void) {
    this.#list = list;
    this.#more = more;
    this.#select = select;
    list.addEventListener("keydown", (event) => this.#key(event));
  }

  /** Shows these faces; `diagonal` is the size that digits refer to. */
  show(changes: Change[], diagonal: number): void {
    this.#changes = changes.slice(0, MAX_ROWS);
    this.#selected = undefined;
    this.#list.replaceChildren(
      ...this.#changes.map((change, row) => this.#row(change, row, diagonal)),
    );
    const hidden = changes.length - this.#changes.length;
    this.#more.hidden = hidden === 0;
    this.#more.textContent = texts.faces.andMoreWhichTheJSON(hidden);
  }

  /** Selects a row, or with `undefined` none. */
  select(row: number | undefined): void {
    this.#selected = row;
    for (const [index, button] of this.#buttons().entries()) {
      button.setAttribute("aria-pressed", `${index === row}`);
    }
    this.#select(row === undefined ? undefined : this.#changes[row]);
  }

  #row({ side, difference, kind }: Change, row: number, diagonal: number): HTMLElement {
    const button = document.createElement("button");
    button.type = "button";
    button.dataset.side = side;
    button.dataset.face = `${difference.face}`;
    button.dataset.state = difference.state;
    button.dataset.kind = kind;
    button.setAttribute("aria-pressed", "false");
    const letter = document.createElement("b");
    letter.className = side;
    letter.textContent = side.toUpperCase();
    const { lower, upper } = difference;
    const name = difference.witness[side].faceName;
    button.title = name ?? "";
    button.append(
      letter,
      span("name", name === undefined ? texts.faces.face(difference.face) : shortName(name)),
      span("kind", kindText(side, difference, kind, diagonal)),
      span(
        "size",
        difference.state === "undecided"
          ? texts.faces.kinds.undecided
          : attainedText([lower, upper], diagonal),
      ),
      span("interval", intervalText(lower, upper, diagonal)),
    );
    button.addEventListener("click", () => this.select(this.#selected === row ? undefined : row));
    const item = document.createElement("li");
    item.append(button);
    return item;
  }

  #key(event: KeyboardEvent): void {
    if (event.key === "Escape" && this.#selected !== undefined) {
      this.select(undefined);
      event.preventDefault();
      return;
    }
    const step = STEPS[event.key];
    if (step === undefined || this.#changes.length === 0) return;
    event.preventDefault();
    const focused = this.#buttons().indexOf(document.activeElement as HTMLButtonElement);
    const row = step(focused, this.#changes.length);
    this.#buttons()[row]?.focus();
    this.select(row);
  }

  #buttons(): HTMLButtonElement[] {
    return [...this.#list.querySelectorAll("button")];
  }
}

/** What happened to a face; of a resized one with its radii before and after. */
function kindText(
  side: Side,
  { counterpart }: FaceDifference,
  kind: Kind,
  diagonal: number,
): string {
  if (kind === "changed" || kind === "undecided") return "";
  if (kind !== "resized" || counterpart === undefined) return texts.faces.kinds[kind];
  const radii = [counterpart.radius, counterpart.otherRadius];
  const [own = "", other = ""] = radii.map(({ lower, upper }) =>
    heldText([lower, upper], diagonal),
  );
  return side === "a" ? texts.faces.resized(own, other) : texts.faces.resized(other, own);
}

/** A face's own name with that of its part: in an assembly, faces of many parts have one name. */
const shortName = (name: string): string => facePath(name).slice(-2).join(" / ");
