// The triangles of a model on which its deviations are measured, whatever its position is.
import type { NurbsModel, Tessellation, Vector3 } from "nurbs-hausdorff/worker";
import { concatenated } from "../../common/arrays.ts";
import { edgeEnds, edgesOf, split, type Triangles } from "./triangles.ts";

/** The longest edge, in diagonals of the model: what is smaller than it is seen at first. */
const MAX_EDGE = 1 / 30;
/** The number of vertices after which edges are no longer split for their length. */
const MAX_VERTICES = 60_000;
/** Rounds of splitting: each halves the longest edges. */
const MAX_ROUNDS = 8;

/** Vertices: where they are drawn, and the points of the model that are measured for them. */
export interface Vertices {
  /** x, y, z on the triangles, relative to the tessellation's origin. */
  positions: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer>;
  /** x, y, z of the points of the model that are measured, in its own coordinates. */
  points: Float64Array<ArrayBuffer>;
  /** How far the model may be from each of them, but for the rounding of float32. */
  slacks: Float64Array<ArrayBuffer>;
}

/** What the triangles are of a model. */
export interface Sampling {
  /** Whether they are the model itself, and its edges straight. */
  isMesh: boolean;
  /** Where their vertices are relative to. */
  origin: Vector3;
  /** The most that a point of them is from the model. */
  flatness: number;
}

export interface Base extends Vertices, Sampling {
  triangles: Triangles;
}

/** Returns the triangles of a model, its longest edges split, with the points to measure. */
export function baseOf(
  model: NurbsModel,
  { positions, normals, indices, origin, faces }: Tessellation,
  { isMesh, flatness }: Pick<Sampling, "isMesh" | "flatness">,
): Base {
  const sampling = { isMesh, origin, flatness };
  const owners = new Uint32Array(indices.length / 3);
  for (const [face, { firstIndex, indexCount }] of faces.entries()) {
    owners.fill(face, firstIndex / 3, (firstIndex + indexCount) / 3);
  }
  let vertices: Vertices = {
    ...{ positions: positions.slice(), normals: normals.slice() },
    points: Float64Array.from(positions, (value, index) => value + (origin[index % 3] ?? 0)),
    slacks: new Float64Array(positions.length / 3),
  };
  let triangles: Triangles = { indices: indices.slice(), faces: owners };
  const longest = MAX_EDGE * diagonalOf(model);
  for (let round = 0; round < MAX_ROUNDS; round++) {
    const count = vertices.positions.length / 3;
    if (count > MAX_VERTICES) break;
    const edges = edgesOf(triangles).filter(
      (edge) => lengthOf(vertices.positions, ...edgeEnds(edge)) > longest,
    );
    if (edges.length === 0) break;
    vertices = joined(vertices, middlesOf(vertices, edges, sampling));
    const added = new Map([...edges].map((edge, index) => [edge, count + index]));
    triangles = split(triangles, added);
  }
  return { ...vertices, ...sampling, triangles };
}

/** The diagonal of the box around a model. */
export function diagonalOf(model: NurbsModel): number {
  const { min, max } = model.boundingBox;
  return Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
}

/**
 * Returns the middles of edges: drawn on the edge, so that no crack opens, and measured where the
 * surface is, by the cubic curve with the tangents that the normals at both ends leave; of a mesh,
 * on the edge. The drawn point is on a triangle, so that the model is within the flatness of it.
 */
export function middlesOf(
  { positions, normals, points }: Vertices,
  edges: Float64Array,
  { isMesh, origin, flatness }: Sampling,
): Vertices {
  const middles: Vertices = {
    positions: new Float32Array(3 * edges.length),
    normals: new Float32Array(3 * edges.length),
    points: new Float64Array(3 * edges.length),
    slacks: new Float64Array(edges.length),
  };
  for (const [index, edge] of edges.entries()) {
    const [from, to] = edgeEnds(edge);
    const [p, q] = [vector(points, from), vector(points, to)];
    const [m, n] = [vector(normals, from), vector(normals, to)];
    const way = [q[0] - p[0], q[1] - p[1], q[2] - p[2]] as const;
    // What of the way the tangents at both ends lack: across the surface.
    const [lackFrom, lackTo] = [m, n].map(
      (normal) => normal[0] * way[0] + normal[1] * way[1] + normal[2] * way[2],
    );
    const sum = [m[0] + n[0], m[1] + n[1], m[2] + n[2]] as const;
    const length = Math.hypot(...sum) || 1;
    for (let axis = 0; axis < 3; axis++) {
      const at = 3 * index + axis;
      const lack = (n[axis] ?? 0) * (lackTo ?? 0) - (m[axis] ?? 0) * (lackFrom ?? 0);
      const bulge = isMesh ? 0 : lack / 8;
      middles.points[at] = ((p[axis] ?? 0) + (q[axis] ?? 0)) / 2 + bulge;
      middles.positions[at] =
        ((positions[3 * from + axis] ?? 0) + (positions[3 * to + axis] ?? 0)) / 2;
      middles.normals[at] = (sum[axis] ?? 0) / length;
    }
    if (isMesh) continue;
    const [drawn, point] = [vector(middles.positions, index), vector(middles.points, index)];
    const apart = drawn.map((value, axis) => value + (origin[axis] ?? 0) - (point[axis] ?? 0));
    middles.slacks[index] = flatness + Math.hypot(...apart);
  }
  return middles;
}

const vector = (all: Float32Array | Float64Array, index: number): Vector3 => [
  all[3 * index] ?? 0,
  all[3 * index + 1] ?? 0,
  all[3 * index + 2] ?? 0,
];

/** Returns vertices followed by others. */
export const joined = (one: Vertices, other: Vertices): Vertices => ({
  positions: joinedArrays(one.positions, other.positions),
  normals: joinedArrays(one.normals, other.normals),
  points: joinedArrays(one.points, other.points),
  slacks: joinedArrays(one.slacks, other.slacks),
});

/** Returns the numbers of one array followed by those of another of the same type. */
export function joinedArrays<Numbers extends Float32Array | Float64Array>(
  one: Numbers,
  other: Numbers,
): Numbers {
  return concatenated(one.constructor as new (length: number) => Numbers, [one, other]);
}

/** The distance of two vertices. */
export function lengthOf(points: Float32Array | Float64Array, from: number, to: number): number {
  const x = (points[3 * from] ?? 0) - (points[3 * to] ?? 0);
  const y = (points[3 * from + 1] ?? 0) - (points[3 * to + 1] ?? 0);
  const z = (points[3 * from + 2] ?? 0) - (points[3 * to + 2] ?? 0);
  return Math.sqrt(x * x + y * y + z * z);
}
