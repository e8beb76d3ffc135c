import { translating } from "../../error.js";
import type { Area } from "../../model/area.js";
import { PreparedModel } from "../../wasm/nurbs_hausdorff.js";
import type { Invocation } from "../arguments/arguments.js";
import { convertFile } from "../files.js";
import { ofFile, printJson } from "../output/json.js";
import { full, short } from "../output/numbers.js";
import { print } from "../output/output.js";

/** A model in numbers, as the native command prints it. */
interface ModelInfo {
  name: string | null;
  unit?: number;
  /** Number of trimmed faces. */
  trimmed: number;
  gap: number;
  /** Bound on the distance between the trimmed faces and the pieces measured. */
  deviation: number;
  faces: FaceInfo[];
  patches: number;
  boundingBox: [number[], number[]];
  diagonal: number;
  /** The area of all faces, in squares of the model unit. */
  area: Area;
}

interface FaceInfo {
  degree: [number, number];
  counts: [number, number];
  domain: [[number, number], [number, number]];
  rational: boolean;
  clamped: [boolean, boolean];
  /** Numbers of curves of the loops. */
  trim?: number[];
  faceName?: string;
  color?: [number, number, number];
  patches: number;
  area: Area;
}

/** Prints the faces, patches, areas and bounding box of a model. */
export async function info(values: Invocation["values"]): Promise<void> {
  const { json, report, source } = await convertFile(String(values.get("model")));
  const info = translating(() => PreparedModel.info(json) as ModelInfo);
  if (values.has("json")) printJson(ofFile({ ...info, skipped: report.skipped }, source));
  else print(text(info));
}

function text(info: ModelInfo): string {
  const { name, unit, trimmed, gap, deviation, faces, patches } = info;
  const [min, max] = info.boundingBox.map((corner) => `[${corner.map(full).join(", ")}]`);
  const trims = trimmed > 0 ? `${trimmed} trimmed, ` : "";
  const lines = [
    `model     ${name ?? "without a name"}`,
    `box       ${min} to ${max}, diagonal ${full(info.diagonal)}`,
    ...(unit === undefined ? [] : [`unit      ${full(unit)} m`]),
    `area      ${interval(info.area)}`,
    `faces     ${faces.length}, ${trims}${patches} Bézier patches`,
    ...(trimmed > 0 || gap > 0
      ? [`gap       ${full(gap)}, deviation of the pieces ${full(deviation)}`]
      : []),
    ...faces.map(faceLine),
  ];
  return `${lines.join("\n")}\n`;
}

/** Both ends in six digits. */
function interval({ lower, upper }: Area): string {
  return `${short(lower)} to ${short(upper)}`;
}

function faceLine(face: FaceInfo, index: number): string {
  const { degree, counts, domain, rational, clamped, trim, faceName, patches } = face;
  const [u, v] = domain.map((ends) => `[${ends.map(full).join(", ")}]`);
  const columns = [
    String(index).padStart(8),
    `degree ${degree.join(",")}`,
    `net ${counts.join("x")}`,
    rational ? "rational" : "polynomial",
    clamped.every(Boolean) ? "clamped" : "unclamped",
    `${u} x ${v}`,
    `${patches} patches`,
    `area ${short(face.area.lower)}`,
    ...(trim ? [`${trim.length} loops of ${trim.reduce((sum, one) => sum + one, 0)} curves`] : []),
    ...(faceName ? [faceName] : []),
  ];
  return columns.join("  ");
}
