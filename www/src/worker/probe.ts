// The distance of one point of a model from the other model, for the point under the pointer.

import type { Hausdorff, NurbsModel, Transform, Vector3 } from "nurbs-hausdorff/worker";
import { texts } from "../texts/index.ts";
import { placed, unplaced } from "./map/placed.ts";
import { isCloud, isMesh } from "./models/meshes.ts";
import type { Probe, Side, Sides } from "./protocol.ts";

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
  const otherSide: Side = side === "a" ? "b" : "a";
  const placing = { transform, scale };
  const onOwn = await engine.closestPoints(own, [...near]);
  const point = placed(side, vector(onOwn.feet), placing);
  const [u = 0, v = 0] = onOwn.parameters;
  const onOther = await engine.closestPoints(other, [...unplaced(otherSide, point, placing)]);
  const size = other === b ? scale : 1;
  return {
    ...{ side, face: placeOn(own, onOwn.faces[0]), point },
    ...(!isMesh(own) && { u, v }),
    foot: placed(otherSide, vector(onOther.feet), placing),
    footFace: placeOn(other, onOther.faces[0]),
    distance: size * (onOther.distances[0] ?? Number.NaN),
    bound: size * (onOther.bounds[0] ?? Number.NaN),
    signed: size * (onOther.signed[0] ?? Number.NaN),
  };
}

const vector = ([x = 0, y = 0, z = 0]: Float64Array): Vector3 => [x, y, z];

/** The name of a face; of a mesh its triangle, of a scan its point. */
function placeOn(model: NurbsModel, face = 0): string {
  if (!isMesh(model)) return faceName(model, face);
  return isCloud(model) ? texts.common.point(face) : texts.common.triangle(face);
}

/** The name of a face in its source, or its number. */
export const faceName = (model: NurbsModel, face = 0): string =>
  model.faceName(face) ?? texts.files.face(face);
