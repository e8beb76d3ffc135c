import type { NurbsCurve } from "./curve.js";
import { pointAt, restricted } from "./curve-operations.js";
import type { ParameterMaps } from "./parameter-map.js";

/** A trimming curve in the parameters of the NURBS form. */
export interface MappedCurve {
  curve: NurbsCurve;
  /** For an approximation, the curve in the surface's own parameters, over the same knots. */
  original: NurbsCurve | null;
}

/** The largest deviation of an approximation, relative to the parameter's range. */
const TOLERANCE = 1e-9;
/** Halvings of an approximated piece; each divides its deviation by 16. */
const MAX_HALVINGS = 10;
/** Points at which the deviation of a piece is measured. */
const CHECKS = 8;
/** Bernstein control values of the cubic through values at 0, 1/3, 2/3 and 1. */
const INNER = [
  [-5 / 6, 3, -3 / 2, 1 / 3],
  [1 / 3, -3 / 2, 3, -5 / 6],
] as const;

/**
 * The image of a trimming curve: exact for parameter lines, whose direction a
 * map of each parameter keeps, and else piecewise cubics through its points.
 * `range` is the length of the longer parameter interval.
 */
export function mappedCurve(
  curve: NurbsCurve,
  [u, v]: ParameterMaps,
  range: number,
): MappedCurve[] {
  if (u === null && v === null) return [{ curve, original: null }];
  const image = ([a = 0, b = 0]: readonly number[]) => [u?.(a) ?? a, v?.(b) ?? b];
  if (isParameterLine(curve, 0) || isParameterLine(curve, 1)) {
    const ends = [curve.controlPoints[0] ?? [], curve.controlPoints.at(-1) ?? []];
    const controlPoints = ends.map((end) => [...image(end), 1]);
    return [{ curve: { degree: 1, knots: [0, 0, 1, 1], controlPoints }, original: null }];
  }
  return knotSpans(curve).flatMap((piece) => cubics(piece, image, TOLERANCE * range, MAX_HALVINGS));
}

/** Whether a coordinate is constant and the other one runs one way. */
function isParameterLine(curve: NurbsCurve, axis: 0 | 1): boolean {
  const [values, others] = [axis, 1 - axis].map((at) => curve.controlPoints.map((p) => p[at] ?? 0));
  const steps = (others ?? []).slice(1).map((value, index) => value - (others?.[index] ?? 0));
  const runsOneWay = steps.every((step) => step >= 0) || steps.every((step) => step <= 0);
  return runsOneWay && (values ?? []).every((value) => value === values?.[0]);
}

function knotSpans(curve: NurbsCurve): NurbsCurve[] {
  const knots = [...new Set(curve.knots.slice(curve.degree, curve.controlPoints.length + 1))];
  return knots.slice(1).map((end, index) => restricted(curve, knots[index] ?? 0, end));
}

function cubics(
  original: NurbsCurve,
  image: (point: readonly number[]) => number[],
  tolerance: number,
  halvings: number,
): MappedCurve[] {
  const [start, end] = [original.knots[0] ?? 0, original.knots.at(-1) ?? 1];
  const at = (fraction: number) => start + fraction * (end - start);
  const target = (t: number) => image(pointAt(original, t));
  const ends = [original.controlPoints[0] ?? [], original.controlPoints.at(-1) ?? []].map(image);
  const points = [ends[0] ?? [], target(at(1 / 3)), target(at(2 / 3)), ends[1] ?? []];
  const inner = INNER.map((row) =>
    [0, 1].map((axis) =>
      row.reduce((sum, factor, k) => sum + factor * (points[k]?.[axis] ?? 0), 0),
    ),
  );
  const controlPoints = [points[0] ?? [], ...inner, points[3] ?? []].map((point) => [...point, 1]);
  const knots = [...Array<number>(4).fill(start), ...Array<number>(4).fill(end)];
  const curve = { degree: 3, knots, controlPoints };
  const deviates = Array.from({ length: CHECKS }, (_, k) => at((k + 0.5) / CHECKS)).some((t) => {
    const [a = [], b = []] = [pointAt(curve, t), target(t)];
    return Math.hypot((a[0] ?? 0) - (b[0] ?? 0), (a[1] ?? 0) - (b[1] ?? 0)) > tolerance;
  });
  if (!deviates || halvings === 0) return [{ curve, original }];
  const halves = [restricted(original, start, at(0.5)), restricted(original, at(0.5), end)];
  return halves.flatMap((half) => cubics(half, image, tolerance, halvings - 1));
}
