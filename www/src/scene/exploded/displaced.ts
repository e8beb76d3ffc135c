// Vertices that are moved with the faces that they are of.
import { BufferAttribute, type BufferGeometry, type Vector3 } from "three";
import { forgetBounds } from "../bounds.ts";

/** Ways of faces, by their index; none of a face that stays. */
export type Offsets = readonly (Vector3 | undefined)[];

/** Returns the face of each of `count` vertices, from the ranges of indices that faces have. O(n). */
export function facesOfVertices(
  count: number,
  indices: ArrayLike<number>,
  ranges: readonly { firstIndex: number; indexCount: number }[],
): Uint32Array {
  const faces = new Uint32Array(count);
  for (const [face, { firstIndex, indexCount }] of ranges.entries()) {
    for (let at = firstIndex; at < firstIndex + indexCount; at++) faces[indices[at] ?? 0] = face;
  }
  return faces;
}

/** Returns the face of each vertex, from that of each triangle. O(n). */
export function facesByTriangles(
  count: number,
  indices: ArrayLike<number>,
  triangles: Uint32Array,
): Uint32Array {
  const faces = new Uint32Array(count);
  for (let at = 0; at < indices.length; at++) {
    faces[indices[at] ?? 0] = triangles[Math.floor(at / 3)] ?? 0;
  }
  return faces;
}

/** Writes positions moved by the way of each vertex's face. O(n). */
export function displace(
  from: Float32Array,
  faces: Uint32Array,
  offsets: Offsets,
  into: Float32Array,
): void {
  for (let vertex = 0; vertex < faces.length; vertex++) {
    const { x = 0, y = 0, z = 0 } = offsets[faces[vertex] ?? 0] ?? {};
    const at = 3 * vertex;
    into[at] = (from[at] ?? 0) + x;
    into[at + 1] = (from[at + 1] ?? 0) + y;
    into[at + 2] = (from[at + 2] ?? 0) + z;
  }
}

/** Gives a geometry other positions. */
export function setPositions(geometry: BufferGeometry, positions: Float32Array): void {
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  forgetBounds(geometry);
}

/** The face that a triangle is of, by the ranges of indices that faces have in order. O(log n). */
export function faceOfTriangle(
  triangle: number,
  ranges: readonly { firstIndex: number; indexCount: number }[],
): number {
  let [low, high] = [0, ranges.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if ((ranges[middle]?.firstIndex ?? 0) <= 3 * triangle) low = middle;
    else high = middle - 1;
  }
  return low;
}
