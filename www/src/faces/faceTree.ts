// All faces of both models by their names, to hide, to isolate and to filter.
import { element } from "../common/elements.ts";
import { limitText, onOwnLimits, ownLimit, setOwnLimit } from "../results/ownLimits.ts";
import { type DisplayModel, SIDES, type Side, type Sides } from "../worker/protocol.ts";

/** Faces listed at once; the filter finds the others. */
const MAX_ROWS = 300;

const list = element("tree-list");
const filter = element("tree-filter", HTMLInputElement);
const onlyChanged = element("tree-changed", HTMLInputElement);
const tree = element("tree", HTMLDetailsElement);

export interface TreeListener {
  /** The faces to leave out of the view. */
  hide: (side: Side, hidden: ReadonlySet<number>) => void;
  /** The face to look at. */
  look: (side: Side, face: number) => void;
}

export class FaceTree {
  readonly #listener: TreeListener;
  #models: Sides<DisplayModel> = {};
  #changed: Sides<ReadonlySet<number>> = {};
  #hidden: Record<Side, Set<number>> = { a: new Set(), b: new Set() };

  constructor(listener: TreeListener) {
    this.#listener = listener;
    for (const control of [filter, onlyChanged]) {
      control.addEventListener("input", () => this.#draw());
    }
    element("tree-all").addEventListener("click", () => this.#hide({ a: new Set(), b: new Set() }));
    tree.addEventListener("toggle", () => this.#draw());
    onOwnLimits(showLimits);
  }

  /** Shows the faces of models, all of them drawn. */
  show(models: Sides<DisplayModel>): void {
    this.#models = models;
    this.#changed = {};
    this.#hidden = { a: new Set(), b: new Set() };
    this.#draw();
  }

  /** The faces that are beyond what is allowed, for the filter. */
  set changed(changed: Sides<ReadonlySet<number>>) {
    this.#changed = changed;
    if (onlyChanged.checked) this.#draw();
  }

  #hide(hidden: Record<Side, Set<number>>): void {
    this.#hidden = hidden;
    for (const side of SIDES) this.#listener.hide(side, hidden[side]);
    this.#draw();
  }

  /** Draws one face alone. */
  #isolate(side: Side, face: number): void {
    const others = (one: Side) =>
      new Set(
        (this.#models[one]?.faceNames ?? []).flatMap((_, index) =>
          one === side && index === face ? [] : [index],
        ),
      );
    this.#hide({ a: others("a"), b: others("b") });
    this.#listener.look(side, face);
  }

  #draw(): void {
    // A list that is folded away is not made.
    if (!tree.open) {
      list.replaceChildren();
      return;
    }
    const wanted = filter.value.trim().toLowerCase();
    const rows = SIDES.flatMap((side) =>
      (this.#models[side]?.faceNames ?? []).flatMap((name, face) => {
        const isChanged = this.#changed[side]?.has(face) ?? false;
        if (onlyChanged.checked && !isChanged) return [];
        return name.toLowerCase().includes(wanted) ? [{ side, face, name, isChanged }] : [];
      }),
    );
    list.replaceChildren(...rows.slice(0, MAX_ROWS).map((row) => this.#row(row)));
    if (rows.length > MAX_ROWS) {
      const more = document.createElement("li");
      more.textContent = `and ${rows.length - MAX_ROWS} more: type a part of a name`;
      list.append(more);
    }
  }

  #row({
    side,
    face,
    name,
    isChanged,
  }: {
    side: Side;
    face: number;
    name: string;
    isChanged: boolean;
  }) {
    const item = document.createElement("li");
    const [letter, look, shown, alone] = [
      document.createElement("b"),
      document.createElement("button"),
      document.createElement("input"),
      document.createElement("button"),
    ];
    letter.className = side;
    letter.textContent = side.toUpperCase();
    look.textContent = name;
    look.type = "button";
    look.className = "name";
    look.dataset.changed = `${isChanged}`;
    look.addEventListener("click", () => this.#listener.look(side, face));
    shown.type = "checkbox";
    shown.checked = !this.#hidden[side].has(face);
    shown.setAttribute("aria-label", `Show ${side.toUpperCase()} ${name}`);
    shown.addEventListener("input", (event) => {
      event.stopPropagation();
      const hidden = new Set(this.#hidden[side]);
      if (shown.checked) hidden.delete(face);
      else hidden.add(face);
      this.#hide({ ...this.#hidden, [side]: hidden });
    });
    alone.textContent = "only";
    alone.type = "button";
    alone.setAttribute("aria-label", `Show only ${side.toUpperCase()} ${name}`);
    alone.addEventListener("click", () => this.#isolate(side, face));
    item.append(shown, letter, look, limitInput(side, face, name), alone);
    return item;
  }
}

/** The field of what is allowed of a face alone. */
function limitInput(side: Side, face: number, name: string): HTMLInputElement {
  const input = document.createElement("input");
  input.type = "text";
  input.inputMode = "decimal";
  input.placeholder = "±";
  input.className = "own-limit";
  Object.assign(input.dataset, { side, face });
  input.value = ownText(side, face);
  input.setAttribute("aria-label", `Allowed deviation of ${side.toUpperCase()} ${name}`);
  input.addEventListener("input", (event) => event.stopPropagation());
  input.addEventListener("change", () => {
    input.setAttribute("aria-invalid", `${!setOwnLimit(side, face, input.value)}`);
  });
  return input;
}

function ownText(side: Side, face: number): string {
  const own = ownLimit(side, face);
  return own === undefined ? "" : limitText(own);
}

/** Shows the limits as they are after undoing, in the rows that there are. */
function showLimits(): void {
  for (const input of list.querySelectorAll<HTMLInputElement>(".own-limit")) {
    input.value = ownText(input.dataset.side as Side, Number(input.dataset.face));
  }
}
