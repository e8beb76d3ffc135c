// The distance of one point of a model from the other model, for the point under the pointer.
import type { Hausdorff, NurbsModel, Transform, Vector3 } from "nurbs-hausdorff";
import type { Probe, Side, Sides } from "./protocol.ts";
import { moved, movedBack } from "./rigid.ts";

/**
 * Projects a point near a model onto that model, and measures the projection.
 * `near` is in the model's own coordinates; the result is where `transform`
 * moves A.
 */
export async function probe(
  engine: Hausdorff,
  { a, b }: Sides<NurbsModel>,
  side: Side,
  near: Vector3,
  transform: Transform,
): Promise<Probe | undefined> {
  if (a === undefined || b === undefined) return undefined;
  const [own, other] = side === "a" ? [a, b] : [b, a];
  const onOwn = await engine.closestPoints(own, [...near]);
  const point = vector(onOwn.feet);
  const [u = 0, v = 0] = onOwn.parameters;
  const placed = side === "a" ? moved(point, transform) : point;
  const inOther = side === "a" ? placed : movedBack(point, transform);
  const onOther = await engine.closestPoints(other, [...inOther]);
  const foot = vector(onOther.feet);
  return {
    ...{ side, face: onOwn.surfaces[0] ?? 0, u, v, point: placed },
    foot: side === "a" ? foot : moved(foot, transform),
    footFace: onOther.surfaces[0] ?? 0,
    distance: onOther.distances[0] ?? Number.NaN,
    bound: onOther.bounds[0] ?? Number.NaN,
    signed: onOther.signed[0] ?? Number.NaN,
  };
}

const vector = ([x = 0, y = 0, z = 0]: Float64Array): Vector3 => [x, y, z];
