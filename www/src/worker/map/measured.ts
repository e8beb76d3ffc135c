// The deviations of points of one model from the other one.
import type { Hausdorff, NurbsModel, Signs, Vector3 } from "nurbs-hausdorff/worker";
import type { Side } from "../protocol.ts";
import { diagonalOf, joinedArrays } from "./base.ts";
import { mapped, type Placing, placed, unplaced } from "./placed.ts";

/** Points measured at once, so that a newer request waits for few of them. */
const BATCH = 8192;

/**
 * The permitted excess of a distance, in diagonals: a tenth of the least step of colours. Points
 * that are off a model by the rounding of float32 alone take several times as long at the default.
 */
const RELATIVE_TOLERANCE = 5e-8;

/** The distance, in diagonals, up to which no sign is shown: it has the neutral colour. */
const SIGN_TOLERANCE = 5e-7;

/** Deviations, in the unit of a result. */
export interface Measured {
  distances: Float64Array<ArrayBuffer>;
  /** With signs; NaN without one. */
  signed: Float64Array<ArrayBuffer>;
  /** x, y, z of the closest points, in the coordinates of a result. */
  feet: Float64Array<ArrayBuffer>;
  signs: Signs;
}

/** One model, whose points are measured, and the other one. */
export interface Measuring extends Placing {
  engine: Hausdorff;
  side: Side;
  other: NurbsModel;
  /** No distance exceeds it. */
  upper: number;
  signal: AbortSignal;
  /** Called with the number of points measured. */
  onPoints: (count: number) => void;
}

/** Measures points of the model, in its own coordinates. */
export async function measure(points: Float64Array, measuring: Measuring): Promise<Measured> {
  const { engine, side, other, upper, signal, onPoints } = measuring;
  const otherSide: Side = side === "a" ? "b" : "a";
  const size = otherSide === "b" ? measuring.scale : 1;
  const signTolerance = SIGN_TOLERANCE * diagonalOf(other);
  const options = { relativeTolerance: RELATIVE_TOLERANCE, signTolerance, signal };
  let all = none();
  for (let first = 0; first < points.length; first += 3 * BATCH) {
    const batch = points.subarray(first, first + 3 * BATCH);
    const query = mapped(batch, (point) =>
      unplaced(otherSide, placed(side, point, measuring), measuring),
    );
    const found = await engine.closestPoints(other, query, options);
    all = together(all, {
      distances: found.distances.map((distance) => Math.min(upper, size * distance)),
      signed: found.signed.map((value) => clamped(size * value, upper)),
      feet: mapped(found.feet, (foot: Vector3) => placed(otherSide, foot, measuring)),
      signs: found.signs,
    });
    onPoints(batch.length / 3);
  }
  return all;
}

export const none = (): Measured => ({
  distances: new Float64Array(),
  signed: new Float64Array(),
  feet: new Float64Array(),
  signs: "faces",
});

/** Returns the deviations of points followed by those of others. */
export const together = (one: Measured, other: Measured): Measured => ({
  distances: joinedArrays(one.distances, other.distances),
  signed: joinedArrays(one.signed, other.signed),
  feet: joinedArrays(one.feet, other.feet),
  signs: other.signs,
});

/** The deviations of some of the points. */
export const chosen = (
  { distances, signed, feet, signs }: Measured,
  which: Uint32Array,
): Measured => ({
  distances: Float64Array.from(which, (index) => distances[index] ?? 0),
  signed: Float64Array.from(which, (index) => signed[index] ?? 0),
  feet: chosenPoints(feet, which),
  signs,
});

/** Some of the points. */
export function chosenPoints(
  points: Float32Array | Float64Array,
  which: Uint32Array,
): Float64Array<ArrayBuffer> {
  const all = new Float64Array(3 * which.length);
  for (const [place, index] of which.entries()) {
    all.set(points.subarray(3 * index, 3 * index + 3), 3 * place);
  }
  return all;
}

/** A number without a sign stays without one. */
const clamped = (value: number, upper: number): number =>
  Math.abs(value) > upper ? Math.sign(value) * upper : value;
