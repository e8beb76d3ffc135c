// A point that shows an overlap of two solids whose boundaries touch: a point of one's boundary
// that is certainly within the other one, about which both have a common part.
import type { ClearanceResult, Hausdorff, NurbsModel, Vector3 } from "nurbs-hausdorff/worker";
import { mapped, type Placing, placed, unplaced } from "./map/placed.ts";
import { SIDES, type Side } from "./protocol.ts";

/** The tolerance of the triangles whose corners are tried, in diagonals. */
const FLATNESS = 5e-3;
/** The part of the diagonal by which a point has to be inside: more than rounding of float32. */
const DEPTH = 1e-6;

interface Pair {
  a: NurbsModel;
  b: NurbsModel;
}

/** Returns a clearance as it is, or with an overlap that its search did not find. */
export async function withOverlap(
  engine: Hausdorff,
  models: Pair,
  clearance: ClearanceResult,
  { signal, ...placing }: Placing & { signal: AbortSignal },
): Promise<ClearanceResult> {
  if (clearance.overlap?.kind !== "touching") return clearance;
  for (const side of SIDES) {
    const other: Side = side === "a" ? "b" : "a";
    const { positions, origin } = await models[side].tessellate({ relativeTolerance: FLATNESS });
    const own = Float64Array.from(positions, (value, at) => value + (origin[at % 3] ?? 0));
    const points = mapped(own, (point) => placed(side, point, placing));
    const query = mapped(points, (point) => unplaced(other, point, placing));
    const { signed, signs } = await engine.closestPoints(models[other], query, { signal });
    if (signs !== "solid") return clearance;
    const deepest = signed.reduce((one, value, at) => (value < (signed[one] ?? 0) ? at : one), 0);
    if ((signed[deepest] ?? 0) >= -DEPTH * clearance.diagonal) continue;
    const [x = 0, y = 0, z = 0] = points.subarray(3 * deepest, 3 * deepest + 3);
    const insideBoth: Vector3 = [x, y, z];
    return { ...clearance, overlap: { kind: "intersecting", insideBoth } };
  }
  return clearance;
}
