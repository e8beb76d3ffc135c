// The round surface that a face of a model lies on, by the points that are drawn of it.
import type { DisplayModel } from "../worker/protocol.ts";
import type { Vector } from "./fit/linear.ts";
import { type Fit, fitOf, type Oriented } from "./fit/surfaces.ts";

/** Points of a face to which a surface is fitted, at most: of more, evenly chosen ones. */
const MAX_POINTS = 20_000;
/** The relative rounding of the coordinates of drawn points, which are in float32. */
const FLOAT32 = 2 ** -23;

export interface FaceFit {
  fit: Fit;
  /** The number of points that it was fitted to. */
  points: number;
}

const known = new WeakMap<DisplayModel, Map<number, FaceFit | undefined>>();

/** The surface in coordinates relative to the tessellation's origin; undefined where none fits. */
export function faceFit(model: DisplayModel, face: number): FaceFit | undefined {
  let fits = known.get(model);
  if (fits === undefined) {
    fits = new Map();
    known.set(model, fits);
  }
  if (!fits.has(face)) fits.set(face, fitted(model, face));
  return fits.get(face);
}

function fitted({ tessellation, box }: DisplayModel, face: number): FaceFit | undefined {
  const points = pointsOf(tessellation, face);
  const size = Math.max(...box.max.map((end, axis) => end - (box.min[axis] ?? 0)));
  const fit = fitOf(points, FLOAT32 * size);
  return fit && { fit, points: points.length };
}

function pointsOf(
  { positions, normals, indices, faces }: DisplayModel["tessellation"],
  face: number,
): Oriented[] {
  const { firstIndex = 0, indexCount = 0 } = faces[face] ?? {};
  const vertices = [...new Set(indices.subarray(firstIndex, firstIndex + indexCount))];
  const step = Math.max(1, Math.ceil(vertices.length / MAX_POINTS));
  const at = (all: Float32Array, vertex: number): Vector => [
    all[3 * vertex] ?? 0,
    all[3 * vertex + 1] ?? 0,
    all[3 * vertex + 2] ?? 0,
  ];
  return vertices
    .filter((_, index) => index % step === 0)
    .map((vertex) => ({ point: at(positions, vertex), normal: at(normals, vertex) }));
}
