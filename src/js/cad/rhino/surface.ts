import { HausdorffError } from "../../error.js";
import type { ControlPoint, InterchangeSurface } from "../../model/surface.js";
import { withEndKnots } from "./curves/curve.js";
import type { RhinoNurbsSurface, RhinoSurface } from "./types.js";

/**
 * The NURBS form that rhino3dm makes of a surface.
 *
 * @throws {HausdorffError} `CAD_UNREADABLE` if it makes none.
 */
export function nurbsOf(surface: RhinoSurface | null): RhinoNurbsSurface {
  const nurbs = surface?.toNurbsSurface() ?? null;
  if (nurbs === null) {
    throw new HausdorffError("CAD_UNREADABLE", "rhino3dm makes no NURBS surface of it");
  }
  return nurbs;
}

/** A NURBS surface of rhino3dm as one of the interchange. */
export function nurbsForm(nurbs: RhinoNurbsSurface): InterchangeSurface {
  return {
    degree: [nurbs.orderU - 1, nurbs.orderV - 1],
    knots_u: withEndKnots(nurbs.knotsU().toList()),
    knots_v: withEndKnots(nurbs.knotsV().toList()),
    ctrl: controlPoints(nurbs),
  };
}

function controlPoints(nurbs: RhinoNurbsSurface): ControlPoint[][] {
  const points = nurbs.points();
  return Array.from({ length: points.countU }, (_, i) =>
    Array.from({ length: points.countV }, (_, j): ControlPoint => {
      // rhino3dm's coordinates are multiplied by the weight.
      const [x = 0, y = 0, z = 0, w = 1] = points.get(i, j);
      return [x / w, y / w, z / w, w];
    }),
  );
}
