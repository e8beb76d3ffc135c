// The list of all annotations, in the step of the report: to look at, to change and to remove.

import { effect } from "@preact/signals-core";
import { element, make } from "../common/elements.ts";
import type { ReportTable } from "../common/tables.ts";
import { distanceText } from "../common/text/numbers.ts";
import { texts } from "../texts/index.ts";
import type { Side } from "../worker/protocol.ts";
import { type Annotation, annotations, removeAnnotation } from "./annotations.ts";

export interface ListListener {
  look: (annotation: Annotation) => void;
  edit: (index: number) => void;
  /** The name of a face. */
  nameOf: (side: Side, face: number) => string;
}

export class AnnotationList {
  readonly #listener: ListListener;

  constructor(listener: ListListener) {
    this.#listener = listener;
    effect(() => this.#show(annotations.value));
  }

  #show(all: readonly Annotation[]): void {
    element("annotation-list").replaceChildren(...all.map((one, index) => this.#row(one, index)));
    element("annotations-empty").hidden = all.length > 0;
    element("annotation-count").textContent = all.length === 0 ? "" : `${all.length}`;
  }

  #row(annotation: Annotation, index: number): HTMLElement {
    const { text, side } = annotation;
    const number = index + 1;
    const look = make("button", [make("b", `${number}`), make("span", text)], {
      ...{ type: "button", class: "look", title: texts.places.lookAtItFromNear },
    });
    look.addEventListener("click", () => this.#listener.look(annotation));
    const letter = make("b", side.toUpperCase(), { class: side });
    return make("li", [
      ...[letter, look],
      act("✎", texts.places.changeAnnotation(number), () => this.#listener.edit(index)),
      act("×", texts.places.removeAnnotation(number), () => removeAnnotation(index)),
    ]);
  }

  /** All of them, for the report; coordinates are those of the model as its file has it. */
  get tables(): ReportTable[] {
    const all = annotations.peek();
    if (all.length === 0) return [];
    const rows = all.map(({ side, face, point, text }, index) => [
      ...[`${index + 1}`, text],
      `${side.toUpperCase()} ${this.#listener.nameOf(side, face)}`,
      point.map((at) => distanceText(at, Math.hypot(...point))).join(", "),
    ]);
    return [
      {
        title: texts.places.annotations,
        head: [texts.places.number, texts.places.text, texts.places.face, texts.places.atInItsFile],
        rows,
      },
    ];
  }
}

function act(text: string, name: string, click: () => void): HTMLElement {
  const button = make("button", text, { type: "button", "aria-label": name, title: name });
  button.addEventListener("click", click);
  return button;
}
