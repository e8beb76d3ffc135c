// All parts and faces of both models by their names, to hide, to isolate and to filter.
import { element } from "../common/elements.ts";
import { grouped } from "../common/text/numbers.ts";
import { onOwnLimits } from "../results/ownLimits.ts";
import {
  type DisplayModel,
  type PlacedPart,
  SIDES,
  type Side,
  type Sides,
} from "../worker/protocol.ts";
import { PartStates } from "./partStates.ts";
import { ownName, type Part, partsOf } from "./parts.ts";
import { acts, limitInput, rowParts, showLimits } from "./treeRows.ts";

/** Rows listed at once; the filter finds the others. */
const MAX_ROWS = 300;
/** What stands between the names of levels. */
const SEPARATOR = " / ";

const list = element("tree-list");
const filter = element("tree-filter", HTMLInputElement);
const onlyChanged = element("tree-changed", HTMLInputElement);

export interface TreeListener {
  /** The faces to leave out of the view. */
  hide: (side: Side, hidden: ReadonlySet<number>) => void;
  /** The faces to look at. */
  look: (side: Side, faces: readonly number[]) => void;
}

/** What a row lists, with the faces below it that the filter leaves. */
interface Listed {
  side: Side;
  part: Part;
  faces: ReadonlySet<number>;
  /** What it is known by while the models are the same. */
  key: string;
  /** The levels whose names stand in the rows above. */
  depth: number;
}

export class FaceTree {
  readonly #listener: TreeListener;
  #names: Sides<string[]> = {};
  #items: Sides<Part["items"]> = {};
  #changed: Sides<ReadonlySet<number>> = {};
  #sizes: Sides<ReadonlyMap<number, string>> = {};
  /** What became of parts, where revisions are compared. */
  #states = new PartStates([]);
  #hidden: Record<Side, Set<number>> = { a: new Set(), b: new Set() };
  /** The parts that are unfolded. */
  #open = new Set<string>();

  constructor(listener: TreeListener) {
    this.#listener = listener;
    for (const control of [filter, onlyChanged]) {
      control.addEventListener("input", () => this.#draw());
    }
    element("tree-all").addEventListener("click", () => this.#hide({ a: new Set(), b: new Set() }));
    onOwnLimits(() => showLimits(list));
  }

  /** Shows the faces of models, all of them drawn. */
  show(models: Sides<DisplayModel>): void {
    for (const side of SIDES) {
      this.#names[side] = models[side]?.faceNames ?? [];
      this.#items[side] = partsOf(this.#names[side] ?? []);
    }
    this.#changed = {};
    this.#sizes = {};
    this.#states = new PartStates([]);
    this.#hidden = { a: new Set(), b: new Set() };
    this.#open.clear();
    this.#draw();
  }

  /** Marks the faces that are beyond what is allowed, and says what each deviates by. */
  mark(changed: Sides<ReadonlySet<number>>, sizes: Sides<ReadonlyMap<number, string>>): void {
    this.#changed = changed;
    this.#sizes = sizes;
    if (onlyChanged.checked) {
      this.#draw();
      return;
    }
    // In place: a limit that is being typed stays.
    for (const row of list.querySelectorAll<HTMLElement>(".face")) {
      const [side, face] = [row.dataset.side as Side, Number(row.dataset.face)];
      const [look, size] = [
        row.querySelector<HTMLElement>(".name"),
        row.querySelector(".deviation"),
      ];
      if (look) look.dataset.changed = `${changed[side]?.has(face) ?? false}`;
      if (size) size.textContent = sizes[side]?.get(face) ?? "";
    }
  }

  /** Says of each part what became of it; without parts, nothing. */
  markParts(parts: readonly PlacedPart[]): void {
    const isEmpty = parts.length === 0 && this.#states.isEmpty;
    this.#states = new PartStates(parts);
    if (!isEmpty) this.#draw();
  }

  /** Draws these faces alone; without any, all of both models again. */
  isolate(faces: Record<Side, readonly number[]> | undefined): void {
    const others = (side: Side): Set<number> => {
      if (faces === undefined) return new Set();
      const own = new Set(faces[side]);
      return new Set([...(this.#names[side] ?? []).keys()].filter((face) => !own.has(face)));
    };
    this.#hide({ a: others("a"), b: others("b") });
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
    this.isolate({ a: [], b: [], [side]: faces });
    this.#listener.look(side, faces);
  }

  #draw(): void {
    const rows: HTMLElement[] = [];
    let faces = 0;
    const budget = { left: MAX_ROWS };
    for (const side of SIDES) {
      const kept = this.#kept(side);
      faces += kept.size;
      rows.push(...this.#rows(this.#items[side] ?? [], { side, faces: kept, key: side }, budget));
    }
    if (budget.left <= 0 && faces > MAX_ROWS) {
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

  /** The faces of a side that the filter leaves. */
  #kept(side: Side): ReadonlySet<number> {
    const wanted = filter.value.trim().toLowerCase();
    const changed = onlyChanged.checked ? this.#changed[side] : undefined;
    const isKept = (face: number, name: string) =>
      (!onlyChanged.checked || changed?.has(face)) && name.toLowerCase().includes(wanted);
    const kept = new Set<number>();
    const visit = (items: Part["items"], above: string): void => {
      for (const item of items) {
        if (typeof item === "object") visit(item.items, `${item.path.join(SEPARATOR)}${SEPARATOR}`);
        else if (isKept(item, above + ownName(this.#names[side]?.[item] ?? ""))) kept.add(item);
      }
    };
    visit(this.#items[side] ?? [], "");
    return kept;
  }

  /** The rows of parts and faces that have what the filter leaves, as many as the budget has left. */
  #rows(
    items: Part["items"],
    { side, faces, key, depth = 0 }: Pick<Listed, "side" | "faces" | "key"> & { depth?: number },
    budget: { left: number },
  ): HTMLElement[] {
    const rows: HTMLElement[] = [];
    for (const [index, item] of items.entries()) {
      if (budget.left <= 0) break;
      if (typeof item === "number") {
        if (!faces.has(item)) continue;
        budget.left -= 1;
        rows.push(this.#faceRow(side, item));
        continue;
      }
      const own = new Set(item.faces.filter((face) => faces.has(face)));
      if (own.size === 0) continue;
      budget.left -= 1;
      const listed = { side, part: item, faces: own, key: `${key} ${index}`, depth };
      rows.push(this.#partRow(listed, budget));
    }
    return rows;
  }

  #partRow(listed: Listed, budget: { left: number }): HTMLElement {
    const { side, part, faces, key, depth } = listed;
    const isOpen = filter.value.trim() !== "" || onlyChanged.checked || this.#open.has(key);
    const inner = { side, faces, key, depth: part.path.length };
    const rows = isOpen ? this.#rows(part.items, inner, budget) : [];
    const fullName = part.path.join(SEPARATOR);
    const hidden = part.faces.filter((face) => this.#hidden[side].has(face)).length;
    const { box, letter, look, alone } = rowParts({
      ...{ side, name: part.path.slice(depth).join(SEPARATOR), fullName },
      isChanged: [...faces].some((face) => this.#changed[side]?.has(face) ?? false),
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
    unfold.setAttribute("aria-label", `Contents of ${side.toUpperCase()} ${fullName}`);
    unfold.addEventListener("click", () => {
      if (!this.#open.delete(key)) this.#open.add(key);
      this.#draw();
    });
    const count = document.createElement("span");
    count.className = "note";
    count.textContent = grouped(faces.size);
    const row = document.createElement("div");
    const state = document.createElement("span");
    const { text, title, isSame } = this.#states.of(side, part.faces);
    Object.assign(state, { className: "state", textContent: text, title });
    state.dataset.same = `${isSame}`;
    row.append(unfold, box, letter, look, state, count, acts(alone));
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
    const size = document.createElement("span");
    size.className = "deviation";
    size.textContent = this.#sizes[side]?.get(face) ?? "";
    Object.assign(item.dataset, { side, face });
    item.append(box, letter, look, size, acts(limitInput(side, face, fullName), alone));
    return item;
  }
}
