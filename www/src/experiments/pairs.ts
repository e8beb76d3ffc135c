// The pairs that are swept, by the command line's names, and the way of A past B.
import type { Transform, Vector3 } from "nurbs-hausdorff";
import type { Shown, Sides, Source } from "../protocol.ts";
import { ball, sheet } from "./nets.ts";

export interface Pair {
  /** Short, for the table's file name. */
  name: string;
  title: string;
  /** The models; undefined where the user's files are. */
  sources: (() => Required<Sides<Source>>) | undefined;
  /** A moves along it through B. */
  axis: Vector3;
  /** What A passes B's centre at, in B's diagonals. */
  aside: Vector3;
}

/** How far A goes from B's centre, relative to where their boxes part. */
const REACH = 1.5;

const X: Vector3 = [1, 0, 0];
const Z: Vector3 = [0, 0, 1];
const CENTRAL: Vector3 = [0, 0, 0];
/** Off the centre, so that equal bodies do not coincide and no symmetry helps. */
const ASIDE: Vector3 = [0.05, 0.04, 0.03];

export const pairs: readonly Pair[] = [
  {
    name: "small",
    title: "Two sheets of 6 × 6 control points",
    sources: () => ({ a: sheet([6, 6], 0), b: sheet([6, 6], 1) }),
    axis: Z,
    aside: CENTRAL,
  },
  {
    name: "body",
    title: "A bottle (for the duck’s body) past its copy",
    sources: () => ({ a: { shape: "bottle" }, b: { shape: "bottle" } }),
    axis: X,
    aside: ASIDE,
  },
  {
    name: "large",
    title: "Large nets, 298 × 313 against 595 × 97",
    sources: () => ({ a: sheet([298, 313], 0), b: sheet([595, 97], 1) }),
    axis: Z,
    aside: CENTRAL,
  },
  {
    name: "copy",
    title: "A sheet through its own copy",
    sources: () => ({ a: sheet([6, 6], 0), b: sheet([6, 6], 0) }),
    axis: Z,
    aside: CENTRAL,
  },
  {
    name: "nested",
    title: "A ball of radius 0.2 through a hollow sphere of radius 2",
    sources: () => ({ a: ball(0.2), b: { shape: "sphere" } }),
    axis: X,
    aside: CENTRAL,
  },
  { name: "own", title: "Own files, as below", sources: undefined, axis: X, aside: ASIDE },
];

type Box = Shown["box"];

/**
 * `count` positions of A's centre along the axis, 0 beside B's centre. Models
 * that are flat across the axis, as own files may be, go as far as B is large.
 */
export function positions({ axis }: Pair, a: Box, b: Box, count: number): number[] {
  const extent = ({ min, max }: Box) => dot(axis, minus(max, min));
  const reach = REACH * 0.5 * (extent(a) + extent(b) || diagonal(b) || 1);
  return Array.from({ length: count }, (_, index) => reach * ((2 * index) / (count - 1) - 1));
}

/** What brings A to `position`. */
export function transformAt({ axis, aside }: Pair, a: Box, b: Box, position: number): Transform {
  const apart = minus(center(b), center(a));
  const size = diagonal(b);
  const along = (at: 0 | 1 | 2) => apart[at] + aside[at] * size + axis[at] * position;
  return { translation: [along(0), along(1), along(2)] };
}

const diagonal = ({ min, max }: Box): number => Math.hypot(...minus(max, min));

const minus = (one: Vector3, other: Vector3): Vector3 => [
  one[0] - other[0],
  one[1] - other[1],
  one[2] - other[2],
];

const dot = (one: Vector3, other: Vector3): number =>
  one[0] * other[0] + one[1] * other[1] + one[2] * other[2];

const center = ({ min, max }: Box): Vector3 => [
  0.5 * (min[0] + max[0]),
  0.5 * (min[1] + max[1]),
  0.5 * (min[2] + max[2]),
];
