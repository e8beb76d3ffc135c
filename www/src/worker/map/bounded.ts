// Maps kept within what is certain of each face.
import type { DeviationMap, FaceDifference } from "nurbs-hausdorff";

/**
 * Lessens the deviations of a map that are more than the certified bound of their face; returns whether there were
 * any. A vertex of several faces has the largest of their bounds. O(n).
 */
export function keepWithin(map: DeviationMap, faces: readonly FaceDifference[]): boolean {
  const { distances, signed } = map;
  const uppers = uppersOf(map, new Map(faces.map(({ face, upper }) => [face, upper])));
  let changed = false;
  for (const [vertex, upper] of uppers.entries()) {
    if ((distances[vertex] ?? 0) > upper) {
      distances[vertex] = upper;
      changed = true;
    }
    const value = signed[vertex] ?? Number.NaN;
    if (Math.abs(value) > upper) signed[vertex] = Math.sign(value) * upper;
  }
  return changed;
}

/** What no deviation at a vertex exceeds. */
function uppersOf(
  { indices, faces, distances }: DeviationMap,
  bounds: ReadonlyMap<number, number>,
): Float64Array {
  const uppers = new Float64Array(distances.length);
  const of = (face: number) => bounds.get(face) ?? Number.POSITIVE_INFINITY;
  // A scan is one face.
  if (indices.length === 0) return uppers.fill(of(0));
  for (const [corner, vertex] of indices.entries()) {
    const upper = of(faces[Math.floor(corner / 3)] ?? 0);
    if (upper > (uppers[vertex] ?? 0)) uppers[vertex] = upper;
  }
  return uppers;
}
