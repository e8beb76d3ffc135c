import type { Tessellation } from "./tessellation.js";

/**
 * The arrays of a mesh or a cloud of points.
 * @internal
 */
export interface FacetArrays {
  positions: Float64Array;
  triangles?: Uint32Array | undefined;
  /** The number of triangles of each face; absent: all are one. */
  counts?: Uint32Array | undefined;
}

/**
 * A mesh's own triangles to display, with the mean normals at its vertices; a cloud's points. O(n).
 * @internal
 */
export function facetTessellation({ positions, triangles, counts }: FacetArrays): Tessellation {
  const origin = middleOf(positions);
  const indices = triangles === undefined ? new Uint32Array() : triangles.slice();
  return {
    positions: Float32Array.from(positions, (value, at) => value - (origin[at % 3] ?? 0)),
    normals: normalsOf(positions, indices),
    indices,
    origin,
    faces: rangesOf(counts ?? [indices.length / 3]),
  };
}

/** The ranges of indices of faces that follow each other. O(n). */
function rangesOf(counts: ArrayLike<number>): Tessellation["faces"] {
  let firstIndex = 0;
  return Array.from(counts, (triangles) => {
    const range = { firstIndex, indexCount: 3 * triangles };
    firstIndex += range.indexCount;
    return range;
  });
}

/** The middle of the points' box. */
function middleOf(positions: Float64Array): [number, number, number] {
  const low = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY];
  const high = low.map((value) => -value);
  for (const [at, value] of positions.entries()) {
    low[at % 3] = Math.min(low[at % 3] ?? value, value);
    high[at % 3] = Math.max(high[at % 3] ?? value, value);
  }
  const [x = 0, y = 0, z = 0] = low.map((value, axis) => (value + (high[axis] ?? value)) / 2);
  return [x, y, z];
}

/** Unit normals: sums of the normals of the triangles at each vertex, by their areas. */
function normalsOf(positions: Float64Array, indices: Uint32Array): Float32Array<ArrayBuffer> {
  const sums = new Float64Array(positions.length);
  const at = (place: number) => positions[place] ?? 0;
  for (let corner = 0; corner < indices.length; corner += 3) {
    const [a, b, c] = [0, 1, 2].map((next) => 3 * (indices[corner + next] ?? 0));
    if (a === undefined || b === undefined || c === undefined) continue;
    const [ex, ey, ez] = [at(b) - at(a), at(b + 1) - at(a + 1), at(b + 2) - at(a + 2)];
    const [fx, fy, fz] = [at(c) - at(a), at(c + 1) - at(a + 1), at(c + 2) - at(a + 2)];
    const normal = [ey * fz - ez * fy, ez * fx - ex * fz, ex * fy - ey * fx];
    for (const place of [a, b, c]) {
      for (const [axis, value] of normal.entries()) {
        sums[place + axis] = (sums[place + axis] ?? 0) + value;
      }
    }
  }
  const normals = new Float32Array(positions.length);
  for (let place = 0; place < sums.length; place += 3) {
    const [x = 0, y = 0, z = 0] = sums.subarray(place, place + 3);
    const length = Math.hypot(x, y, z) || 1;
    normals.set([x / length, y / length, z / length], place);
  }
  return normals;
}
