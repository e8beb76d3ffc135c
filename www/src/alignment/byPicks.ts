// Alignment by hand: points or faces of A are picked with those of B where they belong, both models side by side.
import { effect } from "@preact/signals-core";
import type { Datum, PointPair } from "nurbs-hausdorff";
import { element, make } from "../common/elements.ts";
import { PickingTool, type Take } from "../inspection/pickingTool.ts";
import type { Viewport } from "../scene/camera/viewport.ts";
import type { Models } from "../scene/models.ts";
import { field } from "../state/store.ts";
import {
  addPick,
  asked,
  fitStart,
  isEnough,
  kind,
  nextSide,
  type Pick,
  type PickKind,
  picks,
  removeLast,
} from "./picks.ts";

export interface PicksListener {
  hit: (x: number, y: number) => Pick | undefined;
  take: Take;
  /** Shows the models as they stand. */
  onPlace: () => void;
  /** Lays A on B; with `fits` it is then fitted in the freedoms that are left. */
  lay: (start: ({ pairs: PointPair[] } | { datums: Datum[] }) & { norm: "none" | "mean" }) => void;
  scale: () => number;
  redraw: () => void;
}

const strip = element("picks-controls");
const layer = element("picks");

export class AlignmentByPicks {
  readonly #listener: PicksListener;
  readonly #tool: PickingTool;
  /** The fields of the view as they were before, by their names. */
  #before: readonly (readonly [name: string, value: string])[] = [];

  constructor(listener: PicksListener) {
    this.#listener = listener;
    this.#tool = new PickingTool({
      button: element("align-picks", HTMLButtonElement),
      take: listener.take,
      click: (x, y) => this.#click(x, y),
      turned: (on) => this.#turned(on),
      back: () => {
        const has = picks.peek().length > 0;
        if (has) removeLast();
        return has;
      },
    });
    element("picks-kind", HTMLSelectElement).addEventListener("input", ({ target }) => {
      picks.value = [];
      kind.value = (target as HTMLSelectElement).value as PickKind;
    });
    element("picks-undo").addEventListener("click", removeLast);
    element("picks-end").addEventListener("click", () => this.end());
    for (const [id, norm] of [
      ["picks-lay", "none"],
      ["picks-fit", "mean"],
    ] as const) {
      element(id).addEventListener("click", () => {
        const start = fitStart(listener.scale());
        this.end();
        listener.lay({ ...start, norm });
      });
    }
    effect(() => this.#show(picks.value, asked.value, isEnough.value));
  }

  /** Whether clicks on the view pick what A is laid on B by. */
  get active(): boolean {
    return this.#tool.active;
  }

  end(): void {
    this.#tool.end();
  }

  #turned(on: boolean): void {
    strip.hidden = !on;
    picks.value = [];
    if (on) {
      this.#listener.onPlace();
      this.#before = ["wipe", "beside"].map((name) => [name, field(name).value] as const);
      for (const [name] of this.#before) field(name).set("on");
    } else {
      for (const [name, value] of this.#before) field(name).set(value);
    }
  }

  #click(x: number, y: number): void {
    const hit = this.#listener.hit(x, y);
    if (hit !== undefined) addPick(hit);
  }

  #show(all: readonly Pick[], text: string, enough: boolean): void {
    element("picks-text").textContent = text;
    strip.dataset.next = nextSide.value;
    for (const id of ["picks-lay", "picks-fit"]) element(id, HTMLButtonElement).disabled = !enough;
    element("picks-undo", HTMLButtonElement).disabled = all.length === 0;
    layer.replaceChildren(
      ...all.map(({ side }, index) =>
        make("b", `${Math.floor(index / 2) + 1}`, { class: `pick-mark ${side}` }),
      ),
    );
    this.#listener.redraw();
  }

  /** Moves the marks to where their points are seen. */
  update(viewport: Viewport, models: Models): void {
    for (const [index, { side, face, point }] of picks.peek().entries()) {
      const mark = layer.children[index];
      if (!(mark instanceof HTMLElement)) continue;
      const place = models.pointOf(side, face, point);
      const at = place && viewport.project(place, side);
      mark.hidden = at === undefined;
      mark.style.left = `${at?.[0] ?? 0}px`;
      mark.style.top = `${at?.[1] ?? 0}px`;
    }
  }
}
