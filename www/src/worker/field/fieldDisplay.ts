// What the page draws of the samples of A: triangles, lines and the distribution.
import type { FaceDeviations, Transform, Vector3 } from "nurbs-hausdorff";
import { backwards, movedBack, placeBack } from "../rigid.ts";
import { type Distribution, distributionOf } from "./distribution.ts";
import { fanAround } from "./witness.ts";

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
export function fieldDisplay(fields: FaceDeviations[], transform: Transform): FieldDisplay {
  const count = fields.reduce((sum, { distances }) => sum + distances.length, 0);
  const lineOrigin = pointAt(fields[0]?.points, 0);
  const origin = movedBack(lineOrigin, transform);
  const positions = new Float32Array(3 * count);
  const [signed, distances] = [new Float32Array(count), new Float32Array(count)];
  const cells = fields.reduce((sum, { counts: [u, v] }) => sum + (u - 1) * (v - 1), 0);
  const grids = new Uint32Array(6 * cells);
  const back = backwards(transform);
  let [first, cell] = [0, 0];
  for (const field of fields) {
    placeBack(field.points, back, origin, positions.subarray(3 * first));
    signed.set(field.signed, first);
    distances.set(field.distances, first);
    cell = setTriangles(grids, cell, first, field.counts);
    first += field.distances.length;
  }
  const around = fanAround(fields, grids);
  const indices = new Uint32Array(grids.length + around.length);
  indices.set(grids);
  indices.set(around, grids.length);
  return {
    ...{ positions, normals: normalsOf(positions, indices), signed, distances },
    ...{ indices, origin },
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

function linesOf(fields: FaceDeviations[], lineOrigin: Vector3) {
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

/** Sets two triangles for every four neighbouring samples; returns the number of cells set so far. */
function setTriangles(
  indices: Uint32Array,
  cellsBefore: number,
  first: number,
  [rows, columns]: [number, number],
): number {
  let cell = cellsBefore;
  for (let row = 0; row + 1 < rows; row++) {
    for (let column = 0; column + 1 < columns; column++) {
      const corner = first + row * columns + column;
      const across = corner + columns;
      const at = 6 * cell;
      indices[at] = corner;
      indices[at + 1] = across;
      indices[at + 2] = across + 1;
      indices[at + 3] = corner;
      indices[at + 4] = across + 1;
      indices[at + 5] = corner + 1;
      cell += 1;
    }
  }
  return cell;
}

/** Unit normals: sums of the normals of the triangles at each vertex, by their areas. */
function normalsOf(positions: Float32Array, indices: Uint32Array): Float32Array<ArrayBuffer> {
  const normals = new Float32Array(positions.length);
  const at = (place: number) => positions[place] ?? 0;
  for (let corner = 0; corner < indices.length; corner += 3) {
    const a = 3 * (indices[corner] ?? 0);
    const b = 3 * (indices[corner + 1] ?? 0);
    const c = 3 * (indices[corner + 2] ?? 0);
    const [ex, ey, ez] = [at(b) - at(a), at(b + 1) - at(a + 1), at(b + 2) - at(a + 2)];
    const [fx, fy, fz] = [at(c) - at(a), at(c + 1) - at(a + 1), at(c + 2) - at(a + 2)];
    const [x, y, z] = [ey * fz - ez * fy, ez * fx - ex * fz, ex * fy - ey * fx];
    for (const place of [a, b, c]) {
      normals[place] = (normals[place] ?? 0) + x;
      normals[place + 1] = (normals[place + 1] ?? 0) + y;
      normals[place + 2] = (normals[place + 2] ?? 0) + z;
    }
  }
  for (let place = 0; place < normals.length; place += 3) {
    const [x = 0, y = 0, z = 0] = normals.subarray(place, place + 3);
    const length = Math.hypot(x, y, z) || 1;
    normals[place] = x / length;
    normals[place + 1] = y / length;
    normals[place + 2] = z / length;
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
