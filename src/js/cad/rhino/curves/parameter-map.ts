import type { InterchangeSurface } from "../../../model/surface.js";
import type { RhinoNurbsSurface, RhinoSurface } from "../types.js";

/** An increasing map of one parameter; null is the identity. */
export type ParameterMap = ((parameter: number) => number) | null;

/**
 * The maps from a surface's own parameters u and v to those of its NURBS form.
 * openNURBS parametrizes arcs by angle, and their NURBS form by
 * t = m + h tan((u - m) a / (2 h)) / tan(a / 2) on a span of middle m, half
 * length h and half angle a.
 */
export type ParameterMaps = readonly [u: ParameterMap, v: ParameterMap];

/** Parameters, as fractions of the domain, at which the two forms are compared. */
const PROBES = [0.07, 0.29, 0.5, 0.61, 0.93];
/** The relative deviation up to which points count as one. */
const SAME = 1e-9;

/** The maps, or null if no pair of them makes the two forms one surface. */
export function parameterMaps(
  surface: RhinoSurface,
  nurbs: RhinoNurbsSurface,
  form: InterchangeSurface,
): ParameterMaps | null {
  const [us, vs] = ([0, 1] as const).map((axis) => [null, arcMap(form, axis)]) as [
    ParameterMap[],
    ParameterMap[],
  ];
  const pairs = us.flatMap((u) => vs.map((v): ParameterMaps => [u, v]));
  return pairs.find((maps) => agree(surface, nurbs, form, maps)) ?? null;
}

function agree(
  surface: RhinoSurface,
  nurbs: RhinoNurbsSurface,
  form: InterchangeSurface,
  [u, v]: ParameterMaps,
): boolean {
  const [us, vs] = [probes(form, 0), probes(form, 1)];
  return us.every((a) =>
    vs.every((b) => {
      const expected = surface.pointAt(a, b);
      const found = nurbs.pointAt(u?.(a) ?? a, v?.(b) ?? b);
      const size = Math.hypot(...expected) + 1;
      return Math.hypot(...found.map((x, i) => x - (expected[i] ?? 0))) <= SAME * size;
    }),
  );
}

function probes(form: InterchangeSurface, axis: 0 | 1): number[] {
  const [start, end] = domain(form, axis);
  return PROBES.map((fraction) => start + fraction * (end - start));
}

/** The domain of a surface along an axis. */
export function domain(form: InterchangeSurface, axis: 0 | 1): [number, number] {
  const knots = axis === 0 ? form.knots_u : form.knots_v;
  const degree = form.degree[axis];
  return [knots[degree] ?? 0, knots[knots.length - 1 - degree] ?? 1];
}

/** The map of an axis along which the surface is made of circular arcs, or null. */
function arcMap(form: InterchangeSurface, axis: 0 | 1): ParameterMap {
  if (form.degree[axis] !== 2) return null;
  const knots = axis === 0 ? form.knots_u : form.knots_v;
  const breaks = [...new Set(knots)];
  const spans = breaks.length - 1;
  const weights =
    axis === 0
      ? form.ctrl.map((row) => row[0]?.[3] ?? 1)
      : (form.ctrl[0] ?? []).map(([, , , w]) => w);
  if (weights.length !== 2 * spans + 1) return null;
  // The middle weight of an arc is the cosine of its half angle.
  const angles = breaks
    .slice(1)
    .map((_, span) => Math.acos((weights[2 * span + 1] ?? 1) / (weights[2 * span] ?? 1)));
  if (!angles.every((angle) => angle > 0)) return null;
  return (u: number) => {
    const span = Math.min(spans, Math.max(1, breaks.filter((knot) => knot <= u).length)) - 1;
    const [start = 0, end = 1, angle = 1] = [breaks[span], breaks[span + 1], angles[span]];
    // At knots the parameters are equal, without rounding.
    if (u === start || u === end) return u;
    const [middle, half] = [(start + end) / 2, (end - start) / 2];
    return middle + (half * Math.tan((angle * (u - middle)) / (2 * half))) / Math.tan(angle / 2);
  };
}
