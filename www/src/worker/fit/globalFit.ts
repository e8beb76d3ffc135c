// The best fit from several starts: the one that ends with the least mean square, finished.
import type { BestFit, Hausdorff, NurbsModel, Transform } from "nurbs-hausdorff/worker";
import type { PlainFitOptions } from "../protocol.ts";
import { principalOf } from "./principal.ts";
import { startsOf } from "./starts.ts";

/** Samples and steps with which a start is tried. */
const TRIAL = { samples: 5, maxSteps: 10 };
/** A fit this near, in diagonals, needs no other start. */
const NEAR = 1e-5;

export interface FitCall {
  options: PlainFitOptions;
  signal: AbortSignal;
  onProgress: (step: number, rms: number) => void;
}

/** Fits A to B from where A is and from principal axes. */
export async function globalFit(
  engine: Hausdorff,
  { a, b }: { a: NurbsModel; b: NurbsModel },
  { options, signal, onProgress }: FitCall,
): Promise<BestFit> {
  const finish = (transform: Transform | undefined) =>
    engine.bestFit(a, b, { ...options, ...(transform && { transform }), signal, onProgress });
  const { min, max } = b.boundingBox;
  const size = Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
  const local = await finish(options.transform);
  if (local.rms <= NEAR * size) return local;
  let best: { rms: number; transform: Transform | undefined } = local;
  const [axesOfA, axesOfB] = [await axesOf(a), await axesOf(b)];
  for (const transform of startsOf(axesOfA, axesOfB, scaleOf(a, b, options))) {
    const trial = await engine.bestFit(a, b, { ...options, ...TRIAL, transform, signal });
    if (trial.rms < best.rms) best = trial;
  }
  if (best === local) return local;
  const fit = await finish(best.transform);
  return fit.rms < local.rms ? { ...fit, rmsBefore: local.rmsBefore } : local;
}

async function axesOf(model: NurbsModel) {
  const { positions, indices, origin } = await model.tessellate();
  const points = Float64Array.from(positions, (value, at) => value + (origin[at % 3] ?? 0));
  return principalOf(points, indices);
}

/** A's units in one of B's, as the options measure. */
function scaleOf(a: NurbsModel, b: NurbsModel, { scaleUnits }: PlainFitOptions): number {
  return scaleUnits === true && a.unit !== null && b.unit !== null ? b.unit / a.unit : 1;
}
