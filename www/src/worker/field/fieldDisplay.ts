// What the page draws of the samples of A: triangles, lines and the distribution.
import type { Field, Transform, Vector3 } from "nurbs-hausdorff";
import { movedBack } from "../rigid.ts";
import { type Distribution, distributionOf } from "./distribution.ts";

/** The largest number of lines drawn; more would hide the models. */
const MAX_LINES = 4096;

export interface FieldDisplay {
  /** The samples in A's own coordinates, relative to `origin`. */
  positions: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer>;
  /** Signed deviations; NaN for one without a sign. */
  signed: Float32Array<ArrayBuffer>;
  distances: Float32Array<ArrayBuffer>;
  /** Two triangles for each four neighbouring samples. */
  indices: Uint32Array<ArrayBuffer>;
  origin: Vector3;
  /** From samples to their feet, two ends a line, where A was, relative to `lineOrigin`. */
  lines: Float32Array<ArrayBuffer>;
  /** The samples from which the lines start. */
  lineSamples: Uint32Array<ArrayBuffer>;
  lineOrigin: Vector3;
  distribution: Distribution;
}

/** Returns what to draw of fields that were measured after `transform` of A. */
export function fieldDisplay(fields: Field[], transform: Transform): FieldDisplay {
  const count = fields.reduce((sum, { distances }) => sum + distances.length, 0);
  const lineOrigin = pointAt(fields[0]?.points, 0);
  const origin = movedBack(lineOrigin, transform);
  const positions = new Float32Array(3 * count);
  const [signed, distances] = [new Float32Array(count), new Float32Array(count)];
  const indices: number[] = [];
  let first = 0;
  for (const field of fields) {
    for (let index = 0; index < field.distances.length; index++) {
      const own = movedBack(pointAt(field.points, index), transform);
      positions.set(relative(own, origin), 3 * (first + index));
    }
    signed.set(field.signed, first);
    distances.set(field.distances, first);
    pushTriangles(indices, first, field.counts);
    first += field.distances.length;
  }
  return {
    ...{ positions, normals: normalsOf(positions, indices), signed, distances },
    ...{ indices: new Uint32Array(indices), origin },
    ...linesOf(fields, lineOrigin),
    distribution: distributionOf(fields),
  };
}

/** The buffers that are moved to the page. */
export function buffersOf(display: FieldDisplay): ArrayBuffer[] {
  const { positions, normals, signed, distances, indices, lines, lineSamples } = display;
  const { distribution } = display;
  const arrays = [
    ...[positions, normals, signed, distances, indices, lines, lineSamples],
    ...[distribution.absolute, distribution.signed].flatMap(({ values, areas }) => [values, areas]),
  ];
  return arrays.map(({ buffer }) => buffer);
}

function linesOf(fields: Field[], lineOrigin: Vector3) {
  const count = fields.reduce((sum, { distances }) => sum + distances.length, 0);
  const step = Math.max(1, Math.ceil(Math.sqrt(count / MAX_LINES)));
  const [ends, samples]: number[][] = [[], []];
  let first = 0;
  for (const { points, feet, counts, distances } of fields) {
    for (const index of thinned(counts, step)) {
      for (const all of [points, feet]) ends?.push(...relative(pointAt(all, index), lineOrigin));
      samples?.push(first + index);
    }
    first += distances.length;
  }
  const lines = new Float32Array(ends ?? []);
  return { lines, lineSamples: new Uint32Array(samples ?? []), lineOrigin };
}

/** Yields the indices of the samples on every `step`-th row and column. */
function* thinned([rows, columns]: [number, number], step: number): Generator<number> {
  for (let row = 0; row < rows; row += step) {
    for (let column = 0; column < columns; column += step) yield row * columns + column;
  }
}

function pushTriangles(indices: number[], first: number, [rows, columns]: [number, number]): void {
  for (let row = 0; row + 1 < rows; row++) {
    for (let column = 0; column + 1 < columns; column++) {
      const corner = first + row * columns + column;
      const across = corner + columns;
      indices.push(corner, across, across + 1, corner, across + 1, corner + 1);
    }
  }
}

/** Unit normals: sums of the normals of the triangles at each vertex, by their areas. */
function normalsOf(positions: Float32Array, indices: number[]): Float32Array<ArrayBuffer> {
  const normals = new Float32Array(positions.length);
  for (let at = 0; at < indices.length; at += 3) {
    const corners = [0, 1, 2].map((corner) => indices[at + corner] ?? 0);
    const [a, b, c] = corners.map((corner) => pointAt(positions, corner));
    if (a === undefined || b === undefined || c === undefined) continue;
    const [e, f] = [relative(b, a), relative(c, a)];
    const normal = [
      e[1] * f[2] - e[2] * f[1],
      e[2] * f[0] - e[0] * f[2],
      e[0] * f[1] - e[1] * f[0],
    ];
    for (const corner of corners) {
      for (const [axis, value] of normal.entries()) {
        const place = 3 * corner + axis;
        normals[place] = (normals[place] ?? 0) + value;
      }
    }
  }
  for (let at = 0; at < normals.length; at += 3) {
    const length = Math.hypot(...pointAt(normals, at / 3)) || 1;
    for (let axis = 0; axis < 3; axis++) normals[at + axis] = (normals[at + axis] ?? 0) / length;
  }
  return normals;
}

const relative = (point: Vector3, origin: Vector3): Vector3 => [
  point[0] - origin[0],
  point[1] - origin[1],
  point[2] - origin[2],
];

const pointAt = (all: Float32Array | Float64Array | undefined, index: number): Vector3 => [
  all?.[3 * index] ?? 0,
  all?.[3 * index + 1] ?? 0,
  all?.[3 * index + 2] ?? 0,
];
