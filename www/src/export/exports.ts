// What each export contains.
import type { DiffResult, DistanceResult } from "nurbs-hausdorff";
import { metresPerUnit } from "../files/fileNotes.ts";
import { deviationSummary, painted } from "../inspection/deviationPanel.ts";
import type { View } from "../scene/view.ts";
import { formState } from "../state/formState.ts";
import type { PlainOptions, Probe } from "../worker/protocol.ts";
import { dataUrl, download, pictureOf } from "./download.ts";
import type { ExportFormat } from "./exportPanel.ts";
import { gltfOf } from "./gltf.ts";
import { reportOf } from "./report.ts";

export interface ExportedState {
  view: View;
  canvas: HTMLCanvasElement;
  result: DistanceResult | undefined;
  diff: DiffResult | undefined;
  pins: Probe[];
  options: PlainOptions;
  /** The names of the models. */
  names: { a: string; b: string };
  /** Requests the samples from the worker, which offers them when it has the table. */
  requestCsv: () => void;
}

const NAME = "hausdorff";

/** Makes a file and offers it. */
export async function exportAs(format: ExportFormat, state: ExportedState): Promise<void> {
  switch (format) {
    case "json":
      download(`${NAME}.json`, jsonOf(state));
      break;
    case "csv":
      if (painted() === undefined) {
        throw new Error("The table contains the samples of the deviation: show it first.");
      }
      state.requestCsv();
      break;
    case "png":
      download(`${NAME}.png`, await picture(state));
      break;
    case "gltf":
      download(`${NAME}.glb`, await gltfOf(state.view.models, painted(), metresPerUnit()));
      break;
    case "report": {
      const image = await dataUrl(await picture(state));
      const content = { picture: image, settings: settingsOf(state) };
      download(`${NAME}-report.html`, reportOf({ ...content, deviation: deviationSummary() }));
      break;
    }
  }
}

function picture({ view, canvas }: ExportedState): Promise<Blob> {
  view.renderForExport();
  return pictureOf(canvas);
}

function jsonOf({ result, diff, pins, options, names }: ExportedState): Blob {
  const content = { models: names, options, state: formState(), result, faces: diff, pins };
  return new Blob([JSON.stringify(content, undefined, 2)], { type: "application/json" });
}

function settingsOf({ names, options }: ExportedState): [string, string][] {
  const { method, relativeTolerance, symmetric, transform } = options;
  const rotation = transform?.rotation ?? [0, 0, 0, 1];
  return [
    ["A", names.a],
    ["B", names.b],
    ["method", `${method}`],
    ["tolerance", `${relativeTolerance} of the diagonal`],
    ["distance", symmetric ? "symmetric (max of A to B, B to A)" : "directed, A to B"],
    ["translation of A", (transform?.translation ?? [0, 0, 0]).join(", ")],
    ["rotation of A, quaternion", rotation.join(", ")],
  ];
}
