// The outline of a model: its boundary edges, creases and gaps.
import type { Tessellation } from "nurbs-hausdorff";

/**
 * Returns the edges that belong to only one triangle, two vertices per edge.
 * Creases are among them, because the tessellation duplicates their vertices.
 * O(n log n) in the number of triangles.
 */
export function outline({ positions, indices }: Tessellation): Uint32Array<ArrayBuffer> {
  const count = positions.length / 3;
  // Each edge is encoded as one number, exact in float64 up to 9e7 vertices.
  const keys = new Float64Array(indices.length);
  for (let first = 0; first < indices.length; first += 3) {
    for (let corner = 0; corner < 3; corner++) {
      const from = indices[first + corner] ?? 0;
      const to = indices[first + ((corner + 1) % 3)] ?? 0;
      keys[first + corner] = Math.min(from, to) * count + Math.max(from, to);
    }
  }
  keys.sort();
  const edges: number[] = [];
  for (let index = 0; index < keys.length; ) {
    const key = keys[index] ?? 0;
    const begin = index;
    while (index < keys.length && keys[index] === key) index += 1;
    const [from, to] = [Math.floor(key / count), key % count];
    if (index - begin === 1 && distinct(positions, from, to)) edges.push(from, to);
  }
  return new Uint32Array(edges);
}

/** Returns whether the edge has a positive length; at poles some have none. */
function distinct(positions: Float32Array, from: number, to: number): boolean {
  return [0, 1, 2].some((axis) => positions[3 * from + axis] !== positions[3 * to + axis]);
}
