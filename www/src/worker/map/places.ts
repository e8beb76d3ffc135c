// The worst place of each face of a map.
import type { DeviationMap } from "nurbs-hausdorff";

/** The extremes of the signed deviations of a face, and the largest distance. */
export interface MeasuredFace {
  lowest: number;
  highest: number;
  distance: number;
}

/** The vertex of a face whose deviation is the largest, with what the face's others are. */
export interface FacePlace extends MeasuredFace {
  face: number;
  vertex: number;
  /** NaN without a sign. */
  signed: number;
  /** What a point of the face deviates by at least. */
  sure: MeasuredFace;
}

/**
 * Returns one place for every face that has triangles, in the order in which faces come. The deviation of a point of
 * the model beside a vertex may be less than the vertex's by its slack and `rounding`. O(n) in the number of triangles.
 */
export function placesOf(map: DeviationMap, rounding: number): FacePlace[] {
  const places = new Map<number, FacePlace>();
  // Triangles of a face follow each other.
  let place: FacePlace | undefined;
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
      const sign = Number.isNaN(value) ? 0 : value;
      const found = { vertex, distance, signed: value, lowest: sign, highest: sign };
      place = { face, ...found, sure: { lowest: 0, highest: 0, distance: 0 } };
      places.set(face, place);
    }
    const { sure } = place;
    const slack = (slacks[vertex] ?? 0) + rounding;
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
  return [...places.values()];
}
