// The methods compared, with the names that the command line's experiments use.

import type { IterationOptions } from "nurbs-hausdorff";
import { texts } from "../../texts/index.ts";
import type { Plain, PlainOptions } from "../../worker/protocol.ts";

export interface Entry {
  name: string;
  options: PlainOptions;
  /** Whether the method is chosen initially. */
  byDefault: boolean;
}

/** The reference that the other methods are compared with. */
export const CERTIFIED = "certified";

/** The ratio of the finer grid of `hierarchy` to the coarser one. */
const FINER = 4;

/** The settings common to all methods. */
export interface Settings {
  /** Samples, or cells, along each direction of a surface. */
  samples: number;
  /** Memory for the box pairs of `hierarchy`, in MiB. */
  memoryBudget: number;
}

type Iteration = Plain<IterationOptions>;

const cut = (options: Iteration, flatness: NonNullable<Iteration["flatness"]>): Iteration => ({
  ...options,
  flatness,
});

/** Returns all methods, the certified one first. */
export function methods({ samples, memoryBudget }: Settings): Entry[] {
  const entry = (name: string, options: PlainOptions, byDefault = true): Entry => ({
    name,
    options,
    byDefault,
  });
  const iteration: Iteration = { method: "iteration", samples };
  const published: Iteration = {
    ...iteration,
    projection: "tangent-plane",
    culling: "none",
  };
  const boxes = { method: "hierarchy", memoryBudget } as const;
  return [
    // On the CPU, so that its times do not depend on the GPU or its emulation.
    entry(CERTIFIED, { method: "certified", backend: "cpu" }),
    entry("iteration", iteration),
    entry(texts.experiments.paper2012None, cut(published, "none")),
    entry(texts.experiments.paper2012Loose, cut(published, "loose")),
    entry(texts.experiments.paper2012Tight, cut(published, "tight")),
    entry("hierarchy", { ...boxes, grid: samples }),
    entry(texts.experiments.hierarchyFiner, { ...boxes, grid: FINER * samples }, false),
    // Flatness changes the time of `iteration` but not its result.
    entry(texts.experiments.iterationNone, cut(iteration, "none"), false),
    entry(texts.experiments.iterationTight, cut(iteration, "tight"), false),
  ];
}
