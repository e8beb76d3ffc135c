// Edges of a tessellation.

/** An edge as its two vertices. */
export type Edge = readonly [from: number, to: number];

/** The cosine of the largest angle between normals across an inner border of a smooth face. */
const SMOOTH_COSINE = Math.cos((20 * Math.PI) / 180);

/** Returns whether two vertices have nearly the same normal. */
export function smooth(normals: Float32Array, one: number, other: number): boolean {
  let cosine = 0;
  for (let axis = 0; axis < 3; axis++) {
    cosine += (normals[3 * one + axis] ?? 0) * (normals[3 * other + axis] ?? 0);
  }
  return cosine >= SMOOTH_COSINE;
}
