// The methods compared, with the names that the command line's experiments use.
import type { PlainOptions } from "../../worker/protocol.ts";

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

/** Returns all methods, the certified one first. */
export function methods({ samples, memoryBudget }: Settings): Entry[] {
  const entry = (name: string, options: PlainOptions, byDefault = true): Entry => ({
    name,
    options,
    byDefault,
  });
  const iteration: PlainOptions = { method: "iteration", samples };
  const published: PlainOptions = { ...iteration, projection: "tangent-plane", culling: "none" };
  const boxes: PlainOptions = { method: "hierarchy", memoryBudget };
  return [
    // On the CPU, so that its times do not depend on the GPU or its emulation.
    entry(CERTIFIED, { method: "certified", backend: "cpu" }),
    entry("iteration", iteration),
    entry("2012 paper: none", { ...published, flatness: "none" }),
    entry("2012 paper: loose", { ...published, flatness: "loose" }),
    entry("2012 paper: tight", { ...published, flatness: "tight" }),
    entry("hierarchy", { ...boxes, grid: samples }),
    entry("hierarchy: finer", { ...boxes, grid: FINER * samples }, false),
    // Flatness changes the time of `iteration` but not its result.
    entry("iteration: none", { ...iteration, flatness: "none" }, false),
    entry("iteration: tight", { ...iteration, flatness: "tight" }, false),
  ];
}
