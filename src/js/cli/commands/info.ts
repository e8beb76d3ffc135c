import { translating } from "../../error.js";
import { PreparedModel } from "../../wasm/nurbs_hausdorff.js";
import type { Invocation } from "../arguments/arguments.js";
import { convertFile } from "../files.js";
import { full } from "../output/numbers.js";
import { print, printJson } from "../output/output.js";

/** A model in numbers, as the native command prints it. */
interface ModelInfo {
  name: string | null;
  unit?: number;
  /** Number of trimmed faces. */
  trimmed: number;
  gap: number;
  /** Bound on the distance between the trimmed faces and the pieces measured. */
  deviation: number;
  surfaces: SurfaceInfo[];
  patches: number;
  boundingBox: [number[], number[]];
  diagonal: number;
}

interface SurfaceInfo {
  degree: [number, number];
  counts: [number, number];
  domain: [[number, number], [number, number]];
  rational: boolean;
  clamped: [boolean, boolean];
  /** Numbers of curves of the loops. */
  trim?: number[];
  part?: string;
  patches: number;
}

/** Prints the surfaces, patches and bounding box of a model. */
export async function info(values: Invocation["values"]): Promise<void> {
  const { json } = await convertFile(String(values.get("model")));
  const info = translating(() => PreparedModel.info(json) as ModelInfo);
  if (values.has("json")) printJson(info);
  else print(text(info));
}

function text(info: ModelInfo): string {
  const { name, unit, trimmed, gap, deviation, surfaces, patches } = info;
  const [min, max] = info.boundingBox.map((corner) => `[${corner.map(full).join(", ")}]`);
  const faces = trimmed > 0 ? `${trimmed} trimmed, ` : "";
  const lines = [
    `model     ${name ?? "without a name"}`,
    `box       ${min} to ${max}, diagonal ${full(info.diagonal)}`,
    ...(unit === undefined ? [] : [`unit      ${full(unit)} m`]),
    `surfaces  ${surfaces.length}, ${faces}${patches} Bézier patches`,
    ...(trimmed > 0 || gap > 0
      ? [`gap       ${full(gap)}, deviation of the pieces ${full(deviation)}`]
      : []),
    ...surfaces.map(surfaceLine),
  ];
  return `${lines.join("\n")}\n`;
}

function surfaceLine(surface: SurfaceInfo, index: number): string {
  const { degree, counts, domain, rational, clamped, trim, part, patches } = surface;
  const [u, v] = domain.map((ends) => `[${ends.map(full).join(", ")}]`);
  const columns = [
    String(index).padStart(8),
    `degree ${degree.join(",")}`,
    `net ${counts.join("x")}`,
    rational ? "rational" : "polynomial",
    clamped.every(Boolean) ? "clamped" : "unclamped",
    `${u} x ${v}`,
    `${patches} patches`,
    ...(trim ? [`${trim.length} loops of ${trim.reduce((sum, one) => sum + one, 0)} curves`] : []),
    ...(part ? [part] : []),
  ];
  return columns.join("  ");
}
