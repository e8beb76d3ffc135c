// The borders between the pieces into which a trimmed face is cut.
import type { Tessellation } from "nurbs-hausdorff";
import { along, dot, minus, unit, type Vector } from "../../measuring/fit/linear.ts";
import { type Edge, smooth } from "./edges.ts";

/** The largest number of open edges of a face for which borders are searched. */
const MAX_EDGES = 40_000;

/** The part of an edge by which a point may lie beyond its end. */
const END_TOLERANCE = 1e-3;

/** The number of edges for each slab of space in which edges are compared. */
const EDGES_A_SLAB = 4;

/** The part of the tolerance within which edges of one piece are both sides of its seam, and no two rims of it. */
const SEAM = 1e-3;

/** The cosine of the angle up to which edges along one border turn from each other: both are chords of it. */
const PARALLEL = Math.cos((30 * Math.PI) / 180);

/**
 * Returns the open edges of one face, which has these triangles, without those that lie along one of another piece, or
 * along the other side of their own one's seam, with the same normals and the triangles on the other side: the pieces on
 * both sides of a border are divided differently, so that their vertices are not the same. A rim that comes near a border
 * is not one. Compared are edges in one slab of space: O(n) in the number of edges where they are of about one length,
 * O(n²) at worst.
 */
export function withoutInner(
  edges: Edge[],
  indices: Uint32Array,
  { positions, normals }: Tessellation,
  tolerance: number,
): Edge[] {
  if (edges.length > MAX_EDGES) return edges;
  const pieces = piecesOf(indices);
  const thirds = thirdsOf(edges, indices, positions.length / 3);
  const slabs = slabsOf(edges, positions, tolerance);
  const middle = new Float64Array(3);
  return edges.filter((edge) => {
    const [from, to] = edge;
    for (let axis = 0; axis < 3; axis++) {
      middle[axis] = ((positions[3 * from + axis] ?? 0) + (positions[3 * to + axis] ?? 0)) / 2;
    }
    return !slabs
      .at(middle)
      .some(
        (other) =>
          liesAlong(
            middle,
            other,
            positions,
            pieces.get(other[0]) === pieces.get(from) ? SEAM * tolerance : tolerance,
          ) &&
          isBeyond(edge, other, thirds, positions) &&
          smooth(normals, from, other[0]) &&
          smooth(normals, to, other[1]),
      );
  });
}

/** A number of the piece of each vertex: pieces share none. O(n) nearly. */
function piecesOf(indices: Uint32Array): ReadonlyMap<number, number> {
  const parents = new Map<number, number>();
  const root = (vertex: number): number => {
    let at = vertex;
    for (let up = parents.get(at) ?? at; up !== at; up = parents.get(at) ?? at) {
      parents.set(at, parents.get(up) ?? up);
      at = up;
    }
    return at;
  };
  for (const [corner, vertex] of indices.entries()) {
    if (!parents.has(vertex)) parents.set(vertex, vertex);
    if (corner % 3 > 0) parents.set(root(vertex), root(indices[corner - 1] ?? vertex));
  }
  return new Map([...parents.keys()].map((vertex) => [vertex, root(vertex)]));
}

/** The third corner of the triangle of each open edge, of so many vertices. O(n). */
function thirdsOf(
  edges: Edge[],
  indices: Uint32Array,
  vertices: number,
): ReadonlyMap<Edge, number> {
  const key = (one: number, other: number) =>
    Math.min(one, other) * vertices + Math.max(one, other);
  const open = new Map(edges.map((edge) => [key(...edge), edge]));
  const thirds = new Map<Edge, number>();
  for (let first = 0; first < indices.length; first += 3) {
    const [a = 0, b = 0, c = 0] = indices.subarray(first, first + 3);
    for (const [one, other, third] of [
      [a, b, c],
      [b, c, a],
      [c, a, b],
    ] as const) {
      const edge = open.get(key(one, other));
      if (edge !== undefined) thirds.set(edge, third);
    }
  }
  return thirds;
}

/** Whether two edges go one way, or back, with their triangles on different sides. */
function isBeyond(
  edge: Edge,
  other: Edge,
  thirds: ReadonlyMap<Edge, number>,
  positions: Float32Array,
): boolean {
  const at = (vertex: number): Vector => [
    positions[3 * vertex] ?? 0,
    positions[3 * vertex + 1] ?? 0,
    positions[3 * vertex + 2] ?? 0,
  ];
  const way = unit(minus(at(other[1]), at(other[0])));
  const own = unit(minus(at(edge[1]), at(edge[0])));
  if (Math.abs(dot(own, way)) < PARALLEL) return false;
  const aside = ([from]: Edge, third: number | undefined): Vector => {
    const to = minus(at(third ?? from), at(from));
    return along(to, -dot(to, way), way);
  };
  return dot(aside(edge, thirds.get(edge)), aside(other, thirds.get(other))) < 0;
}

/** Divides space into slabs along the axis in which the edges reach farthest. */
function slabsOf(edges: Edge[], positions: Float32Array, tolerance: number) {
  const reach = [0, 1, 2].map((axis) => {
    let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
    for (const edge of edges) {
      for (const vertex of edge) {
        const value = positions[3 * vertex + axis] ?? 0;
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
    return { axis, low, length: high - low };
  });
  const longest = reach.reduce((one, other) => (other.length > one.length ? other : one));
  const { axis, low, length } = longest;
  const count = Math.max(1, Math.ceil(edges.length / EDGES_A_SLAB));
  const slabs: Edge[][] = Array.from({ length: count }, () => []);
  const slabAt = (value: number) =>
    Math.min(count - 1, Math.max(0, Math.floor((count * (value - low)) / (length || 1))));
  for (const edge of edges) {
    const [one, other] = [positions[3 * edge[0] + axis] ?? 0, positions[3 * edge[1] + axis] ?? 0];
    // Points beside the edge, and a little beyond its ends.
    const margin = tolerance + END_TOLERANCE * Math.abs(other - one);
    const last = slabAt(Math.max(one, other) + margin);
    for (let slab = slabAt(Math.min(one, other) - margin); slab <= last; slab++) {
      slabs[slab]?.push(edge);
    }
  }
  return { at: (point: Float64Array): Edge[] => slabs[slabAt(point[axis] ?? 0)] ?? [] };
}

/** Whether a point lies beside an edge, not beyond its ends. */
function liesAlong(
  point: Float64Array,
  [from, to]: Edge,
  positions: Float32Array,
  tolerance: number,
): boolean {
  let [part, length, square] = [0, 0, 0];
  for (let axis = 0; axis < 3; axis++) {
    const start = positions[3 * from + axis] ?? 0;
    const side = (positions[3 * to + axis] ?? 0) - start;
    const offset = (point[axis] ?? 0) - start;
    part += side * offset;
    length += side * side;
    square += offset * offset;
  }
  // The middle of an edge may be a vertex of the other side, between two of its edges.
  if (part < -END_TOLERANCE * length || part > (1 + END_TOLERANCE) * length) return false;
  return square - (part * part) / length <= tolerance * tolerance;
}
