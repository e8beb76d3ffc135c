// What the page draws of a map: triangles, lines and the distribution.
import type { DeviationMap, Signs, Vector3 } from "nurbs-hausdorff";
import { type Bounds, boundsOf } from "../../common/bounds.ts";
import type { Side } from "../protocol.ts";
import { type Distribution, distributionOf, type Estimates, estimatesOf } from "./distribution.ts";
import { type Placing, placed } from "./placed.ts";
import { type FacePlace, placesOf } from "./places.ts";

/** The largest number of lines drawn; more would hide the models. */
const MAX_LINES = 4096;

/**
 * What a distance may be off by for vertices in float32 and the permitted excess of closest points,
 * in diagonals of a result: twice their sum.
 */
const ROUNDING = 5e-7;

export interface MapDisplay {
  /** The vertices in the model's own coordinates, relative to its tessellation's origin. */
  positions: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer>;
  /** Signed deviations; NaN for one without a sign. */
  signed: Float32Array<ArrayBuffer>;
  signs: Signs;
  distances: Float32Array<ArrayBuffer>;
  /** Two numbers a vertex: its deviation, signed where it has a sign, and the row of the scale that is for those. */
  coordinates: Float32Array<ArrayBuffer>;
  /** The box of the vertices. */
  bounds: Bounds;
  indices: Uint32Array<ArrayBuffer>;
  /** The face of every triangle; those of a face follow each other. */
  faces: Uint32Array<ArrayBuffer>;
  /** The extremes, in float64. */
  lowest: number;
  highest: number;
  largest: number;
  /** From vertices to their feet, two ends a line, where the model was, relative to `lineOrigin`. */
  lines: Float32Array<ArrayBuffer>;
  /** The vertices from which the lines start. */
  lineVertices: Uint32Array<ArrayBuffer>;
  lineOrigin: Vector3;
  distribution: Distribution;
  estimates: Estimates | undefined;
  /** The worst place of each face that has triangles. */
  places: FacePlace[];
}

/** The rows of the scale, as heights in its texture: deviations with a sign, and without. */
const SIGNED_ROW = 0.25;
const UNSIGNED_ROW = 0.75;

/** Returns what to draw of the map of a model, in a result of models of this diagonal. */
export function mapDisplay(
  map: DeviationMap,
  side: Side,
  placing: Placing,
  diagonal: number,
): MapDisplay {
  const scale = side === "b" ? placing.scale : 1;
  const distribution = distributionOf(map, scale);
  return {
    ...{ positions: map.positions.slice(), normals: map.normals.slice() },
    ...{ coordinates: coordinatesOf(map), bounds: boundsOf(map.positions) },
    signed: new Float32Array(map.signed),
    signs: map.signs,
    distances: new Float32Array(map.distances),
    indices: map.indices.slice(),
    faces: map.faces.slice(),
    ...extremes(map),
    ...linesOf(map, side, placing),
    ...{ distribution, estimates: estimatesOf(distribution) },
    places: placesOf(map, ROUNDING * diagonal),
  };
}

/** The buffers that are moved to the page. */
export function buffersOf(display: MapDisplay): ArrayBuffer[] {
  const { positions, normals, signed, distances, coordinates, indices, faces } = display;
  const { lines, lineVertices } = display;
  const { absolute, signed: bySign } = display.distribution;
  const arrays = [
    ...[positions, normals, signed, distances, coordinates, indices, faces],
    ...[lines, lineVertices],
    ...[absolute, bySign].flatMap(({ values, areas }) => [values, areas]),
  ];
  return arrays.map(({ buffer }) => buffer);
}

function coordinatesOf({ signed, distances }: DeviationMap): Float32Array<ArrayBuffer> {
  const coordinates = new Float32Array(2 * distances.length);
  for (const [vertex, distance] of distances.entries()) {
    const value = signed[vertex] ?? Number.NaN;
    const isSigned = !Number.isNaN(value);
    coordinates[2 * vertex] = isSigned ? value : distance;
    coordinates[2 * vertex + 1] = isSigned ? SIGNED_ROW : UNSIGNED_ROW;
  }
  return coordinates;
}

function extremes({ signed, distances }: DeviationMap) {
  let [lowest, highest, largest] = [0, 0, 0];
  for (const [index, distance] of distances.entries()) {
    const value = signed[index] ?? Number.NaN;
    largest = Math.max(largest, distance);
    if (value < lowest) lowest = value;
    if (value > highest) highest = value;
  }
  return { lowest, highest, largest };
}

function linesOf({ points, feet, distances }: DeviationMap, side: Side, placing: Placing) {
  const step = Math.max(1, Math.ceil(distances.length / MAX_LINES));
  const count = Math.ceil(distances.length / step);
  const lineVertices = Uint32Array.from({ length: count }, (_, line) => line * step);
  const at = (all: Float64Array, vertex: number): Vector3 => [
    all[3 * vertex] ?? 0,
    all[3 * vertex + 1] ?? 0,
    all[3 * vertex + 2] ?? 0,
  ];
  const lineOrigin = at(feet, 0);
  const lines = new Float32Array(6 * count);
  for (const [line, vertex] of lineVertices.entries()) {
    const ends = [placed(side, at(points, vertex), placing), at(feet, vertex)];
    for (const [end, point] of ends.entries()) {
      const relative = point.map((value, axis) => value - (lineOrigin[axis] ?? 0));
      lines.set(relative, 6 * line + 3 * end);
    }
  }
  return { lines, lineVertices, lineOrigin };
}
