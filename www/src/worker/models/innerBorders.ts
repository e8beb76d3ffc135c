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
  // Of most faces no edge is near another one.
  let [pieces, thirds]: [Pieces | undefined, Thirds | undefined] = [undefined, undefined];
  const isAcross = (edge: Edge, other: Edge): boolean => {
    pieces ??= piecesOf(indices);
    thirds ??= thirdsOf(edges, indices, positions.length / 3);
    const isOfOne = pieces(edge[0]) === pieces(other[0]);
    const isSame = !isOfOne || liesAlong(middle, other, positions, SEAM * tolerance);
    return isSame && isBeyond(edge, other, thirds, positions);
  };
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
          other !== edge &&
          liesAlong(middle, other, positions, tolerance) &&
          smooth(normals, from, other[0]) &&
          smooth(normals, to, other[1]) &&
          isAcross(edge, other),
      );
  });
}

/** A number of the piece of a vertex: pieces share none. */
type Pieces = (vertex: number) => number;
/** The third corner of the triangle of each open edge. */
type Thirds = ReadonlyMap<Edge, number>;

/** O(n) nearly. */
function piecesOf(indices: Uint32Array): Pieces {
  const [low, high] = ends(indices);
  const parents = Int32Array.from({ length: high - low + 1 }, (_, vertex) => vertex);
  const root = (vertex: number): number => {
    let at = vertex - low;
    for (let up = parents[at] ?? at; up !== at; up = parents[at] ?? at) {
      parents[at] = parents[up] ?? up;
      at = up;
    }
    return at;
  };
  for (let first = 0; first < indices.length; first += 3) {
    for (const corner of [first + 1, first + 2]) {
      parents[root(indices[corner] ?? low)] = root(indices[first] ?? low);
    }
  }
  return root;
}

function ends(indices: Uint32Array): [low: number, high: number] {
  let [low, high] = [indices[0] ?? 0, 0];
  for (const index of indices) {
    if (index < low) low = index;
    if (index > high) high = index;
  }
  return [low, high];
}

/** Of a model of so many vertices. O(n). */
function thirdsOf(edges: Edge[], indices: Uint32Array, vertices: number): Thirds {
  const key = (one: number, other: number) =>
    Math.min(one, other) * vertices + Math.max(one, other);
  const open = new Map(edges.map((edge) => [key(...edge), edge]));
  const [low, high] = ends(indices);
  const onRims = new Uint8Array(high - low + 1);
  for (const edge of edges) for (const vertex of edge) onRims[vertex - low] = 1;
  const thirds = new Map<Edge, number>();
  for (let first = 0; first < indices.length; first += 3) {
    for (let corner = 0; corner < 3; corner++) {
      const one = indices[first + corner] ?? 0;
      const other = indices[first + ((corner + 1) % 3)] ?? 0;
      if (onRims[one - low] === 0 || onRims[other - low] === 0) continue;
      const edge = open.get(key(one, other));
      if (edge !== undefined) thirds.set(edge, indices[first + ((corner + 2) % 3)] ?? 0);
    }
  }
  return thirds;
}

/** Whether two edges go one way, or back, with their triangles on different sides. */
function isBeyond(edge: Edge, other: Edge, thirds: Thirds, positions: Float32Array): boolean {
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
