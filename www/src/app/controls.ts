// The page's controls, connected to what they do.
import { connectRules } from "../check/ruleList.ts";
import { element } from "../common/elements.ts";
import { onFit } from "../controls/bestFit.ts";
import { onDisplay } from "../controls/display.ts";
import { assemble, onExplode } from "../controls/explode.ts";
import { onOptions } from "../controls/options.ts";
import { onPosition } from "../controls/position.ts";
import { onSection } from "../controls/section.ts";
import { onSource } from "../controls/sources.ts";
import { onExport } from "../export/exportPanel.ts";
import { exportAs } from "../export/exports.ts";
import { connectReportSettings } from "../export/report/settings.ts";
import { onShownUnit, onUnit } from "../files/units.ts";
import * as deviation from "../inspection/deviationPanel.ts";
import { connectBar } from "../layout/bar.ts";
import { connectSheet } from "../layout/sheet.ts";
import { connectShortcuts } from "../layout/shortcuts.ts";
import { connectSteps } from "../layout/steps.ts";
import { connectTheme } from "../layout/theme.ts";
import { connectTooltips } from "../layout/tooltips.ts";
import * as resultPanel from "../results/resultPanel.ts";
import { onLimit } from "../results/verdict.ts";
import type { Measurement } from "./measurement.ts";
import type { Opening } from "./opening.ts";
import type { Parts } from "./parts.ts";

export function connect(parts: Parts, measurement: Measurement, opening: Opening): void {
  for (const layout of [connectBar, connectSteps, connectSheet, connectShortcuts]) layout();
  connectTooltips();
  connectRules();
  connectTheme();
  connectReportSettings((why) => {
    element("export-note").textContent = why;
  });
  connectView(parts, measurement);
  connectMeasurement(parts, measurement);
  connectFiles(parts, measurement, opening);
  document.addEventListener("input", () => parts.past.record());
}

function connectView(parts: Parts, measurement: Measurement): void {
  const { view, views, past, probing, client } = parts;
  element("fit").addEventListener("click", () => view.fit());
  element("canvas").addEventListener("dblclick", () => view.fit());
  element("approach").addEventListener("click", () => view.approachArrow());
  element("add-view").addEventListener("click", () => views.add());
  resultPanel.onWhere(() => {
    view.point();
    view.approachArrow();
  });
  view.onCamera((place) => {
    past.camera = place;
  });
  const show = () => measurement.show();
  onDisplay((name) => view.look(name), show);
  onSection(
    {
      models: view.models,
      seen: () => view.seen,
      facing: (x, y) => view.facing(x, y),
      take: (click) => {
        probing.nextClick = click;
      },
    },
    show,
  );
  view.onPlace = assemble;
  onExplode(show, () => client.bodies());
  // What Escape ends first, as the choice of a face to cut by, has prevented this.
  window.addEventListener("keydown", ({ key, defaultPrevented }) => {
    if (key === "Escape" && !defaultPrevented) view.back();
  });
  deviation.onScale((painting) => measurement.paint(painting));
}

function connectMeasurement({ client, places }: Parts, measurement: Measurement): void {
  element("panel").addEventListener("submit", (event) => event.preventDefault());
  element("cancel").addEventListener("click", () => client.cancel());
  onLimit(() => {
    deviation.rescale();
    places.show();
    measurement.refine();
    measurement.boundFaces();
  });
  onOptions(() => {
    resultPanel.hideError();
    measurement.forgetFiner();
    measurement.measure();
  });
  onPosition(() => measurement.moved());
  onFit(
    () => measurement.fit({}),
    () => client.cancelFit(),
  );
}

function connectFiles(parts: Parts, measurement: Measurement, opening: Opening): void {
  const { view, views, faces, places, client, facts, overlap, check } = parts;
  const panels = [
    ...[parts.measureList, parts.annotationList, faces, facts],
    ...[overlap, check, parts.clearance],
  ];
  element("load-cancel").addEventListener("click", () => opening.stop());
  element("forget").addEventListener("click", () => opening.forget());
  onShownUnit(() => {
    parts.probing.clear();
    parts.measuring.end();
    faces.clear("idle", "");
    measurement.measure();
  });
  onUnit((side, unit) => opening.inUnit(side, unit));
  onSource((opened) => opening.take(opened));
  onExport((format) =>
    exportAs(format, {
      ...{ view, views, options: measurement.options, diff: faces.result },
      ...{ pins: view.pins.probes, result: view.result, models: view.models.drawn },
      measures: parts.measureList.exported,
      ...{ facts: facts.found, overlap: overlap.result, check: check.result },
      clearance: parts.clearance.found,
      tables: panels.flatMap(({ tables }) => tables),
      ...{ requestCsv: () => client.csv(), places: places.all },
    }),
  );
}
