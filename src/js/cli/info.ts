import { translating } from "../error.js";
import { PreparedModel } from "../wasm/nurbs_hausdorff.js";
import type { Invocation } from "./arguments.js";
import { convertFile } from "./files.js";
import { full } from "./numbers.js";
import { print, printJson } from "./output.js";

/** A model in numbers, as the native command prints it. */
interface ModelInfo {
  name: string | null;
  unit: number | null;
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
  loops: number;
  patches: number;
}

/** Prints the surfaces, patches and bounding box of a model. */
export async function info(values: Invocation["values"]): Promise<void> {
  const { json } = await convertFile(String(values.get("model")));
  const info = translating(() => PreparedModel.info(json) as ModelInfo);
  if (values.has("json")) printJson(info);
  else print(text(info));
}

function text({ name, unit, surfaces, patches, boundingBox, diagonal }: ModelInfo): string {
  const [min, max] = boundingBox.map((corner) => `[${corner.map(full).join(", ")}]`);
  const lines = [
    `model     ${name ?? "without a name"}`,
    `box       ${min} to ${max}, diagonal ${full(diagonal)}`,
    ...(unit === null ? [] : [`unit      ${full(unit)} m`]),
    `surfaces  ${surfaces.length}, ${patches} Bézier patches`,
    ...surfaces.map(surfaceLine),
  ];
  return `${lines.join("\n")}\n`;
}

function surfaceLine(surface: SurfaceInfo, index: number): string {
  const { degree, counts, domain, rational, clamped, loops, patches } = surface;
  const [u, v] = domain.map((ends) => `[${ends.map(full).join(", ")}]`);
  const columns = [
    String(index).padStart(8),
    `degree ${degree.join(",")}`,
    `net ${counts.join("x")}`,
    rational ? "rational" : "polynomial",
    clamped.every(Boolean) ? "clamped" : "unclamped",
    `${u} x ${v}`,
    ...(loops === 0 ? [] : [`${loops} loops`]),
    `${patches} patches`,
  ];
  return columns.join("  ");
}
