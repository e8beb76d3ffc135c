// The edges that are drawn of a face: which one is near a point, from corner to corner, and its length.
import type { DisplayModel } from "../worker/protocol.ts";
import { type Circle, circleOf } from "./fit/circle.ts";
import { along, dot, length, minus, unit, type Vector } from "./fit/linear.ts";

/** The cosine of the turn of drawn edges from which on there is a corner. */
const CORNER = Math.cos((30 * Math.PI) / 180);
/** Parts of the model's diagonal within which drawn ends are one, and corners of two faces. */
const SAME = 1e-6;
const SAME_CORNER = 1e-5;
/** The part of its radius by which an edge may be off the circle that it is said to be. */
const IS_CIRCLE = 1e-3;

/** An edge from corner to corner, or a closed one. */
export interface Edge {
  points: readonly Vector[];
  isClosed: boolean;
  /** Of the drawn line, or of the arc that fits its ends. */
  length: number;
  /** The circle that its points are on; undefined of other curves. */
  circle: Circle | undefined;
}

/** The drawn edges of a model in their model's coordinates, from its tessellation's origin. */
class DrawnEdges {
  readonly #model: DisplayModel;
  readonly #diagonal: number;
  readonly #corners = new Set<string>();
  readonly #faces = new Map<number, Chains>();

  constructor(model: DisplayModel) {
    this.#model = model;
    const { min, max } = model.box;
    this.#diagonal = length(minus(max, min));
    for (let face = 0; face < model.faceNames.length; face++) {
      for (const corner of this.#chains(face).corners) {
        // A corner is in all cells that it is near.
        for (const key of this.#cellsAround(corner)) this.#corners.add(key);
      }
    }
  }

  #chains(face: number): Chains {
    let chains = this.#faces.get(face);
    if (chains === undefined) {
      chains = new Chains(segmentsOf(this.#model, face), SAME * this.#diagonal);
      this.#faces.set(face, chains);
    }
    return chains;
  }

  #cell([x, y, z]: Vector): [number, number, number] {
    const size = SAME_CORNER * this.#diagonal || 1;
    return [Math.round(x / size), Math.round(y / size), Math.round(z / size)];
  }

  #cellsAround(point: Vector): string[] {
    const [x, y, z] = this.#cell(point);
    const around = [-1, 0, 1];
    return around.flatMap((i) =>
      around.flatMap((j) => around.map((k) => [x + i, y + j, z + k].join())),
    );
  }

  /** The edge of a face that is nearest to a point, with its distance. */
  nearest(face: number, point: Vector): { edge: Edge; distance: number } | undefined {
    const isCorner = (at: Vector) => this.#corners.has(this.#cell(at).join());
    return this.#chains(face).nearest(point, isCorner);
  }
}

const known = new WeakMap<DisplayModel, DrawnEdges>();

/**
 * The edge of a face that is nearest to a point, which is relative to the tessellation's origin, with its
 * distance; undefined of a face without edges. It ends where edges turn by 30° or where another face of the model has
 * such a corner. O(n) in the drawn edges of the model at the first call.
 */
export function edgeNear(model: DisplayModel, face: number, point: Vector) {
  let edges = known.get(model);
  if (edges === undefined) {
    edges = new DrawnEdges(model);
    known.set(model, edges);
  }
  return edges.nearest(face, point);
}

type Segment = readonly [Vector, Vector];

function segmentsOf({ outline, tessellation }: DisplayModel, face: number): Segment[] {
  const { positions } = tessellation;
  const at = (index: number): Vector => {
    const place = 3 * (outline.edges[index] ?? 0);
    return [positions[place] ?? 0, positions[place + 1] ?? 0, positions[place + 2] ?? 0];
  };
  const [from, to] = [outline.ends[face - 1] ?? 0, outline.ends[face] ?? 0];
  return Array.from(
    { length: (to - from) / 2 },
    (_, index): Segment => [at(from + 2 * index), at(from + 2 * index + 1)],
  );
}

/** Segments that share ends. */
class Chains {
  readonly #segments: readonly Segment[];
  readonly #atEnds = new Map<string, number[]>();
  readonly #same: number;

  constructor(segments: readonly Segment[], same: number) {
    this.#segments = segments;
    this.#same = same || 1;
    for (const [index, segment] of segments.entries()) {
      for (const end of segment) {
        const key = this.#key(end);
        const all = this.#atEnds.get(key);
        if (all === undefined) this.#atEnds.set(key, [index]);
        else all.push(index);
      }
    }
  }

  #key(point: Vector): string {
    return point.map((at) => Math.round(at / this.#same)).join();
  }

  /** The ends at which the line turns, ends, or branches. O(n). */
  get corners(): Vector[] {
    const found: Vector[] = [];
    for (const [key, all] of this.#atEnds) {
      const [first, second] = all;
      const segment = this.#segments[first ?? 0];
      if (segment === undefined) continue;
      const end = this.#key(segment[0]) === key ? segment[0] : segment[1];
      const goesOn =
        all.length === 2 && second !== undefined && this.#isSmooth(end, segment, second);
      if (!goesOn) found.push(end);
    }
    return found;
  }

  /** The other end of a segment. */
  #other(segment: Segment, end: Vector): Vector {
    return this.#key(segment[0]) === this.#key(end) ? segment[1] : segment[0];
  }

  #isSmooth(end: Vector, segment: Segment, next: number): boolean {
    const other = this.#segments[next];
    if (other === undefined) return false;
    const before = unit(minus(end, this.#other(segment, end)));
    return dot(before, unit(minus(this.#other(other, end), end))) >= CORNER;
  }

  nearest(
    point: Vector,
    isCorner: (at: Vector) => boolean,
  ): { edge: Edge; distance: number } | undefined {
    let [best, distance] = [-1, Number.POSITIVE_INFINITY];
    for (const [index, segment] of this.#segments.entries()) {
      const away = length(minus(point, nearestOn(point, segment)));
      if (away < distance) [best, distance] = [index, away];
    }
    const start = this.#segments[best];
    if (start === undefined) return undefined;
    const forwards = this.#walk(best, start[1], isCorner);
    if (forwards.isClosed) return { edge: edgeOf([start[0], ...forwards.points], true), distance };
    const backwards = this.#walk(best, start[0], isCorner);
    return { edge: edgeOf([...backwards.points.reverse(), ...forwards.points], false), distance };
  }

  /** The points from the end of a segment on, until there is a corner or the segment again. */
  #walk(start: number, end: Vector, isCorner: (at: Vector) => boolean) {
    const points = [end];
    let [index, at] = [start, end];
    for (let count = 0; count < this.#segments.length; count++) {
      const all = this.#atEnds.get(this.#key(at)) ?? [];
      const next = all.find((one) => one !== index);
      const segment = this.#segments[index];
      if (all.length !== 2 || next === undefined || segment === undefined) break;
      if (!this.#isSmooth(at, segment, next) || isCorner(at)) break;
      if (next === start) return { points, isClosed: true };
      at = this.#other(this.#segments[next] ?? segment, at);
      points.push(at);
      index = next;
    }
    return { points, isClosed: false };
  }
}

/** The point of a segment that is nearest to a point. */
export function nearestOn(point: Vector, [from, to]: Segment): Vector {
  const side = minus(to, from);
  const part = dot(minus(point, from), side) / (dot(side, side) || 1);
  return along(from, Math.max(0, Math.min(1, part)), side);
}

function edgeOf(points: readonly Vector[], isClosed: boolean): Edge {
  const fitted = circleOf(points);
  // Three points are on a circle always.
  const isCircle = points.length > 3 && fitted && fitted.residual <= IS_CIRCLE * fitted.radius;
  const circle = isCircle && fitted.radius <= MAX_RADIUS * spanOf(points) ? fitted : undefined;
  const chords = points
    .slice(1)
    .map((point, index) => length(minus(point, points[index] ?? point)));
  const arc = (chord: number) =>
    circle === undefined
      ? chord
      : 2 * circle.radius * Math.asin(Math.min(1, chord / (2 * circle.radius)));
  return { points, isClosed, circle, length: chords.reduce((sum, one) => sum + arc(one), 0) };
}

/** Radii in sizes of an edge from which on it is as good as straight. */
const MAX_RADIUS = 100;

/** The farthest that a point is from the first one. */
const spanOf = (points: readonly Vector[]): number =>
  points.reduce((far, point) => Math.max(far, length(minus(point, points[0] ?? point))), 0);
