// The distance of one point of a model from the other model, for the point under the pointer.
import type { Hausdorff, NurbsModel, Transform, Vector3 } from "nurbs-hausdorff";
import type { Probe, Side, Sides } from "./protocol.ts";
import { moved, movedBack } from "./rigid.ts";

/** A point near a model, in that model's own coordinates. */
export interface NearPoint {
  side: Side;
  near: Vector3;
  /** Moves A. */
  transform: Transform;
  /** A's units in one of B's: results are in A's. */
  scale: number;
}

/** Projects a point onto its model, and measures the projection from the other model. */
export async function probe(
  engine: Hausdorff,
  { a, b }: Sides<NurbsModel>,
  { side, near, transform, scale }: NearPoint,
): Promise<Probe | undefined> {
  if (a === undefined || b === undefined) return undefined;
  const [own, other] = side === "a" ? [a, b] : [b, a];
  /** From the coordinates of a model to those of the result, and back. */
  const placed = (model: NurbsModel, point: Vector3) =>
    model === a ? moved(point, transform) : scaled(point, scale);
  const unplaced = (model: NurbsModel, point: Vector3) =>
    model === a ? movedBack(point, transform) : scaled(point, 1 / scale);
  const onOwn = await engine.closestPoints(own, [...near]);
  const point = placed(own, vector(onOwn.feet));
  const [u = 0, v = 0] = onOwn.parameters;
  const onOther = await engine.closestPoints(other, [...unplaced(other, point)]);
  const size = other === b ? scale : 1;
  return {
    ...{ side, face: faceName(own, onOwn.faces[0]), u, v, point },
    foot: placed(other, vector(onOther.feet)),
    footFace: faceName(other, onOther.faces[0]),
    distance: size * (onOther.distances[0] ?? Number.NaN),
    bound: size * (onOther.bounds[0] ?? Number.NaN),
    signed: size * (onOther.signed[0] ?? Number.NaN),
  };
}

const vector = ([x = 0, y = 0, z = 0]: Float64Array): Vector3 => [x, y, z];

const scaled = ([x, y, z]: Vector3, factor: number): Vector3 => [
  factor * x,
  factor * y,
  factor * z,
];

const faceName = (model: NurbsModel, face = 0): string => model.faceName(face) ?? `face ${face}`;
