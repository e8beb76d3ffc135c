// The sphere, cylinder, cone or torus that fits points of a face with their normals.
import { acrossOf, planeCircle } from "./circle.ts";
import {
  along,
  crossed,
  dot,
  eigen,
  leastSquares,
  length,
  type Matrix,
  mean,
  minus,
  outerSum,
  solve,
  unit,
  type Vector,
} from "./linear.ts";

/** A point of a face with its unit normal. */
export interface Oriented {
  point: Vector;
  normal: Vector;
}

interface Fitted {
  /** The largest distance of a point of the face from it. */
  residual: number;
}

/** A surface about an axis: a point of that and its direction. */
interface Revolved extends Fitted {
  center: Vector;
  axis: Vector;
}

export type Fit =
  | (Fitted & { kind: "sphere"; center: Vector; radius: number })
  | (Revolved & { kind: "cylinder"; radius: number })
  /** `center` is the apex, `angle` the one between the axis and the cone's lines. */
  | (Revolved & { kind: "cone"; angle: number })
  /** `radius` is that of the tube, `around` that of its middle line. */
  | (Revolved & { kind: "torus"; radius: number; around: number });

/** The part of the size of a face by which its points may be off a surface that is said to fit. */
const FITS = 1e-3;
/** The part of its size by which points are off their face by rounding. */
const ROUNDING = 1e-6;
/** How many times as far off the best a simpler surface may be: of noise, the one with more freedom is better. */
const SIMPLER = 10;
/** Radii in sizes of the face from which on it is as good as plane. */
const FLAT = 1e3;

/**
 * Returns the simplest of cylinder, sphere, cone and torus that fits all points within `FITS` of their size and is
 * about as near them as the best; undefined where none is, as of planes and free forms. Points are off their
 * face by up to `rounding`. O(n).
 */
export function fitOf(points: readonly Oriented[], rounding = 0): Fit | undefined {
  const middle = mean(points.map(({ point }) => point));
  const size = points.reduce((far, { point }) => Math.max(far, length(minus(point, middle))), 0);
  if (!(size > 0) || points.length < 4) return undefined;
  // About the origin and of size 1, so that sums of squares keep their digits.
  const own = points.map(({ point, normal }) => ({
    point: along([0, 0, 0], 1 / size, minus(point, middle)),
    normal: unit(normal),
  }));
  const floor = Math.max(ROUNDING, rounding / size);
  if (isPlane(own, floor)) return undefined;
  const fits = [cylinder, sphere, cone, torus]
    .flatMap((fit) => fit(own) ?? [])
    .filter((fit) => fit.residual <= FITS && radiusOf(fit) < FLAT);
  const best = fits.reduce((least, { residual }) => Math.min(least, residual), FITS);
  const found = fits.find(({ residual }) => residual <= Math.max(floor, SIMPLER * best));
  return found && placed(found, middle, size);
}

function isPlane(points: readonly Oriented[], tolerance: number): boolean {
  const [flat] = eigen(outerSum(points.map(({ point }) => [point, point])));
  return flat === undefined || largest(points, (point) => dot(point, flat.vector)) <= tolerance;
}

/** Of a cone what says how flat it is: the tangent of its angle. */
const radiusOf = (fit: Fit): number =>
  fit.kind === "cone" ? Math.tan(fit.angle) : fit.kind === "torus" ? fit.around : fit.radius;

/** A fit where the points were. */
function placed(fit: Fit, middle: Vector, size: number): Fit {
  const center = along(middle, size, fit.center);
  const residual = size * fit.residual;
  if (fit.kind === "cone") return { ...fit, center, residual };
  const radius = size * fit.radius;
  if (fit.kind === "torus") return { ...fit, center, residual, radius, around: size * fit.around };
  return { ...fit, center, residual, radius };
}

/** The distance of a point from a line. */
export const fromAxis = (point: Vector, center: Vector, axis: Vector): number =>
  length(crossed(minus(point, center), axis));

const largest = (points: readonly Oriented[], off: (point: Vector) => number): number =>
  points.reduce((far, { point }) => Math.max(far, Math.abs(off(point))), 0);

function sphere(points: readonly Oriented[]): Fit | undefined {
  const found = leastSquares(
    points.map(({ point }) => [...point.map((at) => 2 * at), 1]),
    points.map(({ point }) => dot(point, point)),
  );
  if (found === undefined) return undefined;
  const [x = 0, y = 0, z = 0, rest = 0] = found;
  const center: Vector = [x, y, z];
  const radius = Math.sqrt(rest + dot(center, center));
  const residual = largest(points, (point) => length(minus(point, center)) - radius);
  return { kind: "sphere", center, radius, residual };
}

/** All normals of a cylinder are perpendicular to its axis. */
function cylinder(points: readonly Oriented[]): Fit | undefined {
  const [least] = eigen(outerSum(points.map(({ normal }) => [normal, normal])));
  if (least === undefined) return undefined;
  const axis = least.vector;
  const [e, f] = acrossOf(axis);
  const circle = planeCircle(points.map(({ point }) => [dot(point, e), dot(point, f)]));
  if (circle === undefined) return undefined;
  const { x, y, radius } = circle;
  const center = along(along([0, 0, 0], x, e), y, f);
  const residual = largest(points, (point) => fromAxis(point, center, axis) - radius);
  return { kind: "cylinder", center, axis, radius, residual };
}

/** All normals of a cone have one angle with its axis, and all its tangent planes go through its apex. */
function cone(points: readonly Oriented[]): Fit | undefined {
  const middle = mean(points.map(({ normal }) => normal));
  const ways = points.map(({ normal }) => minus(normal, middle));
  const [least] = eigen(outerSum(ways.map((way) => [way, way])));
  const apex = leastSquares(
    points.map(({ normal }) => normal),
    points.map(({ point, normal }) => dot(point, normal)),
  );
  if (least === undefined || apex === undefined) return undefined;
  const axis = least.vector;
  const center = apex as unknown as Vector;
  const angle = Math.asin(Math.min(1, Math.abs(dot(middle, axis))));
  const residual = largest(points, (point) => {
    const up = Math.abs(dot(minus(point, center), axis));
    return fromAxis(point, center, axis) * Math.cos(angle) - up * Math.sin(angle);
  });
  return { kind: "cone", center, axis, angle, residual };
}

/** The normals of a surface of revolution all meet its axis; a torus is a circle about it. */
function torus(points: readonly Oriented[]): Fit | undefined {
  const found = axisOf(points);
  if (found === undefined) return undefined;
  const { axis, center } = found;
  const half = points.map(({ point }): [number, number] => [
    fromAxis(point, center, axis),
    dot(minus(point, center), axis),
  ]);
  const circle = planeCircle(half);
  if (circle === undefined) return undefined;
  const { x: around, y: height, radius } = circle;
  const residual = half.reduce(
    (far, [out, up]) => Math.max(far, Math.abs(Math.hypot(out - around, up - height) - radius)),
    0,
  );
  const middle = along(center, height, axis);
  return { kind: "torus", center: middle, axis, radius, around, residual };
}

/**
 * The line that all normals meet best: of its direction d and moment m, d·(p × n) + m·n = 0 for each point p with
 * normal n (Pottmann and Randrup 1998).
 */
function axisOf(points: readonly Oriented[]): { axis: Vector; center: Vector } | undefined {
  const moments = points.map(({ point, normal }) => crossed(point, normal));
  const pairs = points.map(({ normal }, index) => [normal, moments[index] ?? normal] as const);
  const a = outerSum(pairs.map(([normal]) => [normal, normal]));
  const b = outerSum(pairs);
  const c = outerSum(moments.map((moment) => [moment, moment]));
  // The moment that is best for a direction is −A⁻¹ B d.
  const columns = [0, 1, 2].map((column) =>
    solve(
      a,
      b.map((row) => row[column] ?? 0),
    ),
  );
  if (columns.some((column) => column === undefined)) return undefined;
  const ab = (row: number, column: number) => columns[column]?.[row] ?? 0;
  const reduced = [0, 1, 2].map((i) =>
    [0, 1, 2].map((j) => {
      const product = [0, 1, 2].reduce((sum, k) => sum + (b[k]?.[i] ?? 0) * ab(k, j), 0);
      return (c[i]?.[j] ?? 0) - product;
    }),
  );
  const [least] = eigen(reduced as unknown as Matrix);
  if (least === undefined) return undefined;
  const axis = least.vector;
  const moment = [0, 1, 2].map((row) =>
    [0, 1, 2].reduce((sum, column) => sum - ab(row, column) * (axis[column] ?? 0), 0),
  );
  return { axis, center: crossed(axis, moment as unknown as Vector) };
}
