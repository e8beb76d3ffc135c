// The farthest point as a vertex of the map, which then holds the certified maximum.
import type { Vector3 } from "nurbs-hausdorff";
import { cross } from "../rigid.ts";
import { joinedArrays } from "./base.ts";
import type { DeviationMap } from "./refine.ts";

/** The part of the distance by which a vertex may be off the farthest point, and stands for it. */
const SAME = 1e-9;

/** A point of the model that is farthest from the other one. */
export interface Farthest {
  face: number;
  /** In the model's own coordinates. */
  point: Vector3;
  /** The closest point of the other model, in the coordinates of the result. */
  foot: Vector3;
  distance: number;
}

/** Returns the map with a point as a vertex within the nearest triangle of its face. */
export function withFarthest(
  map: DeviationMap,
  { face, point, foot, distance }: Farthest,
): DeviationMap {
  const { triangles, points, positions, normals } = map;
  const nearest = nearestTriangle(map, face, point);
  if (nearest === undefined) return map;
  const corners = [0, 1, 2].map((corner) => triangles.indices[3 * nearest + corner] ?? 0);
  const [a = 0, b = 0, c = 0] = corners;
  const added = map.distances.length;
  const indices = new Uint32Array(triangles.indices.length + 6);
  const after = 3 * nearest + 3;
  indices.set(triangles.indices.subarray(0, 3 * nearest));
  indices.set([a, b, added, b, c, added, c, a, added], 3 * nearest);
  indices.set(triangles.indices.subarray(after), after + 6);
  const faces = new Uint32Array(triangles.faces.length + 2);
  faces.set(triangles.faces.subarray(0, nearest));
  faces.fill(face, nearest, nearest + 3);
  faces.set(triangles.faces.subarray(nearest + 1), nearest + 3);
  const closest = corners.reduce((one, other) =>
    gap(points, one, point) < gap(points, other, point) ? one : other,
  );
  if (gap(points, closest, point) <= SAME * distance) {
    const [distances, slacks] = [map.distances.slice(), map.slacks.slice()];
    distances[closest] = distance;
    slacks[closest] = 0;
    return { ...map, distances, slacks };
  }
  // A vertex without a sign has NaN.
  const sign = Math.sign(map.signed[closest] ?? Number.NaN);
  const position = point.map((value, axis) => value - (map.origin[axis] ?? 0));
  return {
    ...{ origin: map.origin, isMesh: map.isMesh, flatness: map.flatness },
    triangles: { indices, faces },
    positions: joinedArrays(positions, new Float32Array(position)),
    normals: joinedArrays(normals, normals.slice(3 * closest, 3 * closest + 3)),
    points: joinedArrays(points, new Float64Array(point)),
    slacks: joinedArrays(map.slacks, new Float64Array(1)),
    distances: joinedArrays(map.distances, new Float64Array([distance])),
    signed: joinedArrays(map.signed, new Float64Array([sign === 0 ? distance : sign * distance])),
    feet: joinedArrays(map.feet, new Float64Array(foot)),
    signs: map.signs,
  };
}

/** The triangle of a face that contains a point, or comes nearest to that. */
function nearestTriangle({ triangles, points }: DeviationMap, face: number, point: Vector3) {
  let best: { triangle: number; size: number } | undefined;
  for (const [triangle, owner] of triangles.faces.entries()) {
    if (owner !== face) continue;
    const [a = 0, b = 0, c = 0] = triangles.indices.subarray(3 * triangle, 3 * triangle + 3);
    const size = farness(vertex(points, a), vertex(points, b), vertex(points, c), point);
    if (size < (best?.size ?? Number.POSITIVE_INFINITY)) best = { triangle, size };
  }
  return best?.triangle;
}

/** How far a point is from a triangle: 0 within it, and never more than from its plane and edges. */
function farness(a: Vector3, b: Vector3, c: Vector3, point: Vector3): number {
  const [ab, ac, ap] = [minus(b, a), minus(c, a), minus(point, a)];
  const normal = cross(ab, ac);
  const square = dot(normal, normal);
  // The corners of a triangle without an area are taken to coincide: the distance is that from the first one.
  if (square === 0) return Math.hypot(...ap);
  const second = dot(cross(ap, ac), normal) / square;
  const third = dot(cross(ab, ap), normal) / square;
  const outside = Math.max(0, -second, -third, second + third - 1);
  const size = Math.max(Math.hypot(...ab), Math.hypot(...ac));
  return Math.abs(dot(ap, normal)) / Math.sqrt(square) + outside * size;
}

const vertex = (points: Float64Array, index: number): Vector3 => [
  points[3 * index] ?? 0,
  points[3 * index + 1] ?? 0,
  points[3 * index + 2] ?? 0,
];

const minus = ([a, b, c]: Vector3, [x, y, z]: Vector3): Vector3 => [a - x, b - y, c - z];
const dot = ([a, b, c]: Vector3, [x, y, z]: Vector3): number => a * x + b * y + c * z;
const gap = (points: Float64Array, index: number, point: Vector3): number =>
  Math.hypot(...minus(vertex(points, index), point));
