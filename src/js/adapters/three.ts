import { HausdorffError } from "../error.js";
import type { ControlPoint, InterchangeModel } from "../model/surface.js";

/** The parts of three's `NURBSSurface` that are used. */
export interface ThreeNurbsSurface {
  degree1: number;
  degree2: number;
  knots1: readonly number[];
  knots2: readonly number[];
  /** `controlPoints[i][j]`, i along the first direction; not multiplied by w. */
  controlPoints: readonly (readonly { x: number; y: number; z: number; w: number }[])[];
}

/**
 * A `NURBSSurface` of three/examples/jsm/curves. For `hd.model`.
 *
 * @throws {HausdorffError} `ARGUMENT_INVALID` for another object.
 */
export function fromThree(surface: ThreeNurbsSurface): InterchangeModel {
  const { degree1, degree2, knots1, knots2, controlPoints } = surface ?? {};
  if (!controlPoints || !knots1 || !knots2) {
    throw new HausdorffError("ARGUMENT_INVALID", "expected a NURBSSurface of three");
  }
  const ctrl = controlPoints.map((row) => row.map(({ x, y, z, w }): ControlPoint => [x, y, z, w]));
  return {
    surfaces: [{ degree: [degree1, degree2], knots_u: knots1, knots_v: knots2, ctrl }],
  };
}
