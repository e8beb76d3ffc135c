import { HausdorffError } from "../error.js";
import { checkKeys } from "../keys.js";
import type { DistanceEngine } from "../measure/engine.js";
import type { BestFit, BestFitOptions } from "./fit.js";
import { dampedStep, type LeastSquares, leastSquares } from "./least-squares.js";
import { complete, followed, type Rigid } from "./rigid.js";

/** The names of the options. */
const OPTIONS: readonly (keyof BestFitOptions)[] = [
  ...(["samples", "sampling", "transform", "tolerance", "relativeTolerance"] as const),
  ...(["maxSteps", "scaleUnits", "signal", "onProgress"] as const),
];

/** The damping of the first step, relative to unit weights, and how it changes. */
const FIRST_DAMPING = 1e-3;
const DAMPING_FACTOR = 10;

/**
 * The smallest damping: directions from feet are off by 1e-8, and where the samples
 * determine nothing, a step is that error over the damping.
 */
const MIN_DAMPING = 1e-6;

/** The part of the mean square by which a step has to lower it: above its rounding. */
const MIN_GAIN = 1e-12;

const DEFAULTS = { samples: 16, relativeTolerance: 1e-9, maxSteps: 100 };

/**
 * The method `bestFit` of an engine, by its method `field`.
 * @internal
 */
export async function bestFit<Model>(
  engine: Pick<DistanceEngine<Model>, "field">,
  a: Model,
  b: Model,
  fitOptions: BestFitOptions = {},
): Promise<BestFit> {
  checkKeys("options", fitOptions, OPTIONS);
  const { onProgress, tolerance, relativeTolerance, maxSteps, transform, samples, ...others } =
    fitOptions;
  const smallest = smallestStep(tolerance, relativeTolerance);
  const most = positive("maxSteps", maxSteps ?? DEFAULTS.maxSteps);
  const options = { ...others, samples: samples ?? DEFAULTS.samples };
  const evaluate = async (transform: Rigid) => {
    const { deviations, diagonal } = await engine.field(a, b, { ...options, transform });
    return { diagonal, at: leastSquares(deviations) };
  };
  let position = complete(transform ?? {});
  const first = await evaluate(position);
  const { diagonal } = first;
  let { at } = first;
  const before = at.meanSquare;
  let damping = FIRST_DAMPING;
  for (let step = 1; step <= most; step++) {
    const { shift, vector, gain } = dampedStep(at, damping);
    const length = Math.hypot(...shift) + at.extent * Math.hypot(...vector);
    if (length <= smallest(diagonal) || gain <= MIN_GAIN * at.meanSquare) {
      return result(position, at, before, step - 1, true);
    }
    const moved = followed(position, vector, at.center, shift);
    const next = await evaluate(moved);
    if (next.at.meanSquare < at.meanSquare) {
      [position, at] = [moved, next.at];
      damping = Math.max(damping / DAMPING_FACTOR, MIN_DAMPING);
    } else damping *= DAMPING_FACTOR;
    onProgress?.(step, Math.sqrt(at.meanSquare));
  }
  return result(position, at, before, most, false);
}

const result = (
  transform: Rigid,
  { meanSquare }: LeastSquares,
  before: number,
  steps: number,
  converged: boolean,
): BestFit => ({
  ...{ transform, rms: Math.sqrt(meanSquare), rmsBefore: Math.sqrt(before) },
  ...{ steps, converged },
});

/** The length below which a step ends the fit, for models of a diagonal. */
function smallestStep(
  tolerance: number | undefined,
  relativeTolerance = tolerance === undefined ? DEFAULTS.relativeTolerance : undefined,
): (diagonal: number) => number {
  if (tolerance !== undefined && relativeTolerance !== undefined) {
    throw new HausdorffError(
      "OPTION_INVALID",
      "found both tolerance and relativeTolerance, expected one of them",
    );
  }
  if (tolerance !== undefined) {
    const length = positive("tolerance", tolerance);
    return () => length;
  }
  const fraction = positive("relativeTolerance", relativeTolerance ?? DEFAULTS.relativeTolerance);
  return (diagonal) => fraction * diagonal;
}

function positive(name: string, value: number): number {
  if (value > 0 && Number.isFinite(value)) return value;
  throw new HausdorffError(
    "OPTION_OUT_OF_RANGE",
    `${name} is ${value}, expected a positive finite number`,
  );
}
