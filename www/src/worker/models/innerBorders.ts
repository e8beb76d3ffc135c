// The borders between the pieces into which a trimmed face is cut.
import type { Tessellation } from "nurbs-hausdorff";
import { type Edge, smooth } from "./edges.ts";

/** The largest number of open edges of a face for which borders are searched. */
const MAX_EDGES = 6000;

/** The part of an edge by which a point may lie beyond its end. */
const END_TOLERANCE = 1e-3;

/** The number of edges for each slab of space in which edges are compared. */
const EDGES_A_SLAB = 4;

/**
 * Returns the open edges of one face without those that lie along another one
 * with the same normals: the pieces on both sides of a border are divided
 * differently, so that their vertices are not the same. Compared are edges in one slab of
 * space: O(n) in the number of edges where they are of about one length, O(n²) at worst.
 */
export function withoutInner(
  edges: Edge[],
  { positions, normals }: Tessellation,
  tolerance: number,
): Edge[] {
  if (edges.length > MAX_EDGES) return edges;
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
          smooth(normals, to, other[1]),
      );
  });
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
  let [along, length, square] = [0, 0, 0];
  for (let axis = 0; axis < 3; axis++) {
    const start = positions[3 * from + axis] ?? 0;
    const side = (positions[3 * to + axis] ?? 0) - start;
    const offset = (point[axis] ?? 0) - start;
    along += side * offset;
    length += side * side;
    square += offset * offset;
  }
  // The middle of an edge may be a vertex of the other side, between two of its edges.
  if (along < -END_TOLERANCE * length || along > (1 + END_TOLERANCE) * length) return false;
  return square - (along * along) / length <= tolerance * tolerance;
}
