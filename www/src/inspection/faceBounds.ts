// What is certain of each face: the deviations of a map are kept within it, and faces are judged by it.
import type { DiffResult } from "nurbs-hausdorff";
import { facesOf } from "../faces/changes.ts";
import type { MapDisplay } from "../worker/map/display.ts";
import { SIDES, type Sides } from "../worker/protocol.ts";
import type { Place } from "./places/places.ts";

/**
 * Lessens the deviations of maps that are more than the certified bound of their face; returns
 * whether there were any. A vertex of several faces has the largest of their bounds. O(n).
 */
export function keepWithin(maps: Sides<MapDisplay>, diff: DiffResult): boolean {
  let changed = false;
  for (const side of SIDES) {
    const map = maps[side];
    if (map !== undefined && keepMapWithin(map, uppersOf(map, diff, side))) changed = true;
  }
  return changed;
}

/** What no deviation at a vertex exceeds. */
function uppersOf(
  { indices, faces, distances }: MapDisplay,
  diff: DiffResult,
  side: "a" | "b",
): Float64Array {
  const bounds = new Map(facesOf(diff, side).map(({ face, upper }) => [face, upper]));
  const uppers = new Float64Array(distances.length);
  // A scan is one face.
  if (indices.length === 0) return uppers.fill(bounds.get(0) ?? Number.POSITIVE_INFINITY);
  for (const [corner, vertex] of indices.entries()) {
    const upper = bounds.get(faces[Math.floor(corner / 3)] ?? 0) ?? Number.POSITIVE_INFINITY;
    if (upper > (uppers[vertex] ?? 0)) uppers[vertex] = upper;
  }
  return uppers;
}

function keepMapWithin(map: MapDisplay, uppers: Float64Array): boolean {
  const { distances, signed } = map;
  let changed = false;
  let [lowest, highest, largest] = [0, 0, 0];
  for (const [vertex, upper] of uppers.entries()) {
    const value = signed[vertex] ?? Number.NaN;
    if ((distances[vertex] ?? 0) > upper) {
      distances[vertex] = upper;
      changed = true;
    }
    if (Math.abs(value) > upper) signed[vertex] = Math.sign(value) * upper;
    const [kept, distance] = [signed[vertex] ?? Number.NaN, distances[vertex] ?? 0];
    if (distance > largest) largest = distance;
    if (kept < lowest) lowest = kept;
    if (kept > highest) highest = kept;
  }
  if (changed) Object.assign(map, { lowest, highest, largest });
  return changed;
}

/** The place of a face with what is certain of the face: at least and at most as far. */
export function boundedPlace(place: Place, diff: DiffResult | undefined): Place {
  const found = diff && facesOf(diff, place.side)[place.face];
  if (found === undefined) return place;
  const within = (value: number) =>
    Math.sign(value) * Math.min(found.upper, Math.max(found.lower, Math.abs(value)));
  const { signed } = place;
  return {
    ...{ ...place, distance: within(place.distance), certified: found },
    signed: Number.isNaN(signed) ? signed : within(signed),
  };
}
