// The methods that are compared, by the command line's names.
import type { PlainOptions } from "../protocol.ts";

export interface Entry {
  name: string;
  options: PlainOptions;
  /** Whether it is run unless the user says otherwise. */
  usual: boolean;
}

/** The name of the method that the others are compared with. */
export const CERTIFIED = "certified";

/** How many times the samples the finer boxes are. */
const FINER = 4;

/** What the user chooses for all methods. */
export interface Settings {
  /** Samples or boxes along each direction of a surface. */
  samples: number;
  /** MiB for the pairs of boxes of method `hierarchy`. */
  memoryBudget: number;
}

/** Every method, the certified one first. */
export function methods({ samples, memoryBudget }: Settings): Entry[] {
  const entry = (name: string, options: PlainOptions, usual = true): Entry => ({
    name,
    options,
    usual,
  });
  const iteration: PlainOptions = { method: "iteration", samples };
  const published: PlainOptions = { ...iteration, projection: "tangent-plane", culling: "none" };
  const boxes: PlainOptions = { method: "hierarchy", memoryBudget };
  return [
    // In float64 on the CPU, as its times do not depend then on what takes a GPU's place.
    entry(CERTIFIED, { method: "certified", backend: "cpu" }),
    entry("iteration", iteration),
    entry("2012 paper: none", { ...published, flatness: "none" }),
    entry("2012 paper: loose", { ...published, flatness: "loose" }),
    entry("2012 paper: tight", { ...published, flatness: "tight" }),
    entry("hierarchy", { ...boxes, grid: samples }),
    entry("hierarchy: finer", { ...boxes, grid: FINER * samples }, false),
    // The result is the same however flat; the time is not.
    entry("iteration: none", { ...iteration, flatness: "none" }, false),
    entry("iteration: tight", { ...iteration, flatness: "tight" }, false),
  ];
}
