import { HausdorffError } from "../error.js";
import type { ControlPoint, InterchangeModel } from "../model/surface.js";

/** The parts of verb's `NurbsSurfaceData` that are used. */
export interface VerbSurfaceData {
  degreeU: number;
  degreeV: number;
  knotsU: readonly number[];
  knotsV: readonly number[];
  /** Homogeneous: x w, y w, z w, w. */
  controlPoints: readonly (readonly (readonly number[])[])[];
}

/** A `verb.geom.NurbsSurface`. */
export interface VerbSurface {
  asNurbs(): VerbSurfaceData;
}

/**
 * A `NurbsSurface` of verb. For `hd.model`.
 *
 * @throws {HausdorffError} `ARGUMENT_INVALID` for another object.
 */
export function fromVerb(surface: VerbSurface): InterchangeModel {
  if (typeof surface?.asNurbs !== "function") {
    throw new HausdorffError("ARGUMENT_INVALID", "expected a NurbsSurface of verb");
  }
  const { degreeU, degreeV, knotsU, knotsV, controlPoints } = surface.asNurbs();
  const point = ([x = 0, y = 0, z = 0, w = 1]: readonly number[]): ControlPoint => [
    x / w,
    y / w,
    z / w,
    w,
  ];
  const ctrl = controlPoints.map((row) => row.map(point));
  return {
    surfaces: [{ degree: [degreeU, degreeV], knots_u: knotsU, knots_v: knotsV, ctrl }],
  };
}
