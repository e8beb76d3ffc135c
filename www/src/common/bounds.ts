// The box of points in a row of numbers.
import type { Vector3 } from "nurbs-hausdorff";

/** The corners of a box; of no points, the lower one is above the upper one. */
export interface Bounds {
  min: Vector3;
  max: Vector3;
}

/** Returns the box of points, three numbers each. O(n). */
export function boundsOf(positions: Float32Array): Bounds {
  const min: Vector3 = [
    Number.POSITIVE_INFINITY,
    Number.POSITIVE_INFINITY,
    Number.POSITIVE_INFINITY,
  ];
  const max: Vector3 = [
    Number.NEGATIVE_INFINITY,
    Number.NEGATIVE_INFINITY,
    Number.NEGATIVE_INFINITY,
  ];
  for (const axis of [0, 1, 2] as const) {
    let [low, high] = [min[axis], max[axis]];
    for (let at = axis; at < positions.length; at += 3) {
      const value = positions[at] ?? 0;
      if (value < low) low = value;
      if (value > high) high = value;
    }
    [min[axis], max[axis]] = [low, high];
  }
  return { min, max };
}
