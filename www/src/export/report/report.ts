// A report to print: verdict, files, pictures with their legends, worst places, faces and figures.

import { element, make } from "../../common/elements.ts";
import type { ReportTable } from "../../common/tables.ts";
import { painted } from "../../inspection/deviationPanel.ts";
import type { Verdict } from "../../results/judgement.ts";
import { texts } from "../../texts/index.ts";
import { type ReportView, stateNow } from "../views.ts";
import { table, terms } from "./dom.ts";
import { histogramDrawing } from "./drawings.ts";
import { chosenPaper, hasSection, logo } from "./settings.ts";
import { styleFor } from "./style.ts";

type Terms = readonly (readonly [term: string, text: string])[];

/** What the report contains besides what the page shows. */
export interface ReportContent {
  views: readonly ReportView[];
  /** Pictures of the worst places. */
  places: readonly { title: string; picture: string }[];
  verdict: { verdict: Verdict | undefined; title: string; text: string; terms: Terms };
  files: readonly { title: string; terms: Terms }[];
  /** A face a row. */
  faces: { head: readonly string[]; rows: readonly (readonly string[])[] };
  /** A pinned point a row. */
  pins: readonly (readonly string[])[];
  /** What else was asked for: facts, checks, parts. */
  tables: readonly ReportTable[];
  settings: Terms;
}

/** Returns the report as a page of its own, which needs nothing else. */
export function reportOf(content: ReportContent): Blob {
  const page = document.implementation.createHTMLDocument(titleOf());
  page.documentElement.lang = texts.language;
  page.head.append(make("meta", [], { charset: "utf-8" }), make("style", styleFor(chosenPaper())));
  page.body.append(...sections(content));
  return new Blob(["<!doctype html>\n", page.documentElement.outerHTML], { type: "text/html" });
}

const value = (id: string): string => element(id, HTMLInputElement).value.trim();
const text = (id: string): string => element(id).textContent?.trim() ?? "";

const titleOf = (): string => {
  const title = value("report-title") || texts.report.comparison;
  return `${title}${value("report-part") === "" ? "" : `: ${value("report-part")}`}`;
};

function* sections(content: ReportContent) {
  const { views, places, verdict, files, faces, pins, tables, settings } = content;
  yield make("p", [make("button", texts.report.printOrSaveAsPDF, { onclick: "print()" })], {
    class: "screen",
  });
  const picture = logo();
  yield make("header", [
    make("h1", titleOf()),
    ...(picture === undefined ? [] : [make("img", [], { src: picture, alt: "" })]),
  ]);
  yield terms([
    [texts.report.part, value("report-part")],
    [texts.report.operator, value("report-operator")],
    [texts.report.date, value("report-date") || new Date().toISOString().slice(0, 10)],
  ]);
  yield make(
    "section",
    [
      make("p", [make("span", verdict.title, { class: "badge" }), verdict.text]),
      terms(verdict.terms),
    ],
    { class: "card", "data-verdict": verdict.verdict ?? "" },
  );
  for (const { title, terms: of } of files) yield* [make("h2", title), terms(of)];
  if (hasSection("views")) {
    yield make("h2", texts.report.views);
    for (const view of views) yield figure(view);
  }
  if (places.length > 0 && hasSection("places")) {
    yield make("h2", texts.report.worstPlaces);
    yield make(
      "div",
      places.map(({ title, picture }) =>
        make("figure", [make("figcaption", title), make("img", [], { src: picture, alt: title })]),
      ),
      { class: "places" },
    );
  }
  const legend = painted()?.legend;
  if (legend !== undefined && hasSection("histogram")) {
    yield make("h2", texts.report.deviationOverTheAreaEstimates);
    const drawing = make("figure", [make("figcaption", legend.title)]);
    drawing.append(histogramDrawing(legend));
    yield* [drawing, element("statistics").cloneNode(true), make("p", text("beyond-limit"))];
  }
  if (faces.rows.length > 0 && hasSection("faces"))
    yield* [make("h2", texts.report.faces), table(faces.head, faces.rows)];
  if (pins.length > 0 && hasSection("points")) {
    yield* [
      make("h2", texts.report.points),
      table([texts.report.point, texts.report.place, texts.report.deviation], pins),
    ];
  }
  for (const { title, head, rows } of hasSection("tables") ? tables : []) {
    yield* [make("h2", title), ...(rows.length > 0 ? [table(head, rows)] : [])];
  }
  if (hasSection("settings")) {
    yield* [make("h2", texts.report.settings), terms(settings)];
    yield* [make("h2", texts.report.details), element("facts").cloneNode(true)];
  }
  yield make("footer", texts.report.madeBy(VERSION, text("engine")));
}

function figure({ title, picture, legend, state, section }: ReportView): HTMLElement {
  const body = make("div", [make("img", [], { src: picture, alt: title })], { class: "view" });
  if (legend !== undefined) body.append(legend.drawing.cloneNode(true));
  const then = state === stateNow() ? undefined : texts.report.asItWasAdded;
  const said = [legend?.title, section, then].filter((part) => part !== undefined).join("; ");
  const caption = said === "" ? title : `${title}: ${said}`;
  return make("figure", [make("figcaption", caption), body]);
}
