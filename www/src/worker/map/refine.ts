// A map whose colours, between its vertices, are those of the model to a step of the legend:
// edges are split where the deviation in their middle is not the mean of their ends'.
import { type Base, joined, lengthOf, middlesOf, type Vertices } from "./base.ts";
import {
  chosen,
  chosenPoints,
  type Measured,
  type Measuring,
  measure,
  together,
} from "./measured.ts";
import { edgeEnds, edgesOf, split } from "./triangles.ts";

/** Rounds of splitting, and edges tried in each: the longest first. */
const MAX_ROUNDS = 6;
const MAX_EDGES = 30_000;
/** The number of vertices after which a map is fine enough for any screen. */
const MAX_VERTICES = 150_000;
/** The shortest edges that are tried, in diagonals: about a pixel where a model fills a screen. */
const MIN_EDGE = 1 / 1000;
/** Edges shorter than this whose ends differ by a small part of a step are taken as even. */
const EVEN_EDGE = 1 / 100;
const EVEN_PART = 1 / 8;

/** How fine a map becomes. */
export interface Fineness {
  /** The deviation by which its colours may be off. */
  step: number;
  /** The models' diagonal, which edges are compared with. */
  diagonal: number;
}

/** A measured map. */
export interface DeviationMap extends Base, Measured {}

/** Measures the vertices of a model. */
export async function mapOf(base: Base, measuring: Measuring): Promise<DeviationMap> {
  return { ...base, ...(await measure(base.points, measuring)) };
}

/** Splits the map until its middles are within `step`, and returns it. */
export async function refined(
  map: DeviationMap,
  measuring: Measuring,
  { step, diagonal }: Fineness,
): Promise<DeviationMap> {
  const settled = new Set<number>();
  let fine = map;
  for (let round = 0; round < MAX_ROUNDS; round++) {
    if (fine.distances.length > MAX_VERTICES) break;
    const edges = edgesToTry(fine, settled, { step, diagonal });
    if (edges.length === 0) break;
    const middles = middlesOf(fine, edges, fine);
    const found = await measure(middles.points, measuring);
    const wrong = new Uint32Array(
      [...edges.keys()].filter((index) => {
        const off = isOff(fine, edges[index] ?? 0, found, index, step);
        if (!off) settled.add(edges[index] ?? 0);
        return off;
      }),
    );
    const count = fine.distances.length;
    const added = new Map([...wrong].map((index, place) => [edges[index] ?? 0, count + place]));
    const kept: Vertices = {
      positions: new Float32Array(chosenPoints(middles.positions, wrong)),
      normals: new Float32Array(chosenPoints(middles.normals, wrong)),
      points: chosenPoints(middles.points, wrong),
      slacks: Float64Array.from(wrong, (index) => middles.slacks[index] ?? 0),
    };
    const { origin, isMesh, flatness } = fine;
    fine = {
      ...{ origin, isMesh, flatness, triangles: split(fine.triangles, added) },
      ...joined(fine, kept),
      ...together(fine, chosen(found, wrong)),
    };
  }
  return fine;
}

/**
 * The edges along which the deviation may be off by more than a step. A distance changes by at
 * most the way gone, so that it is within half of what an edge is longer than its ends differ.
 */
function edgesToTry(
  map: DeviationMap,
  settled: Set<number>,
  { step, diagonal }: Fineness,
): Float64Array {
  const { points, distances, signed } = map;
  const tried: { edge: number; slack: number }[] = [];
  for (const edge of edgesOf(map.triangles)) {
    if (settled.has(edge)) continue;
    const [from, to] = edgeEnds(edge);
    const length = lengthOf(points, from, to);
    if (length < MIN_EDGE * diagonal) continue;
    const [one, other] = [distances[from] ?? 0, distances[to] ?? 0];
    const isEven = Math.abs((signed[from] ?? 0) - (signed[to] ?? 0)) < EVEN_PART * step;
    if (isEven && length < EVEN_EDGE * diagonal) continue;
    const slack = (length - Math.abs(one - other)) / 2;
    const turns = (signed[from] ?? 0) * (signed[to] ?? 0) < 0 && Math.max(one, other) > step;
    if (slack > step || (turns && length > step)) tried.push({ edge, slack });
  }
  tried.sort((one, other) => other.slack - one.slack);
  return Float64Array.from(tried.slice(0, MAX_EDGES), ({ edge }) => edge);
}

/** Whether the mean of an edge's ends is not the deviation of its middle, to a step. */
function isOff(
  { distances, signed }: Measured,
  edge: number,
  found: Measured,
  index: number,
  step: number,
): boolean {
  const [from, to] = edgeEnds(edge);
  const error = (ends: Float64Array, middles: Float64Array) =>
    Math.abs(((ends[from] ?? 0) + (ends[to] ?? 0)) / 2 - (middles[index] ?? 0));
  const bySign = error(signed, found.signed);
  return (Number.isNaN(bySign) ? error(distances, found.distances) : bySign) > step;
}
