// The edges that a model is drawn with: its ends, its creases, its tears.
import type { Tessellation } from "nurbs-hausdorff";

/**
 * The edges that belong to one triangle only, two vertices an edge. At creases
 * the tessellation has doubled vertices, so they are among them.
 */
export function outline({ positions, indices }: Tessellation): Uint32Array<ArrayBuffer> {
  const count = positions.length / 3;
  // An edge as one number, exact in float64 up to 9e7 vertices.
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
    if (index - begin === 1 && apart(positions, from, to)) edges.push(from, to);
  }
  return new Uint32Array(edges);
}

/** Whether the edge has a length; around poles some have none. */
function apart(positions: Float32Array, from: number, to: number): boolean {
  return [0, 1, 2].some((axis) => positions[3 * from + axis] !== positions[3 * to + axis]);
}
