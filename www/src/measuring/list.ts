// The list of all that was measured, in the step of the report: to look at and to remove.
import { effect } from "@preact/signals-core";
import { element, make } from "../common/elements.ts";
import type { ReportTable } from "../common/tables.ts";
import type { View } from "../scene/view.ts";
import { texts } from "../texts/index.ts";
import { type Measure, measures, removeMeasure } from "./measures.ts";
import type { Value } from "./said.ts";
import { arrowOf } from "./tool.ts";
import { measured } from "./values.ts";

const own = texts.measuring;

export class MeasureList {
  readonly #view: View;
  /** What the list says. */
  #shown = "";

  constructor(view: View) {
    this.#view = view;
    effect(() => this.#show(measures.value));
    // Numbers follow the position of A, the models and the unit.
    view.follow(() => this.#show(measures.peek()));
  }

  #values(all: readonly Measure[]): (Value | undefined)[] {
    return all.map((measure) => measured(measure, this.#view.models));
  }

  #show(all: readonly Measure[]): void {
    const values = this.#values(all);
    const shown = JSON.stringify(values.map((value) => [value?.text, value?.of]));
    if (shown === this.#shown) return;
    this.#shown = shown;
    const rows = values.flatMap((value, index) => (value ? [this.#row(value, index)] : []));
    element("measure-list").replaceChildren(...rows);
    element("measures-empty").hidden = rows.length > 0;
    element("measure-count").textContent = rows.length === 0 ? "" : `${rows.length}`;
  }

  #row({ text, of }: Value, index: number): HTMLElement {
    const number = index + 1;
    const look = make("button", [make("b", `${number}`), make("span", text)], {
      ...{ type: "button", class: "look", title: `${of}. ${own.look}` },
    });
    look.addEventListener("click", () => this.#look(index));
    const name = own.remove(number);
    const remove = make("button", "×", { type: "button", "aria-label": name, title: name });
    remove.addEventListener("click", () => removeMeasure(index));
    return make("li", [look, remove]);
  }

  #look(index: number): void {
    const measure = measures.peek()[index];
    const value = measure && measured(measure, this.#view.models);
    if (value === undefined) return;
    this.#view.approach(...arrowOf(value, this.#view.models.center));
  }

  /** What the JSON has of each. */
  get exported(): (Measure & { text: string })[] {
    const all = measures.peek();
    const values = this.#values(all);
    return all.flatMap((measure, index) => {
      const value = values[index];
      return value === undefined ? [] : [{ ...measure, text: value.text }];
    });
  }

  /** All of them, for the report. */
  get tables(): ReportTable[] {
    const rows = this.#values(measures.peek()).flatMap((value, index) =>
      value === undefined ? [] : [[`${index + 1}`, value.text, value.of]],
    );
    return rows.length === 0 ? [] : [{ title: own.table, head: own.head, rows }];
  }
}
