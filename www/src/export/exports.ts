// What each export contains.

import type {
  CheckResult,
  DiffResult,
  DistanceResult,
  OverlapResult,
  Vector3,
} from "nurbs-hausdorff";
import { annotations } from "../annotations/annotations.ts";
import type { FoundClearance } from "../clearance/clearancePanel.ts";
import type { ReportTable } from "../common/tables.ts";
import { metresPerUnit } from "../files/units.ts";
import { painted } from "../inspection/deviationPanel.ts";
import { outwardNormal } from "../inspection/places/outwards.ts";
import { sizeText } from "../inspection/places/placeList.ts";
import type { Place } from "../inspection/places/places.ts";
import type { MeasureList } from "../measuring/list.ts";
import type { View } from "../scene/view.ts";
import { formState } from "../state/formState.ts";
import { texts } from "../texts/index.ts";
import type { DisplayModel, ModelFacts, PlainOptions, Probe, Sides } from "../worker/protocol.ts";
import { download, openMade } from "./download.ts";
import type { ExportFormat } from "./exportPanel.ts";
import { gltfOf } from "./gltf.ts";
import { contentOf } from "./report/content.ts";
import { reportOf } from "./report/report.ts";
import type { Views } from "./views.ts";

export interface ExportedState {
  view: View;
  views: Views;
  result: DistanceResult | undefined;
  diff: DiffResult | undefined;
  facts: Sides<ModelFacts> | undefined;
  overlap: OverlapResult | undefined;
  check: CheckResult | undefined;
  /** The clearance, where it is measured instead of the deviation. */
  clearance: FoundClearance | undefined;
  /** What the panels of these show, for the report. */
  tables: readonly ReportTable[];
  pins: Probe[];
  measures: MeasureList["exported"];
  /** The worst place of each face. */
  places: Place[];
  options: PlainOptions;
  models: Sides<DisplayModel>;
  /** Requests the vertices of the maps from the worker, which offers them when it has the table. */
  requestCsv: () => void;
}

const NAME = "hausdorff";
const REPORT = `${NAME}-report.html`;
/** The worst places that the report has pictures of. */
const PICTURED = 4;

/** Makes a file and offers it. */
export async function exportAs(format: ExportFormat, state: ExportedState): Promise<void> {
  const { view, views } = state;
  switch (format) {
    case "json":
      download(`${NAME}.json`, jsonOf(state));
      break;
    case "csv":
      if (painted() === undefined) {
        throw new Error(texts.report.theTableContainsTheDeviations);
      }
      state.requestCsv();
      break;
    case "png":
      download(`${NAME}.png`, await views.picture());
      break;
    case "gltf":
      download(
        `${NAME}.glb`,
        await standing(view, () => gltfOf(view.models, painted(), metresPerUnit())),
      );
      break;
    case "report":
      download(REPORT, await reportFrom(state));
      break;
    case "pages":
      await openMade(REPORT, () => reportFrom(state));
      break;
  }
}

async function reportFrom(state: ExportedState): Promise<Blob> {
  const content = { ...(await contentOf(state)), views: await state.views.all() };
  const places = await standing(state.view, () => placesOf(state));
  return reportOf({ ...content, places });
}

/** Does what is about models as they stand, also while bodies are shown apart. */
async function standing<T>({ models }: View, work: () => Promise<T>): Promise<T> {
  const { part } = models.explosion;
  models.explode(0);
  try {
    return await work();
  } finally {
    models.explode(part);
  }
}

/** Pictures of the worst places, each with a mark, after which the view is where it was. */
async function placesOf({ view, views, places, result }: ExportedState) {
  const { camera } = view;
  const all: { title: string; picture: string }[] = [];
  for (const place of places.slice(0, PICTURED)) {
    const map = painted()?.maps[place.side];
    if (map === undefined) break;
    const at = (all: Float32Array): Vector3 => {
      const [x = 0, y = 0, z = 0] = all.subarray(3 * place.vertex, 3 * place.vertex + 3);
      return [x, y, z];
    };
    const { models } = view;
    const point = models.place(place.side, at(map.positions));
    view.lookAt(point, outwardNormal(models, map, place));
    const size = sizeText(place, result?.diagonal ?? 1);
    const title = `${place.side.toUpperCase()} ${place.name}: ${size}`;
    const unmark = view.mark(point);
    const { picture } = await views.take(title);
    unmark();
    all.push({ title, picture });
  }
  view.camera = camera;
  return all;
}

function jsonOf(state: ExportedState): Blob {
  const { result, diff, facts, overlap, check, clearance } = state;
  const { pins, measures, options, models } = state;
  const nameOf = (model: DisplayModel | undefined) => {
    const source = model?.source;
    if (source === undefined) return "";
    return "shape" in source ? source.shape : source.file.name;
  };
  const names = { a: nameOf(models.a), b: nameOf(models.b) };
  const content = {
    ...{ models: names, options, state: formState(), result, faces: diff },
    ...{ facts, overlap, check, clearance, pins, measures, annotations: annotations.peek() },
  };
  return new Blob([JSON.stringify(content, undefined, 2)], { type: "application/json" });
}
