// Triangles that are split at the middles of marked edges, so that no vertex lies on an edge.

/** Three vertices a triangle, and the face that each belongs to; those of a face follow each other. */
export interface Triangles {
  indices: Uint32Array<ArrayBuffer>;
  faces: Uint32Array<ArrayBuffer>;
}

/** More than the vertices of any map: an edge is one number, exact in float64. */
const KEY_BASE = 2 ** 26;

/** Returns the number that stands for an edge, in whichever direction. */
export const edgeKey = (one: number, other: number): number =>
  one < other ? one * KEY_BASE + other : other * KEY_BASE + one;

/** Returns the two vertices of an edge. */
export const edgeEnds = (key: number): [number, number] => [
  Math.floor(key / KEY_BASE),
  key % KEY_BASE,
];

/** Returns every edge once. O(n log n) in the number of triangles. */
export function edgesOf({ indices }: Triangles): Float64Array {
  const keys = new Float64Array(indices.length);
  for (let first = 0; first < indices.length; first += 3) {
    for (let corner = 0; corner < 3; corner++) {
      const from = indices[first + corner] ?? 0;
      const to = indices[first + ((corner + 1) % 3)] ?? 0;
      keys[first + corner] = edgeKey(from, to);
    }
  }
  keys.sort();
  let count = 0;
  for (const [index, key] of keys.entries()) {
    if (index === 0 || key !== keys[index - 1]) keys[count++] = key;
  }
  return keys.subarray(0, count);
}

/** Returns the triangles, split at the new vertices in the middles of edges, by `edgeKey`. */
export function split({ indices, faces }: Triangles, middles: Map<number, number>): Triangles {
  // A triangle has at most four parts.
  const corners = new Uint32Array(4 * indices.length);
  const owners = new Uint32Array(4 * faces.length);
  let count = 0;
  for (const [triangle, face] of faces.entries()) {
    const [a, b, c] = [0, 1, 2].map((corner) => indices[3 * triangle + corner] ?? 0);
    const parts = partsOf([a ?? 0, b ?? 0, c ?? 0], middles);
    corners.set(parts, 3 * count);
    owners.fill(face, count, count + parts.length / 3);
    count += parts.length / 3;
  }
  return { indices: corners.slice(0, 3 * count), faces: owners.slice(0, count) };
}

type Corners = readonly [number, number, number];

/** Splits one triangle: into two, three or four for as many marked edges and one more. */
function partsOf([a, b, c]: Corners, middles: Map<number, number>): readonly number[] {
  const ab = middles.get(edgeKey(a, b));
  const bc = middles.get(edgeKey(b, c));
  const ca = middles.get(edgeKey(c, a));
  if (ab !== undefined) {
    if (bc !== undefined && ca !== undefined) return [a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca];
    if (bc !== undefined) return [a, ab, c, ab, b, bc, ab, bc, c];
    if (ca !== undefined) return [c, ca, b, ca, a, ab, ca, ab, b];
    return [a, ab, c, ab, b, c];
  }
  if (bc === undefined && ca === undefined) return [a, b, c];
  // Turned, so that the first edge is marked.
  return bc !== undefined ? partsOf([b, c, a], middles) : partsOf([c, a, b], middles);
}
