// The outline of a model: the edges of its faces, creases and gaps.
import type { Tessellation, Vector3 } from "nurbs-hausdorff";
import type { Bounds } from "../../common/bounds.ts";
import type { Outline } from "../protocol.ts";
import { cross } from "../rigid.ts";
import { type Edge, smooth } from "./edges.ts";
import { withoutInner } from "./innerBorders.ts";

/**
 * The distance of two triangulations of one border, in diagonals: each is as far
 * from it as the tessellation's tolerance allows.
 */
const BORDER_TOLERANCE = 4e-4;
/** The cosine of the angle from which on triangles of a mesh bend: facets of a round part do not. */
const BEND_COSINE = Math.cos((30 * Math.PI) / 180);

/**
 * Returns the edges that belong to only one triangle, two vertices per edge.
 * Creases are among them, because the tessellation duplicates their vertices;
 * seams and borders between the pieces of one smooth face are not. Of a mesh they are those at which
 * its triangles bend.
 * O(n log n) in the number of triangles.
 */
export function outline(tessellation: Tessellation, { min, max }: Bounds, isMesh = false): Outline {
  const { indices, faces } = tessellation;
  const tolerance =
    BORDER_TOLERANCE * Math.hypot(...max.map((end, axis) => end - (min[axis] ?? 0)));
  const edges = faces.map(({ firstIndex, indexCount }) => {
    const own = indices.subarray(firstIndex, firstIndex + indexCount);
    if (isMesh) return creases(tessellation, own);
    const edges = withoutDoubled(openEdges(tessellation, own), tessellation);
    return withoutInner(edges, own, tessellation, tolerance);
  });
  let end = 0;
  const ends = edges.map(({ length }) => {
    end += 2 * length;
    return end;
  });
  return { edges: new Uint32Array(edges.flat(2)), ends };
}

/** The edges of a mesh at which its triangles bend, and those of one triangle only. O(n log n). */
function creases({ positions }: Tessellation, indices: Uint32Array): Edge[] {
  const count = positions.length / 3;
  const corners = Float64Array.from(indices, (from, corner) => {
    const first = corner - (corner % 3);
    const to = indices[first + ((corner + 1) % 3)] ?? 0;
    return Math.min(from, to) * count + Math.max(from, to);
  });
  const order = Uint32Array.from(corners.keys()).sort(
    (one, other) => (corners[one] ?? 0) - (corners[other] ?? 0),
  );
  const edges: Edge[] = [];
  for (let index = 0; index < order.length; ) {
    const begin = index;
    const key = corners[order[begin] ?? 0] ?? 0;
    while (index < order.length && corners[order[index] ?? 0] === key) index += 1;
    const [one, other] = [order[begin], order[begin + 1]];
    const [from, to] = [Math.floor(key / count), key % count];
    const isFlat =
      index - begin === 2 &&
      isSmoothAcross(positions, indices, Math.floor((one ?? 0) / 3), Math.floor((other ?? 0) / 3));
    if (!isFlat && distinct(positions, from, to)) edges.push([from, to]);
  }
  return edges;
}

/** Whether two triangles bend little where they meet; those without an area do not bend. */
function isSmoothAcross(
  positions: Float32Array,
  indices: Uint32Array,
  one: number,
  other: number,
): boolean {
  const [m, n] = [one, other].map((triangle) => {
    const [a, b, c] = [0, 1, 2].map((corner) => {
      const at = 3 * (indices[3 * triangle + corner] ?? 0);
      return [positions[at] ?? 0, positions[at + 1] ?? 0, positions[at + 2] ?? 0] as const;
    });
    const side = (to: Point = ORIGIN, from: Point = ORIGIN): Vector3 => [
      to[0] - from[0],
      to[1] - from[1],
      to[2] - from[2],
    ];
    return cross(side(b, a), side(c, a));
  }) as [Vector3, Vector3];
  const sizes = Math.hypot(...m) * Math.hypot(...n);
  return sizes === 0 || m[0] * n[0] + m[1] * n[1] + m[2] * n[2] >= BEND_COSINE * sizes;
}

type Point = readonly [number, number, number];
const ORIGIN: Point = [0, 0, 0];

function openEdges({ positions }: Tessellation, indices: Uint32Array): Edge[] {
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
  const edges: Edge[] = [];
  for (let index = 0; index < keys.length; ) {
    const key = keys[index] ?? 0;
    const begin = index;
    while (index < keys.length && keys[index] === key) index += 1;
    const [from, to] = [Math.floor(key / count), key % count];
    if (index - begin === 1 && distinct(positions, from, to)) edges.push([from, to]);
  }
  return edges;
}

/** The edges of one face without those that have the same ends and normals. */
function withoutDoubled(edges: Edge[], { positions, normals }: Tessellation): Edge[] {
  const place = (vertex: number) => positions.subarray(3 * vertex, 3 * vertex + 3).join(" ");
  const byPlace = new Map<string, Edge>();
  const inner = new Set<Edge>();
  for (const edge of edges) {
    const ends = edge.map(place);
    const ordered: Edge = (ends[0] ?? "") < (ends[1] ?? "") ? edge : [edge[1], edge[0]];
    const key = ends.sort().join(" ");
    const other = byPlace.get(key);
    if (other === undefined) byPlace.set(key, ordered);
    else if ([0, 1].every((end) => smooth(normals, ordered[end] ?? 0, other[end] ?? 0))) {
      for (const one of [ordered, other]) inner.add(one);
    }
  }
  return [...byPlace.values()].filter((edge) => !inner.has(edge));
}

/** Returns whether the edge has a positive length; at poles some have none. */
function distinct(positions: Float32Array, from: number, to: number): boolean {
  return [0, 1, 2].some((axis) => positions[3 * from + axis] !== positions[3 * to + axis]);
}
