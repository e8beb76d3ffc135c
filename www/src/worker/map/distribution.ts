// The distribution of the deviation over the area of a map: estimates.
import type { DeviationMap, Vector3 } from "nurbs-hausdorff";
import { cross } from "../rigid.ts";

/** Deviations in ascending order, each with the area up to it. */
export interface Cumulative {
  values: Float64Array<ArrayBuffer>;
  areas: Float64Array<ArrayBuffer>;
}

export interface Distribution {
  /** The distances. */
  absolute: Cumulative;
  /** The signed deviations where they have a sign. */
  signed: Cumulative;
}

/** Estimates of the deviation over an area, by the linear function on the map's triangles. */
export interface Estimates {
  mean: number;
  signedMean: number;
  rms: number;
  median: number;
  percentile95: number;
  percentile99: number;
}

/** The parts that triangles are divided into together, and one at most along an edge. */
const PARTS = 60_000;
const MAX_DIVISIONS = 24;

/** Deviations of parts of equal area within a triangle. */
interface Parts {
  distances: number[];
  signed: number[];
  areas: number[];
}

/** Returns the distribution, of areas in the square of the result's unit, or of a scan's points. O(n log n). */
export function distributionOf(map: DeviationMap, scale: number): Distribution {
  const parts = partsOf(map, scale);
  const distances = Float64Array.from(parts.distances);
  const signed = Float64Array.from(parts.signed);
  const areas = Float64Array.from(parts.areas);
  const known = Uint32Array.from(signed.keys()).filter((part) => !Number.isNaN(signed[part]));
  return {
    absolute: cumulative(distances, areas, Uint32Array.from(distances.keys())),
    signed: cumulative(signed, areas, known),
  };
}

/** Returns the statistics of a distribution; undefined where there is no area. */
export function estimatesOf({ absolute, signed }: Distribution): Estimates | undefined {
  const total = absolute.areas.at(-1) ?? 0;
  if (total === 0) return undefined;
  const at = (part: number) => {
    const place = absolute.areas.findIndex((area) => area >= part * total);
    return absolute.values[Math.max(0, place)] ?? 0;
  };
  return {
    mean: mean(absolute, (value) => value),
    signedMean: mean(signed, (value) => value),
    rms: Math.sqrt(mean(absolute, (value) => value * value)),
    ...{ median: at(0.5), percentile95: at(0.95), percentile99: at(0.99) },
  };
}

function mean({ values, areas }: Cumulative, of: (value: number) => number): number {
  let [sum, before] = [0, 0];
  for (const [place, value] of values.entries()) {
    const area = areas[place] ?? 0;
    sum += of(value) * (area - before);
    before = area;
  }
  return sum / (before || 1);
}

function partsOf(map: DeviationMap, scale: number): Parts {
  const sizes = triangleAreas(map);
  const total = sizes.reduce((sum, size) => sum + size, 0);
  if (sizes.length === 0) return pointsOf(map);
  const parts: Parts = { distances: [], signed: [], areas: [] };
  const { indices } = map;
  for (const [triangle, size] of sizes.entries()) {
    const corners = indices.subarray(3 * triangle, 3 * triangle + 3);
    const count = Math.ceil(Math.sqrt((PARTS * size) / (total || 1)));
    const divisions = Math.min(MAX_DIVISIONS, Math.max(1, count));
    const area = (scale * scale * size) / divisions ** 2;
    for (const weights of middles(divisions)) {
      const at = (all: Float64Array) =>
        corners.reduce((sum, corner, place) => sum + (all[corner] ?? 0) * (weights[place] ?? 0), 0);
      parts.distances.push(at(map.distances));
      parts.signed.push(at(map.signed));
      parts.areas.push(area);
    }
  }
  return parts;
}

/** The points of a scan, each of which counts as 1. */
const pointsOf = ({ distances, signed }: DeviationMap): Parts => ({
  ...{ distances: [...distances], signed: [...signed] },
  areas: Array.from(distances, () => 1),
});

/** Yields the barycentric middles of the triangles that divide one into `count` along each edge. */
function* middles(count: number): Generator<Vector3> {
  for (let row = 0; row < count; row++) {
    for (let column = 0; row + column < count; column++) {
      const [u, v] = [(row + 1 / 3) / count, (column + 1 / 3) / count];
      yield [1 - u - v, u, v];
      if (row + column + 1 >= count) continue;
      const [s, t] = [(row + 2 / 3) / count, (column + 2 / 3) / count];
      yield [1 - s - t, s, t];
    }
  }
}

/** The areas of the map's triangles, in the model's own unit. */
export function triangleAreas({ indices, faces, points }: DeviationMap): Float64Array {
  return Float64Array.from(faces, (_, triangle) => {
    const [a = 0, b = 0, c = 0] = indices.subarray(3 * triangle, 3 * triangle + 3);
    const side = (to: number): Vector3 => [
      (points[3 * to] ?? 0) - (points[3 * a] ?? 0),
      (points[3 * to + 1] ?? 0) - (points[3 * a + 1] ?? 0),
      (points[3 * to + 2] ?? 0) - (points[3 * a + 2] ?? 0),
    ];
    return Math.hypot(...cross(side(b), side(c))) / 2;
  });
}

function cumulative(values: Float64Array, areas: Float64Array, which: Uint32Array): Cumulative {
  const order = which.sort((one, other) => (values[one] ?? 0) - (values[other] ?? 0));
  const [sorted, upTo] = [new Float64Array(order.length), new Float64Array(order.length)];
  let area = 0;
  for (const [place, part] of order.entries()) {
    area += areas[part] ?? 0;
    sorted[place] = values[part] ?? 0;
    upTo[place] = area;
  }
  return { values: sorted, areas: upTo };
}
