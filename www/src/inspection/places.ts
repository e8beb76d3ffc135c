// The worst place of each face of the maps, the largest first.

import type { MapDisplay } from "../worker/map/display.ts";
import type { DisplayModel, Side, Sides } from "../worker/protocol.ts";
import { SIDES } from "../worker/protocol.ts";

/** The vertex of a face whose deviation is the largest, with what the face's others are. */
export interface Place {
  side: Side;
  face: number;
  name: string;
  vertex: number;
  distance: number;
  /** NaN without a sign. */
  signed: number;
  /** The extremes of the face's signed deviations. */
  lowest: number;
  highest: number;
}

/** Returns one place for every face that has triangles. O(n) in their number. */
export function placesOf(maps: Sides<MapDisplay>, models: Sides<DisplayModel>): Place[] {
  return SIDES.flatMap((side) => {
    const map = maps[side];
    return map === undefined ? [] : [...byFace(map, side, models[side]?.faceNames ?? []).values()];
  }).sort((one, other) => other.distance - one.distance);
}

function byFace(map: MapDisplay, side: Side, names: readonly string[]): Map<number, Place> {
  const places = new Map<number, Place>();
  const { indices, faces, distances, signed } = map;
  // A scan is one face.
  const count = indices.length > 0 ? indices.length : distances.length;
  for (let corner = 0; corner < count; corner++) {
    const vertex = indices.length > 0 ? (indices[corner] ?? 0) : corner;
    const face = faces[Math.floor(corner / 3)] ?? 0;
    const [distance, value] = [distances[vertex] ?? 0, signed[vertex] ?? Number.NaN];
    const place = places.get(face);
    if (place === undefined) {
      const name = names[face] ?? `face ${face}`;
      const sign = Number.isNaN(value) ? 0 : value;
      places.set(face, {
        side,
        face,
        name,
        vertex,
        distance,
        signed: value,
        lowest: sign,
        highest: sign,
      });
      continue;
    }
    if (value < place.lowest) place.lowest = value;
    if (value > place.highest) place.highest = value;
    if (distance <= place.distance) continue;
    Object.assign(place, { vertex, distance, signed: value });
  }
  return places;
}
