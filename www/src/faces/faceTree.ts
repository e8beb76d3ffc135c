// All parts and faces of both models by their names, to hide, to isolate and to filter.
import { element } from "../common/elements.ts";
import { grouped } from "../common/numbers.ts";
import { onOwnLimits } from "../results/ownLimits.ts";
import { type DisplayModel, SIDES, type Side, type Sides } from "../worker/protocol.ts";
import { ownName, type Part, partsOf } from "./parts.ts";
import { limitInput, rowParts, showLimits } from "./treeRows.ts";

/** Rows listed at once; the filter finds the others. */
const MAX_ROWS = 300;

const list = element("tree-list");
const filter = element("tree-filter", HTMLInputElement);
const onlyChanged = element("tree-changed", HTMLInputElement);
const tree = element("tree", HTMLDetailsElement);

export interface TreeListener {
  /** The faces to leave out of the view. */
  hide: (side: Side, hidden: ReadonlySet<number>) => void;
  /** The faces to look at. */
  look: (side: Side, faces: readonly number[]) => void;
}

/** A part of a side, with those of its faces that the filter leaves. */
interface Listed {
  side: Side;
  part: Part;
  faces: number[];
  /** What it is known by while the models are the same. */
  key: string;
}

export class FaceTree {
  readonly #listener: TreeListener;
  #names: Sides<string[]> = {};
  #parts: Sides<Part[]> = {};
  #changed: Sides<ReadonlySet<number>> = {};
  #hidden: Record<Side, Set<number>> = { a: new Set(), b: new Set() };
  /** The parts whose faces are listed. */
  #open = new Set<string>();

  constructor(listener: TreeListener) {
    this.#listener = listener;
    for (const control of [filter, onlyChanged]) {
      control.addEventListener("input", () => this.#draw());
    }
    element("tree-all").addEventListener("click", () => this.#hide({ a: new Set(), b: new Set() }));
    tree.addEventListener("toggle", () => this.#draw());
    onOwnLimits(() => showLimits(list));
  }

  /** Shows the faces of models, all of them drawn. */
  show(models: Sides<DisplayModel>): void {
    for (const side of SIDES) {
      this.#names[side] = models[side]?.faceNames ?? [];
      this.#parts[side] = partsOf(this.#names[side] ?? []);
    }
    this.#changed = {};
    this.#hidden = { a: new Set(), b: new Set() };
    this.#open.clear();
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

  /** Draws some faces of a side or no longer. */
  #show(side: Side, faces: readonly number[], shown: boolean): void {
    const hidden = new Set(this.#hidden[side]);
    for (const face of faces) {
      if (shown) hidden.delete(face);
      else hidden.add(face);
    }
    this.#hide({ ...this.#hidden, [side]: hidden });
  }

  /** Draws some faces of a side alone. */
  #isolate(side: Side, faces: readonly number[]): void {
    const own = new Set(faces);
    const others = (one: Side) =>
      new Set(
        [...(this.#names[one] ?? []).keys()].filter((face) => one !== side || !own.has(face)),
      );
    this.#hide({ a: others("a"), b: others("b") });
    this.#listener.look(side, faces);
  }

  #draw(): void {
    // A list that is folded away is not made.
    if (!tree.open) {
      list.replaceChildren();
      return;
    }
    const wanted = filter.value.trim().toLowerCase();
    const isFiltered = wanted !== "" || onlyChanged.checked;
    const listed = SIDES.flatMap((side) => this.#listed(side, wanted));
    let left = MAX_ROWS;
    const rows: HTMLElement[] = [];
    for (const { side, part, faces, key } of listed) {
      const isPart = part.name !== "";
      const isOpen = !isPart || isFiltered || this.#open.has(key);
      if (left <= 0) break;
      const own = isOpen ? faces.slice(0, left).map((face) => this.#faceRow(side, face)) : [];
      left -= own.length + Number(isPart);
      if (isPart) rows.push(this.#partRow({ side, part, faces, key }, isOpen, own));
      else rows.push(...own);
    }
    const faces = listed.reduce((sum, one) => sum + one.faces.length, 0);
    if (left <= 0 && faces > MAX_ROWS) {
      const more = document.createElement("li");
      more.textContent = `${grouped(faces)} faces in all: type a part of a name`;
      rows.push(more);
    }
    const focused = list.contains(document.activeElement)
      ? document.activeElement?.getAttribute("aria-label")
      : undefined;
    list.replaceChildren(...rows);
    // The control that was used is another one now.
    const same = [...list.querySelectorAll<HTMLElement>("[aria-label]")];
    if (focused) same.find((node) => node.ariaLabel === focused)?.focus({ preventScroll: true });
  }

  /** The parts of a side that have faces which the filter leaves. */
  #listed(side: Side, wanted: string): Listed[] {
    const names = this.#names[side] ?? [];
    return (this.#parts[side] ?? []).flatMap((part, index) => {
      const faces = part.faces.filter((face) => {
        if (onlyChanged.checked && !this.#changed[side]?.has(face)) return false;
        return `${part.name} / ${names[face]}`.toLowerCase().includes(wanted);
      });
      return faces.length === 0 ? [] : [{ side, part, faces, key: `${side} ${index}` }];
    });
  }

  #partRow({ side, part, faces, key }: Listed, isOpen: boolean, rows: HTMLElement[]): HTMLElement {
    const hidden = part.faces.filter((face) => this.#hidden[side].has(face)).length;
    const isChanged = faces.some((face) => this.#changed[side]?.has(face) ?? false);
    const { box, letter, look, alone } = rowParts({
      ...{ side, name: part.name, fullName: part.name, isChanged },
      shown: hidden === 0 ? true : hidden === part.faces.length ? false : undefined,
      show: (shown) => this.#show(side, part.faces, shown),
      only: () => this.#isolate(side, part.faces),
      look: () => this.#listener.look(side, part.faces),
    });
    const unfold = document.createElement("button");
    unfold.type = "button";
    unfold.className = "unfold";
    unfold.textContent = isOpen ? "▾" : "▸";
    unfold.setAttribute("aria-expanded", `${isOpen}`);
    unfold.setAttribute("aria-label", `Faces of ${side.toUpperCase()} ${part.name}`);
    unfold.addEventListener("click", () => {
      if (!this.#open.delete(key)) this.#open.add(key);
      this.#draw();
    });
    const count = document.createElement("span");
    count.className = "note";
    count.textContent = grouped(faces.length);
    const row = document.createElement("div");
    row.append(unfold, box, letter, look, count, alone);
    const own = document.createElement("ul");
    own.append(...rows);
    own.hidden = !isOpen;
    const item = document.createElement("li");
    item.className = "part";
    item.append(row, own);
    return item;
  }

  #faceRow(side: Side, face: number): HTMLElement {
    const fullName = this.#names[side]?.[face] ?? "";
    const { box, letter, look, alone } = rowParts({
      ...{ side, name: ownName(fullName), fullName },
      isChanged: this.#changed[side]?.has(face) ?? false,
      shown: !this.#hidden[side].has(face),
      show: (shown) => this.#show(side, [face], shown),
      only: () => this.#isolate(side, [face]),
      look: () => this.#listener.look(side, [face]),
    });
    const item = document.createElement("li");
    item.className = "face";
    item.append(box, letter, look, limitInput(side, face, fullName), alone);
    return item;
  }
}
