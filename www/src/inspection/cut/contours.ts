// The contours in which a plane meets painted models, with their deviations.
import { Matrix4, Vector3 } from "three";
import type { Cut } from "../../scene/section.ts";
import type { MapDisplay } from "../../worker/map/display.ts";
import type { Side } from "../../worker/protocol.ts";

/** A piece of a contour in the coordinates of its plane. */
export interface Piece {
  side: Side;
  from: Vertex;
  to: Vertex;
}

export interface Vertex {
  x: number;
  y: number;
  deviation: number;
}

/** What of a map is cut. */
export type CutMap = Pick<MapDisplay, "positions" | "indices" | "signed" | "distances">;

/** The pieces in which a plane meets the triangles of a map, which `matrix` places in the scene. O(n). */
export function contourOf(
  { positions, indices, signed, distances }: CutMap,
  matrix: Matrix4,
  { plane, right, up }: Pick<Cut, "plane" | "right" | "up">,
  side: Side,
): Piece[] {
  const { normal, constant } = plane.clone().applyMatrix4(new Matrix4().copy(matrix).invert());
  const heightOf = (vertex: number) =>
    normal.x * (positions[3 * vertex] ?? 0) +
    normal.y * (positions[3 * vertex + 1] ?? 0) +
    normal.z * (positions[3 * vertex + 2] ?? 0) +
    constant;
  // One byte a vertex, which all triangles are told by.
  const below = new Uint8Array(distances.length);
  for (let vertex = 0; vertex < below.length; vertex++) {
    if (heightOf(vertex) < 0) below[vertex] = 1;
  }
  const place = (vertex: number) =>
    new Vector3().fromArray(positions, 3 * vertex).applyMatrix4(matrix);
  const valueAt = (vertex: number) => {
    const known = signed[vertex] ?? Number.NaN;
    return Number.isNaN(known) ? (distances[vertex] ?? 0) : known;
  };
  const crossing = (one: number, other: number): Vertex => {
    const [from, to] = [heightOf(one), heightOf(other)];
    const part = from / (from - to || 1);
    const point = place(one).lerp(place(other), part);
    const deviation = valueAt(one) + part * (valueAt(other) - valueAt(one));
    return { x: point.dot(right), y: point.dot(up), deviation };
  };
  const pieces: Piece[] = [];
  for (let first = 0; first < indices.length; first += 3) {
    const a = indices[first] ?? 0;
    const b = indices[first + 1] ?? 0;
    const c = indices[first + 2] ?? 0;
    const isBelowA = below[a] === 1;
    const isBelowB = below[b] === 1;
    const isBelowC = below[c] === 1;
    if (isBelowA === isBelowB && isBelowB === isBelowC) continue;
    // Anticlockwise, a triangle is entered where it rises through the plane.
    const rising = isBelowA && !isBelowB ? [a, b] : isBelowB && !isBelowC ? [b, c] : [c, a];
    const falling = !isBelowA && isBelowB ? [a, b] : !isBelowB && isBelowC ? [b, c] : [c, a];
    const [from, to] = [rising, falling].map(([one = 0, other = 0]) => crossing(one, other));
    if (from !== undefined && to !== undefined) pieces.push({ side, from, to });
  }
  return pieces;
}
