// The witness of a distance as a sample: the map then holds the certified maximum, which lies
// between the samples of a grid.
import type { DistanceResult, FaceDeviations, Vector3 } from "nurbs-hausdorff";

/** Returns the samples of A with the farthest point of A as one more, without an area. */
export function withWitness(fields: FaceDeviations[], result: DistanceResult): FaceDeviations[] {
  const directed = result.forward ?? result;
  const { a: at, b: foot } = directed.witness;
  const near = nearest(fields, at.face, at.point);
  if (near === undefined || near.distance === 0) return fields;
  const value = directed.computed;
  const sign = near.field.signed[near.index] ?? Number.NaN;
  const witness: FaceDeviations = {
    face: at.face,
    counts: [1, 1],
    points: new Float64Array(at.point),
    feet: new Float64Array(foot.point),
    distances: new Float64Array([value]),
    // A sample without a sign has NaN.
    signed: new Float64Array([value * Math.sign(sign)]),
    signs: near.field.signs,
    areas: new Float64Array([0]),
    statuses: new Uint8Array([0]),
  };
  return [...fields, witness];
}

/** A sample of one of several grids, and its distance from a point. */
interface Near {
  field: FaceDeviations;
  index: number;
  distance: number;
}

/** The sample of a face that is nearest to a point. */
function nearest(fields: FaceDeviations[], face: number, point: Vector3): Near | undefined {
  let near: Near | undefined;
  for (const field of fields) {
    if (field.face !== face) continue;
    for (let index = 0; index < field.distances.length; index++) {
      const distance = Math.hypot(...offset(field, index, point));
      if (distance < (near?.distance ?? Number.POSITIVE_INFINITY))
        near = { field, index, distance };
    }
  }
  return near;
}

/**
 * Places a sample within the cell of the grids that is nearest to it: sets the indices of two of
 * the four triangles around it, and returns those of the other two.
 */
export function fanAround(fields: FaceDeviations[], indices: Uint32Array): number[] {
  const witness = fields.at(-1);
  if (witness === undefined || witness.distances.length !== 1) return [];
  const point: Vector3 = [witness.points[0] ?? 0, witness.points[1] ?? 0, witness.points[2] ?? 0];
  const center = fields.reduce((sum, { distances }) => sum + distances.length, 0) - 1;
  let best = { distance: Number.POSITIVE_INFINITY, place: -1, corners: [0, 0, 0, 0] };
  let [first, cell] = [0, 0];
  for (const field of fields) {
    const [rows, columns] = field.counts;
    for (let row = 0; row + 1 < rows; row++) {
      for (let column = 0; column + 1 < columns; column++, cell++) {
        if (field.face !== witness.face) continue;
        const corner = row * columns + column;
        const around = [corner, corner + columns, corner + columns + 1, corner + 1];
        const distance = Math.hypot(...middleOffset(field, around, point));
        if (distance >= best.distance) continue;
        best = { distance, place: 6 * cell, corners: around.map((index) => first + index) };
      }
    }
    first += field.distances.length;
  }
  if (best.place < 0) return [];
  const [a = 0, b = 0, c = 0, d = 0] = best.corners;
  indices.set([a, b, center, b, c, center], best.place);
  return [c, d, center, d, a, center];
}

const offset = ({ points }: FaceDeviations, index: number, point: Vector3): Vector3 => [
  (points[3 * index] ?? 0) - point[0],
  (points[3 * index + 1] ?? 0) - point[1],
  (points[3 * index + 2] ?? 0) - point[2],
];

/** The vector from a point to the middle of a cell. */
function middleOffset(field: FaceDeviations, corners: number[], point: Vector3): Vector3 {
  const offsets = corners.map((index) => offset(field, index, point));
  const mean = (axis: 0 | 1 | 2) => offsets.reduce((sum, one) => sum + one[axis], 0) / 4;
  return [mean(0), mean(1), mean(2)];
}
