import type { Curve, CurvePiece, NurbsCurve } from "./curve.js";

/** The point, in homogeneous coordinates, at `ratio` of the way from `a` to `b`. */
function between(a: readonly number[], b: readonly number[], ratio: number): number[] {
  return a.map((value, index) => value + ratio * ((b[index] ?? 0) - value));
}

/** Control points multiplied by their weights, the weight last. */
function homogeneous(points: readonly number[][]): number[][] {
  return points.map((point) => {
    const weight = point.at(-1) ?? 1;
    return [...point.slice(0, -1).map((value) => value * weight), weight];
  });
}

function euclidean(points: readonly number[][]): number[][] {
  return points.map((point) => {
    const weight = point.at(-1) ?? 1;
    return [...point.slice(0, -1).map((value) => value / weight), weight];
  });
}

/** Inserts the knot `t` once into a curve of homogeneous points (Boehm's algorithm). */
function insertKnot(degree: number, knots: number[], points: number[][], t: number): number[][] {
  let span = degree;
  while (span + 1 < points.length && (knots[span + 1] ?? 0) <= t) span += 1;
  const inserted = points.slice(0, span - degree + 1);
  for (let index = span - degree + 1; index <= span; index += 1) {
    const [low = 0, high = 1] = [knots[index], knots[index + degree]];
    const ratio = high > low ? (t - low) / (high - low) : 0;
    inserted.push(between(points[index - 1] ?? [], points[index] ?? [], ratio));
  }
  inserted.push(...points.slice(span));
  knots.splice(span + 1, 0, t);
  return inserted;
}

/** The curve over [start, end] of its domain, clamped at both ends. O(degree · size). */
export function restricted(curve: NurbsCurve, start: number, end: number): NurbsCurve {
  const { degree } = curve;
  const knots = [...curve.knots];
  let points = homogeneous(curve.controlPoints);
  for (const t of [start, end]) {
    const multiplicity = knots.filter((knot) => knot === t).length;
    for (let count = multiplicity; count < degree; count += 1) {
      points = insertKnot(degree, knots, points, t);
    }
  }
  // The first control point of the part is the last whose knots all lie up to `start`.
  const first = Math.max(0, knots.lastIndexOf(start) - degree);
  const last = knots.indexOf(end) - 1;
  const inner = knots.filter((knot) => start < knot && knot < end);
  const ends = (t: number) => Array<number>(degree + 1).fill(t);
  return {
    degree,
    knots: [...ends(start), ...inner, ...ends(end)],
    controlPoints: euclidean(points.slice(first, last + 1)),
  };
}

/** The curve run backwards, over the same domain. */
export function reversed({ degree, knots, controlPoints }: NurbsCurve): NurbsCurve {
  const sum = (knots[degree] ?? 0) + (knots[controlPoints.length] ?? 1);
  return {
    degree,
    knots: knots.map((knot) => sum - knot).reverse(),
    controlPoints: [...controlPoints].reverse(),
  };
}

/** The NURBS curves, head to tail, of the part [start, end] of a curve. */
export function part(curve: Curve, [start, end]: readonly [number, number]): NurbsCurve[] {
  const overlaps = ({ domain: [a, b] }: CurvePiece) => a < end && start < b;
  return curve.pieces.filter(overlaps).map(({ domain, nurbs, parameter }) => {
    const [from, to] = [Math.max(start, domain[0]), Math.min(end, domain[1])];
    return restricted(nurbs, parameter(from), parameter(to));
  });
}

/** The point of a curve at a parameter of its domain (de Boor's algorithm). */
export function pointAt(curve: NurbsCurve, t: number): number[] {
  const { degree, knots } = curve;
  const points = homogeneous(curve.controlPoints);
  let span = degree;
  while (span + 1 < points.length && (knots[span + 1] ?? 0) <= t) span += 1;
  const local = points.slice(span - degree, span + 1);
  for (let level = 1; level <= degree; level += 1) {
    for (let index = degree; index >= level; index -= 1) {
      const low = knots[span - degree + index] ?? 0;
      const high = knots[span + 1 + index - level] ?? 1;
      const ratio = high > low ? (t - low) / (high - low) : 0;
      local[index] = between(local[index - 1] ?? [], local[index] ?? [], ratio);
    }
  }
  return euclidean([local[degree] ?? []])[0]?.slice(0, -1) ?? [];
}
