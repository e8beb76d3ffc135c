// The annotations in the view: a label with a leader to its point, and the field in which a text is written.

import { effect, signal } from "@preact/signals-core";
import { draw } from "../common/drawing.ts";
import { element, make } from "../common/elements.ts";
import type { Viewport } from "../scene/camera/viewport.ts";
import type { Models } from "../scene/models.ts";
import { texts } from "../texts/index.ts";
import {
  type Annotation,
  addAnnotation,
  annotations,
  removeAnnotation,
  setAnnotationText,
} from "./annotations.ts";
import { editor } from "./editor.ts";
import { type Box, cornersOf, type Labelled, leaderEnd } from "./layout.ts";

/** What is edited: an annotation by its index, or one that is not there yet. */
type Edited = number | Omit<Annotation, "text"> | undefined;

/** A label where it was drawn last, in CSS pixels. */
export interface DrawnLabel extends Labelled {
  corner: readonly [number, number];
  number: number;
  text: string;
}

export class AnnotationLayer {
  readonly #root = element("annotations");
  readonly #leaders = draw("svg", { class: "leaders", "aria-hidden": "true" });
  readonly #edited = signal<Edited>(undefined);
  readonly #redraw: () => void;
  #labels: { node: HTMLElement; leader: SVGElement; of: Omit<Annotation, "text">; text: string }[] =
    [];
  #drawn: DrawnLabel[] = [];

  /** Calls `redraw` where labels have to be placed. */
  constructor(redraw: () => void) {
    this.#redraw = redraw;
    effect(() => this.#show(annotations.value, this.#edited.value));
  }

  /** Asks for the text of a new annotation. */
  begin(at: Omit<Annotation, "text">): void {
    this.#edited.value = at;
  }

  /** Changes the text of an annotation. */
  edit(index: number): void {
    this.#edited.value = index;
  }

  /** Ends writing a text that is not kept. */
  end(): void {
    this.#edited.value = undefined;
  }

  /** The labels where they stand, for a picture. */
  get drawn(): readonly DrawnLabel[] {
    return this.#drawn;
  }

  #show(all: readonly Annotation[], edited: Edited): void {
    const rows = all.map((of, index) => ({
      of,
      text: of.text,
      node: edited === index ? this.#editor(index, of.text) : this.#label(index, of.text),
    }));
    if (typeof edited === "object") {
      rows.push({ of: { ...edited, text: "" }, text: "", node: this.#editor(undefined, "") });
    }
    this.#labels = rows.map((row) => ({ ...row, leader: draw("path", {}) }));
    this.#leaders.replaceChildren(...this.#labels.map(({ leader }) => leader));
    this.#root.replaceChildren(this.#leaders, ...this.#labels.map(({ node }) => node));
    this.#root.querySelector("textarea")?.focus();
    this.#redraw();
  }

  #label(index: number, text: string): HTMLElement {
    const label = make("button", [make("b", `${index + 1}`), make("span", text)], {
      ...{ type: "button", class: "annotation", title: texts.places.changeTheTextDeleteRemoves },
      "aria-label": texts.places.annotationChangeIt(index + 1, text),
    });
    label.addEventListener("click", () => this.edit(index));
    label.addEventListener("keydown", ({ key }) => {
      if (key === "Delete" || key === "Backspace") removeAnnotation(index);
    });
    return label;
  }

  #editor(index: number | undefined, text: string): HTMLElement {
    return editor(text, {
      save: (typed) => {
        const edited = this.#edited.peek();
        this.end();
        if (index !== undefined) setAnnotationText(index, typed);
        else if (typeof edited === "object" && typed.trim() !== "") {
          addAnnotation({ ...edited, text: typed.trim() });
        }
        element("canvas").focus({ preventScroll: true });
      },
      cancel: () => {
        this.end();
        element("canvas").focus({ preventScroll: true });
      },
      remove:
        index === undefined
          ? undefined
          : () => {
              this.end();
              removeAnnotation(index);
            },
    });
  }

  /** Moves labels and leaders to where their points are seen. */
  update(viewport: Viewport, models: Models): void {
    const shown = this.#labels.flatMap((label, index) => {
      const at = placeOf(label.of, viewport, models);
      label.node.hidden = at === undefined;
      label.leader.toggleAttribute("hidden", at === undefined);
      const { node } = label;
      return at === undefined ? [] : [{ ...label, index, at, size: sizeOf(node) }];
    });
    const { clientWidth, clientHeight } = this.#root;
    const over = shown.length === 0 ? [] : boxesOver(this.#root);
    const corners = cornersOf(shown, [clientWidth, clientHeight], over);
    this.#drawn = shown.flatMap((label, place) => {
      const corner = corners[place];
      if (corner === undefined) return [];
      label.node.style.left = `${corner[0]}px`;
      label.node.style.top = `${corner[1]}px`;
      const end = leaderEnd(label, corner);
      label.leader.setAttribute("d", leaderPath(label.at, end));
      const { at, size, text } = label;
      return text === "" ? [] : [{ at, size, corner, text, number: label.index + 1 }];
    });
  }
}

/** What has a place of its own over the view, where no label stands. */
const OVER = ["legend", "context", "axes", "cut", "foot"] as const;

/** Where these are, in pixels of the layer. */
function boxesOver(layer: HTMLElement): Box[] {
  const { x, y } = layer.getBoundingClientRect();
  return OVER.flatMap((id) => {
    const { left, top, width, height } = element(id, Element).getBoundingClientRect();
    return width * height > 0
      ? [{ corner: [left - x, top - y] as const, size: [width, height] as const }]
      : [];
  });
}

/** The radius of the point of an annotation, in pixels. */
const POINT = 3.5;

/** A point, and the line from it to its label. */
function leaderPath([x, y]: readonly [number, number], end: readonly [number, number]): string {
  const half = `a${POINT} ${POINT} 0 1 0`;
  return `M${x - POINT} ${y}${half} ${2 * POINT} 0${half} ${-2 * POINT} 0M${x} ${y}L${end.join(" ")}`;
}

const sizeOf = ({ offsetWidth, offsetHeight }: HTMLElement): [number, number] => [
  offsetWidth,
  offsetHeight,
];

/** Where the point of an annotation is seen; undefined where its face is not drawn, or cut away. */
function placeOf(
  { side, face, point }: Omit<Annotation, "text">,
  viewport: Viewport,
  models: Models,
): [number, number] | undefined {
  const at = models.pointOf(side, face, point);
  if (at === undefined) return undefined;
  const isCut = models.planes.some((plane) => plane.distanceToPoint(at) < 0);
  return isCut ? undefined : viewport.project(at, side);
}
