// The pairs that are swept, which the command line reads from the same file, and the way of A past B.
import type { Transform, Vector3 } from "nurbs-hausdorff";
import sweep from "../../../examples/experiments/sweep.json";
import type { Shown, Side } from "../protocol.ts";

/** What a pair has in the place of a model. */
export interface Part {
  /** A shape's name. */
  shape: string;
  /** The model of others that the shape stands in for, if it does. */
  standsFor: string | undefined;
  /** Whether only the first surface of that model is meant. */
  firstSurface: boolean;
}

export interface Pair {
  /** Short, for the table's file name. */
  name: string;
  title: string;
  /** Undefined where the user's files are. */
  parts: Record<Side, Part> | undefined;
  /** A moves along it through B. */
  axis: Vector3;
  /** What A passes B's centre at, in B's diagonals. */
  aside: Vector3;
}

type Numbers = readonly number[];

const vector = ([x = 0, y = 0, z = 0]: Numbers): Vector3 => [x, y, z];

interface Listed {
  shape: string;
  for?: string;
  first_surface?: boolean;
}

const part = ({ shape, for: standsFor, first_surface }: Listed): Part => ({
  shape,
  standsFor,
  firstSurface: first_surface === true,
});

/** The user's files, as bodies of others pass each other in the list. */
const OWN: Pair = {
  name: "own",
  title: "Own files, as below",
  parts: undefined,
  axis: [1, 0, 0],
  aside: [0.05, 0.04, 0.03],
};

export const pairs: readonly Pair[] = [
  ...sweep.pairs.map(({ name, title, a, b, axis, aside }) => ({
    ...{ name, title, parts: { a: part(a), b: part(b) } },
    ...{ axis: vector(axis), aside: vector(aside) },
  })),
  OWN,
];

type Box = Shown["box"];

/**
 * `count` positions of A's centre along the axis, 0 beside B's centre. Models
 * that are flat across the axis, as own files may be, go as far as B is large.
 */
export function positions({ axis }: Pair, a: Box, b: Box, count: number): number[] {
  const extent = ({ min, max }: Box) => dot(axis, minus(max, min));
  const reach = sweep.reach * 0.5 * (extent(a) + extent(b) || diagonal(b) || 1);
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
