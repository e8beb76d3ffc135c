// The pairs of the sweeps, shared with the command line's experiments, and the path of A past B.

import type { Transform, Vector3 } from "nurbs-hausdorff";
import sweep from "../../../../examples/experiments/sweep.json";
import { texts } from "../../texts/index.ts";
import type { DisplayModel, Side } from "../../worker/protocol.ts";

/** One model of a pair. */
export interface Part {
  /** The name of a shape. */
  shape: string;
  /** The model for which the shape is a substitute, if it is one. */
  substituteFor: string | undefined;
  /** Whether only the first surface of that model is used. */
  firstSurface: boolean;
}

export interface Pair {
  /** A short name, for the table's file. */
  name: string;
  title: string;
  /** Undefined for a pair of the user's files. */
  parts: Record<Side, Part> | undefined;
  /** The direction, of length 1, in which A moves through B. */
  axis: Vector3;
  /** The offset at which A passes B's centre, in units of B's diagonal. */
  aside: Vector3;
}

type Numbers = readonly number[];

const vector = ([x = 0, y = 0, z = 0]: Numbers): Vector3 => [x, y, z];

interface Listed {
  shape: string;
  for?: string;
  first_surface?: boolean;
}

const part = ({ shape, for: substituteFor, first_surface }: Listed): Part => ({
  shape,
  substituteFor,
  firstSurface: first_surface === true,
});

/** The pair of the user's files, with the path of the list's solid bodies. */
const OWN: Pair = {
  name: "own",
  title: texts.experiments.ownFilesChosenBelow,
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

type Box = DisplayModel["box"];

/**
 * Returns `count` positions of A's centre along the axis, symmetric about B's
 * centre. The range is proportional to the models' extents along the axis, or
 * to B's diagonal if both extents are 0.
 */
export function positions({ axis }: Pair, a: Box, b: Box, count: number): number[] {
  const extent = ({ min, max }: Box) => dot(axis, minus(max, min));
  const reach = sweep.reach * 0.5 * (extent(a) + extent(b) || diagonal(b) || 1);
  return Array.from({ length: count }, (_, index) => reach * ((2 * index) / (count - 1) - 1));
}

/** Returns the transform that moves A to `position`. */
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
