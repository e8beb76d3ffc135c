// The worst place of each face of the maps, the largest first.

import type { FaceDifference } from "nurbs-hausdorff";
import type { MeasuredFace } from "../../results/judgement.ts";
import { texts } from "../../texts/index.ts";
import type { MapDisplay } from "../../worker/map/display.ts";
import type { DisplayModel, Side, Sides } from "../../worker/protocol.ts";
import { SIDES } from "../../worker/protocol.ts";

/** The vertex of a face whose deviation is the largest, with what the face's others are. */
export interface Place extends MeasuredFace {
  side: Side;
  face: number;
  name: string;
  vertex: number;
  /** NaN without a sign. */
  signed: number;
  /** What a point of the face deviates by at least. */
  sure: MeasuredFace;
  /** What is certain of the face, once it is known. */
  certified?: FaceDifference;
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
  // Triangles of a face follow each other.
  let place: Place | undefined;
  const { indices, faces, distances, signed, slacks } = map;
  // A scan is one face.
  const count = indices.length > 0 ? indices.length : distances.length;
  for (let corner = 0; corner < count; corner++) {
    const vertex = indices.length > 0 ? (indices[corner] ?? 0) : corner;
    const face = faces[Math.floor(corner / 3)] ?? 0;
    const distance = distances[vertex] ?? 0;
    const value = signed[vertex] ?? Number.NaN;
    if (place?.face !== face) place = places.get(face);
    if (place === undefined) {
      const name = names[face] ?? texts.places.faceNumber(face);
      const sign = Number.isNaN(value) ? 0 : value;
      const found = { vertex, distance, signed: value, lowest: sign, highest: sign };
      place = { side, face, name, ...found, sure: { lowest: 0, highest: 0, distance: 0 } };
      places.set(face, place);
    }
    const { sure } = place;
    const slack = slacks[vertex] ?? 0;
    if (distance - slack > sure.distance) sure.distance = distance - slack;
    if (value + slack < sure.lowest) sure.lowest = value + slack;
    if (value - slack > sure.highest) sure.highest = value - slack;
    if (value < place.lowest) place.lowest = value;
    if (value > place.highest) place.highest = value;
    if (distance <= place.distance) continue;
    place.vertex = vertex;
    place.distance = distance;
    place.signed = value;
  }
  return places;
}
