// Triangles between the samples of A, coloured by the signed deviation from B.
import type { Field, Transform } from "nurbs-hausdorff";
import { BufferAttribute, BufferGeometry, Quaternion, Vector3 } from "three";
import { deviationColor } from "../colors.ts";

/** Returns the largest distance of a sample, which is the end of the colour scale. */
export function largestDistance(fields: Field[]): number {
  let largest = 0;
  for (const { distances } of fields) {
    for (const distance of distances) largest = Math.max(largest, distance);
  }
  return largest;
}

/**
 * Returns two triangles for each four neighbouring samples, relative to
 * `origin` and in A's own coordinates: the fields are given after `transform`,
 * and A may have moved on since.
 */
export function deviationGeometry(
  fields: Field[],
  largest: number,
  { rotation = [0, 0, 0, 1], translation = [0, 0, 0] }: Transform,
  origin: Vector3,
): BufferGeometry {
  const back = new Quaternion(...rotation).invert();
  const moved = new Vector3(...translation);
  const count = fields.reduce((sum, { distances }) => sum + distances.length, 0);
  const positions = new Float32Array(3 * count);
  const colors = new Float32Array(3 * count);
  const indices: number[] = [];
  const point = new Vector3();
  let first = 0;
  for (const { counts, points, signed } of fields) {
    signed.forEach((deviation, index) => {
      point
        .fromArray(points, 3 * index)
        .sub(moved)
        .applyQuaternion(back)
        .sub(origin);
      point.toArray(positions, 3 * (first + index));
      const color = deviationColor(largest > 0 ? deviation / largest : 0);
      color.toArray(colors, 3 * (first + index));
    });
    pushQuadrilaterals(indices, first, counts);
    first += signed.length;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setAttribute("color", new BufferAttribute(colors, 3));
  geometry.setIndex(indices);
  geometry.computeVertexNormals();
  return geometry;
}

function pushQuadrilaterals(
  indices: number[],
  first: number,
  [rows, columns]: [number, number],
): void {
  for (let row = 0; row + 1 < rows; row++) {
    for (let column = 0; column + 1 < columns; column++) {
      const corner = first + row * columns + column;
      const across = corner + columns;
      indices.push(corner, across, across + 1, corner, across + 1, corner + 1);
    }
  }
}
