// All parts and faces of both models by their names, to hide, to isolate and to filter.

import { batch, computed, effect, signal, untracked } from "@preact/signals-core";
import { element } from "../common/elements.ts";
import { grouped } from "../common/text/numbers.ts";
import { onOwnLimits } from "../results/ownLimits.ts";
import { texts } from "../texts/index.ts";
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

/** What a map says of faces: which are beyond what is allowed, and what each deviates by. */
interface Marks {
  changed: Sides<ReadonlySet<number>>;
  sizes: Sides<ReadonlyMap<number, string>>;
}

const UNMARKED: Marks = { changed: {}, sizes: {} };

/** The faces that are not drawn. */
type Hidden = Record<Side, ReadonlySet<number>>;

const NOTHING: Hidden = { a: new Set(), b: new Set() };

export class FaceTree {
  readonly #listener: TreeListener;
  readonly #names = signal<Sides<string[]>>({});
  readonly #items = computed((): Sides<Part["items"]> => {
    const { a = [], b = [] } = this.#names.value;
    return { a: partsOf(a), b: partsOf(b) };
  });
  readonly #marks = signal<Marks>(UNMARKED);
  /** The marks by which rows are chosen; what rows say is changed in place: a limit that is typed stays. */
  readonly #chosenBy = computed(() => (this.#isOnlyChanged.value ? this.#marks.value : UNMARKED));
  /** What became of parts, where revisions are compared. */
  readonly #states = signal(new PartStates([]));
  readonly #hidden = signal<Hidden>(NOTHING);
  /** The parts that are unfolded. */
  readonly #open = signal<ReadonlySet<string>>(new Set());
  readonly #wanted = signal("");
  readonly #isOnlyChanged = signal(onlyChanged.checked);

  constructor(listener: TreeListener) {
    this.#listener = listener;
    filter.addEventListener("input", () => {
      this.#wanted.value = filter.value.trim().toLowerCase();
    });
    onlyChanged.addEventListener("input", () => {
      this.#isOnlyChanged.value = onlyChanged.checked;
    });
    element("tree-all").addEventListener("click", () => this.#hide(NOTHING));
    effect(() => this.#draw());
    effect(() => this.#showMarks(this.#marks.value));
    onOwnLimits(() => showLimits(list));
  }

  /** Shows the faces of models, all of them drawn. */
  show(models: Sides<DisplayModel>): void {
    batch(() => {
      this.#names.value = { a: models.a?.faceNames ?? [], b: models.b?.faceNames ?? [] };
      this.#marks.value = UNMARKED;
      this.#states.value = new PartStates([]);
      this.#hidden.value = NOTHING;
      this.#open.value = new Set();
    });
  }

  /** Marks the faces that are beyond what is allowed, and says what each deviates by. */
  mark(changed: Sides<ReadonlySet<number>>, sizes: Sides<ReadonlyMap<number, string>>): void {
    this.#marks.value = { changed, sizes };
  }

  #showMarks({ changed, sizes }: Marks): void {
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
    if (parts.length > 0 || !this.#states.peek().isEmpty)
      this.#states.value = new PartStates(parts);
  }

  /** Draws these faces alone; without any, all of both models again. */
  isolate(faces: Record<Side, readonly number[]> | undefined): void {
    const others = (side: Side): Set<number> => {
      if (faces === undefined) return new Set();
      const own = new Set(faces[side]);
      return new Set([...(this.#names.peek()[side] ?? []).keys()].filter((face) => !own.has(face)));
    };
    this.#hide({ a: others("a"), b: others("b") });
  }

  #hide(hidden: Hidden): void {
    for (const side of SIDES) this.#listener.hide(side, hidden[side]);
    this.#hidden.value = hidden;
  }

  /** Draws some faces of a side or no longer. */
  #show(side: Side, faces: readonly number[], shown: boolean): void {
    const hidden = new Set(this.#hidden.peek()[side]);
    for (const face of faces) {
      if (shown) hidden.delete(face);
      else hidden.add(face);
    }
    this.#hide({ ...this.#hidden.peek(), [side]: hidden });
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
      rows.push(
        ...this.#rows(this.#items.value[side] ?? [], { side, faces: kept, key: side }, budget),
      );
    }
    if (budget.left <= 0 && faces > MAX_ROWS) {
      const more = document.createElement("li");
      more.textContent = texts.faces.facesInAll(grouped(faces));
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
    const [wanted, isOnlyChanged] = [this.#wanted.value, this.#isOnlyChanged.value];
    const changed = this.#chosenBy.value.changed[side];
    const names = this.#names.value[side];
    const isKept = (face: number, name: string) =>
      (!isOnlyChanged || changed?.has(face)) && name.toLowerCase().includes(wanted);
    const kept = new Set<number>();
    const visit = (items: Part["items"], above: string): void => {
      for (const item of items) {
        if (typeof item === "object") visit(item.items, `${item.path.join(SEPARATOR)}${SEPARATOR}`);
        else if (isKept(item, above + ownName(names?.[item] ?? ""))) kept.add(item);
      }
    };
    visit(this.#items.value[side] ?? [], "");
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
    const isFiltered = this.#wanted.value !== "" || this.#isOnlyChanged.value;
    const isOpen = isFiltered || this.#open.value.has(key);
    const inner = { side, faces, key, depth: part.path.length };
    const rows = isOpen ? this.#rows(part.items, inner, budget) : [];
    const fullName = part.path.join(SEPARATOR);
    const hidden = part.faces.filter((face) => this.#hidden.value[side].has(face)).length;
    const { box, letter, look, alone } = rowParts({
      ...{ side, name: part.path.slice(depth).join(SEPARATOR), fullName },
      isChanged: [...faces].some((face) => this.#marks.peek().changed[side]?.has(face) ?? false),
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
    unfold.setAttribute("aria-label", texts.faces.contentsOf(side.toUpperCase(), fullName));
    unfold.addEventListener("click", () => {
      const open = new Set(this.#open.peek());
      if (!open.delete(key)) open.add(key);
      this.#open.value = open;
    });
    const count = document.createElement("span");
    count.className = "note";
    count.textContent = grouped(faces.size);
    const row = document.createElement("div");
    const state = document.createElement("span");
    const { text, title, isSame } = this.#states.value.of(side, part.faces);
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
    const fullName = this.#names.value[side]?.[face] ?? "";
    const { box, letter, look, alone } = rowParts({
      ...{ side, name: ownName(fullName), fullName },
      isChanged: this.#marks.peek().changed[side]?.has(face) ?? false,
      shown: !this.#hidden.value[side].has(face),
      show: (shown) => this.#show(side, [face], shown),
      only: () => this.#isolate(side, [face]),
      look: () => this.#listener.look(side, [face]),
    });
    const item = document.createElement("li");
    item.className = "face";
    const size = document.createElement("span");
    size.className = "deviation";
    size.textContent = this.#marks.peek().sizes[side]?.get(face) ?? "";
    Object.assign(item.dataset, { side, face });
    item.append(
      box,
      letter,
      look,
      size,
      acts(
        // Its own limit is changed in place.
        untracked(() => limitInput(side, face, fullName)),
        alone,
      ),
    );
    return item;
  }
}
