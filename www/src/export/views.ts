// The views that the user chose for the report, each with the legend that it had.

import type { DrawnLabel } from "../annotations/layer.ts";
import { labelled } from "../annotations/picture.ts";
import { element } from "../common/elements.ts";
import { sectionText } from "../controls/section.ts";
import { painted } from "../inspection/deviationPanel.ts";
import type { View } from "../scene/view.ts";
import { formState } from "../state/formState.ts";
import { texts } from "../texts/index.ts";
import { dataUrl, pictureOf } from "./download.ts";
import { legendDrawing } from "./report/drawings.ts";

/** A picture with what its colours mean. */
export interface ReportView {
  title: string;
  /** The picture's address. */
  picture: string;
  /** What the colours mean, and their legend in the unit that was shown. */
  legend: { title: string; drawing: SVGElement } | undefined;
  /** What is allowed, and where A was. */
  state: string;
  /** Where the models are cut open. */
  section: string | undefined;
}

/** What the report shows without a view, and what its button says: those of the page. */
const NONE = element("view-count").textContent;
const add = element("add-view").querySelector(".text");
const ADD = add?.textContent ?? "";

/** What a view shows colours of, as the form has it. */
export function stateNow(): string {
  const all = new URLSearchParams(formState());
  return SHOWN.map((name) => all.get(name) ?? "").join();
}

/** The names of its controls. */
const SHOWN = ["a", "b", "limit", "limit-below", "own-limits", "shown-unit"].concat(
  ["x", "y", "z"].flatMap((axis) => [axis, `turn-${axis}`]),
);

export class Views {
  readonly #view: View;
  readonly #canvas: HTMLCanvasElement;
  readonly #labels: () => readonly DrawnLabel[];
  #chosen: ReportView[] = [];

  /** `labels` are those over the view, which the canvas does not show. */
  constructor(view: View, canvas: HTMLCanvasElement, labels: () => readonly DrawnLabel[]) {
    this.#labels = labels;
    this.#view = view;
    this.#canvas = canvas;
  }

  /** The views chosen; without one, what is seen now. */
  async all(): Promise<ReportView[]> {
    return this.#chosen.length > 0 ? this.#chosen : [await this.take(texts.report.asSeen)];
  }

  /** Adds what is seen now. Others may be added while its picture is made. */
  async add(): Promise<void> {
    const view = await this.take("");
    this.#chosen = [
      ...this.#chosen,
      { ...view, title: texts.report.view(this.#chosen.length + 1) },
    ];
    this.#show();
    // What is done with the report; of a sheet, which is folded, the verdict stays in sight.
    const isSheet = element("sheet").offsetParent !== null;
    if (!isSheet) element("export").scrollIntoView({ block: "nearest" });
  }

  clear(): void {
    this.#chosen = [];
    this.#show();
  }

  /** Returns what is seen now. */
  async take(title: string): Promise<ReportView> {
    const section = sectionText(this.#view.models);
    const picture = await dataUrl(await this.picture());
    const legend = painted()?.legend;
    return {
      ...{ title, picture, section, state: stateNow() },
      legend: legend && { title: legend.title, drawing: legendDrawing(legend) },
    };
  }

  /** The picture of the view, PNG. */
  picture(): Promise<Blob> {
    this.#view.renderForExport();
    return pictureOf(labelled(this.#canvas, this.#labels()));
  }

  #show(): void {
    const { length } = this.#chosen;
    element("view-count").textContent = length === 0 ? NONE : texts.report.viewsInReport(length);
    // The panel may be elsewhere.
    if (add) add.textContent = length === 0 ? ADD : `${ADD} (${length})`;
  }
}
