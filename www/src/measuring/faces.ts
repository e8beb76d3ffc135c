// The round surface that a face of a model lies on: that of its exact surface, with what is certain of it, or one that
// fits the points that are drawn of it.

import type { FaceForm } from "nurbs-hausdorff";
import { FLOAT32_STEP } from "../common/float32.ts";
import type { DisplayModel } from "../worker/protocol.ts";
import { minus, type Vector } from "./fit/linear.ts";
import { type Fit, fitOf, type Oriented } from "./fit/surfaces.ts";

/** Points of a face to which a surface is fitted, at most: of more, evenly chosen ones. */
const MAX_POINTS = 20_000;

/** A round surface, in coordinates relative to the tessellation's origin. */
export interface RoundFace {
  fit: Fit;
  /** The number of drawn points that it was fitted to; none of exact surfaces, of which `fit.residual` is certain. */
  points?: number;
  /** The certain bounds of the radius of an exact surface: of a torus that of its tube; none of a cone. */
  radius?: readonly [number, number];
}

const known = new WeakMap<DisplayModel, Map<number, RoundFace | undefined>>();

/** The round surface of a face; undefined where there is none. */
export function roundFace(model: DisplayModel, face: number): RoundFace | undefined {
  let faces = known.get(model);
  if (faces === undefined) {
    faces = new Map();
    known.set(model, faces);
  }
  if (!faces.has(face)) {
    const form = model.faceForms[face];
    faces.set(face, form ? exact(form, model.tessellation.origin) : fitted(model, face));
  }
  return faces.get(face);
}

function exact(form: FaceForm, origin: Vector): RoundFace | undefined {
  if (form.kind === "plane") return undefined;
  const center = minus(form.point, origin);
  if (form.kind === "cone") {
    const { direction, halfAngle, deviation } = form;
    const angle = (halfAngle * Math.PI) / 180;
    return { fit: { kind: "cone", center, axis: direction, angle, residual: deviation } };
  }
  const { lower, upper } = form.radius;
  const sizes = { radius: (lower + upper) / 2, residual: (upper - lower) / 2 };
  const bounds = [lower, upper] as const;
  if (form.kind === "sphere") return { fit: { kind: "sphere", center, ...sizes }, radius: bounds };
  const axis = form.direction;
  if (form.kind === "cylinder")
    return { fit: { kind: "cylinder", center, axis, ...sizes }, radius: bounds };
  const around = form.majorRadius;
  return { fit: { kind: "torus", center, axis, around, ...sizes }, radius: bounds };
}

function fitted({ tessellation, box }: DisplayModel, face: number): RoundFace | undefined {
  const points = pointsOf(tessellation, face);
  const size = Math.max(...box.max.map((end, axis) => end - (box.min[axis] ?? 0)));
  const fit = fitOf(points, FLOAT32_STEP * size);
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
