// The borders between the pieces into which a trimmed face is cut.
import type { Tessellation } from "nurbs-hausdorff";
import { type Edge, smooth } from "./edges.ts";

/** The largest number of open edges of a face for which borders are searched. */
const MAX_EDGES = 6000;

/** The part of an edge by which a point may lie beyond its end. */
const END_TOLERANCE = 1e-3;

/**
 * Returns the open edges of one face without those that lie along another one
 * with the same normals: the pieces on both sides of a border are divided
 * differently, so that their vertices are not the same. O(n²) in the number of edges.
 */
export function withoutInner(
  edges: Edge[],
  { positions, normals }: Tessellation,
  tolerance: number,
): Edge[] {
  if (edges.length > MAX_EDGES) return edges;
  return edges.filter((edge) => {
    const [from, to] = edge;
    const middle = [0, 1, 2].map(
      (axis) => ((positions[3 * from + axis] ?? 0) + (positions[3 * to + axis] ?? 0)) / 2,
    );
    return !edges.some(
      (other) =>
        other !== edge &&
        liesAlong(middle, other, positions, tolerance) &&
        smooth(normals, from, other[0]) &&
        smooth(normals, to, other[1]),
    );
  });
}

/** Whether a point lies beside an edge, not beyond its ends. */
function liesAlong(
  point: number[],
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
