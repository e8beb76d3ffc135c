// Faces of parts made of planes and cylinders, as interchange JSON.
import type { ControlPoint, InterchangeCurve, InterchangeSurface } from "nurbs-hausdorff";

type Point = readonly [x: number, y: number, z: number];
type Place = readonly [u: number, v: number];

/** A plane: the point at u = v = 0, and the directions of u and v. */
export interface Plane {
  origin: Point;
  u: Point;
  v: Point;
}

/** A boundary in a plane: corners, or arcs to the next corner about a centre. */
export interface Corner {
  at: Place;
  /** The centre of a quarter circle from here to the next corner. */
  about?: Place;
}

/** Returns a point of a plane. */
const pointOf = ({ origin, u, v }: Plane, [s, t]: Place): Point => [
  origin[0] + s * u[0] + t * v[0],
  origin[1] + s * u[1] + t * v[1],
  origin[2] + s * u[2] + t * v[2],
];

/** A plane face within a boundary, anticlockwise seen from where its normal points, with round holes. */
export function planeFace(
  part: string,
  plane: Plane,
  boundary: readonly Corner[],
  holes: readonly { at: Place; radius: number }[] = [],
): InterchangeSurface {
  const range = (axis: 0 | 1): [number, number] => {
    const values = boundary.map(({ at }) => at[axis]);
    return [Math.min(...values), Math.max(...values)];
  };
  const [us, vs] = [range(0), range(1)];
  const point = (u: number, v: number): ControlPoint => [...pointOf(plane, [u, v]), 1];
  return {
    ...{ part, kind: "plane", degree: [1, 1] },
    knots_u: [us[0], us[0], us[1], us[1]],
    knots_v: [vs[0], vs[0], vs[1], vs[1]],
    ctrl: us.map((u) => vs.map((v) => point(u, v))),
    trim: [outline(boundary), ...holes.map(({ at, radius }) => [clockwise(at, radius)])],
  };
}

/** The lines and quarter circles of a boundary. */
function outline(boundary: readonly Corner[]): InterchangeCurve[] {
  return boundary.map(({ at, about }, index) => {
    const [next = at] = [boundary[(index + 1) % boundary.length]?.at];
    if (about === undefined) {
      return {
        degree: 1,
        knots: [0, 0, 1, 1],
        ctrl: [
          [...at, 1],
          [...next, 1],
        ],
      };
    }
    const corner: Place = [at[0] + next[0] - about[0], at[1] + next[1] - about[1]];
    const ctrl = [
      [...at, 1],
      [...corner, Math.SQRT1_2],
      [...next, 1],
    ] as InterchangeCurve["ctrl"];
    return { degree: 2, knots: [0, 0, 0, 1, 1, 1], ctrl };
  });
}

/** The control points of a whole circle, as eighths of a turn (The NURBS Book, section 7.5). */
const eighths = (turn: 1 | -1): readonly [cos: number, sin: number, weight: number][] =>
  Array.from({ length: 9 }, (_, index) => {
    const angle = (turn * index * Math.PI) / 4;
    const corner = index % 2 === 1;
    const size = corner ? Math.SQRT2 : 1;
    // Quarter turns are exact.
    const exact = (value: number) => (Math.abs(value) < 1e-9 ? 0 : value);
    return [
      exact(size * Math.cos(angle)),
      exact(size * Math.sin(angle)),
      corner ? Math.SQRT1_2 : 1,
    ];
  });

const CIRCLE_KNOTS = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4];

const clockwise = ([u, v]: Place, radius: number): InterchangeCurve => ({
  degree: 2,
  knots: CIRCLE_KNOTS,
  ctrl: eighths(-1).map(([cos, sin, weight]) => [u + radius * cos, v + radius * sin, weight]),
});

/** The wall of a bore: from a plane along its normal; the normal of the wall points to the axis. */
export function bore(
  part: string,
  plane: Plane,
  { at, radius }: { at: Place; radius: number },
  along: Point,
): InterchangeSurface {
  const rows = eighths(1).map(([cos, sin, weight]): ControlPoint[] => {
    const [x, y, z] = pointOf(plane, [at[0] + radius * cos, at[1] + radius * sin]);
    return [
      [x, y, z, weight],
      [x + along[0], y + along[1], z + along[2], weight],
    ];
  });
  return {
    ...{ part, kind: "cylinder", degree: [2, 1], reversed: true },
    ...{ knots_u: CIRCLE_KNOTS, knots_v: [0, 0, 1, 1], ctrl: rows },
  };
}

/** A quarter of a cylinder between two lines of a plane's normal direction. */
export function quarter(
  part: string,
  plane: Plane,
  { from, to, about }: { from: Place; to: Place; about: Place },
  along: Point,
): InterchangeSurface {
  const corner: Place = [from[0] + to[0] - about[0], from[1] + to[1] - about[1]];
  const rows = [
    { place: from, weight: 1 },
    { place: corner, weight: Math.SQRT1_2 },
    { place: to, weight: 1 },
  ].map(({ place, weight }): ControlPoint[] => {
    const [x, y, z] = pointOf(plane, place);
    return [
      [x, y, z, weight],
      [x + along[0], y + along[1], z + along[2], weight],
    ];
  });
  return {
    ...{ part, kind: "cylinder", degree: [2, 1] },
    ...{ knots_u: [0, 0, 0, 1, 1, 1], knots_v: [0, 0, 1, 1], ctrl: rows },
  };
}
