import type { Interval } from "../../model/facts.js";
import type { Transform } from "../options.js";
import type { OnProgress } from "../progress.js";

/** Options of `Hausdorff.overlap`. */
export interface OverlapOptions {
  /** The permitted width of the common volume, as a fraction of the union's; 1e-3 if not given. */
  tolerance?: number;
  /** Seconds after which the intervals reached are the result. */
  maxSeconds?: number;
  /** Pieces of faces after which the intervals reached are the result; 400,000 if not given. */
  maxCells?: number;
  /** Whether B is scaled to A's unit where both state different ones; else that is an error. */
  scaleUnits?: boolean;
  /** Moves A before it is measured. */
  transform?: Transform;
  /** Cancels the work: the promise rejects with code `CANCELLED`. */
  signal?: AbortSignal;
  /** Called with the part that is done. An error that it throws cancels the work. */
  onProgress?: OnProgress;
}

/**
 * Why there are no volumes. `a-open`, `b-open`, `both-open`: a model is not closed. `too-large`: a mesh has more
 * than 250,000 triangles, which are not joined. `a-volume`, `b-volume`: a body has none, as its facts say.
 * `a-bodies`, `b-bodies`: bodies of one model meet or overlap. `a-crossed`, `b-crossed`: the boundary of a body
 * certainly meets itself. `refuted`: what was found contradicts the volumes of both models.
 */
export type VolumesUnknown =
  | "a-open"
  | "b-open"
  | "both-open"
  | "too-large"
  | "a-volume"
  | "b-volume"
  | "a-bodies"
  | "b-bodies"
  | "a-crossed"
  | "b-crossed"
  | "refuted";

/** The volumes that two solids have in common and apart. Guarantee: every number is in its interval. */
export interface OverlapResult {
  /** Absent where `volumesUnknown` says why. */
  volumes?: { intersection: Interval; union: Interval; onlyA: Interval; onlyB: Interval };
  /** The volume of the intersection over that of the union. */
  ratio?: Interval;
  volumesUnknown?: VolumesUnknown;
  /** Whether the interval of the intersection is as narrow as requested. */
  converged: boolean;
  /** Why the search ended. */
  stop: "converged" | "cells" | "time" | "precision" | "cancelled";
  /** The permitted width, as a fraction of the union's volume. */
  tolerance: number;
  /** About the volume between the faces and their sources: an estimate, and no part of the intervals. */
  volumeOfGap?: number;
  /** Metres per unit of length, if a model states its unit. */
  unit?: number;
  /**
   * What may be wrong with the units: that one model states none, or that the extents agree after a factor that two
   * units have. Nothing was scaled for it.
   */
  hint?: string;
  /** The sum of both models' gaps, as in a distance. */
  gap: number;
  /** Whether the gap is an upper bound by what both readers have proven. */
  gapProven: boolean;
  /** Number of pieces of faces that were compared with the other boundary. */
  cells: number;
  /** Where the time went. */
  seconds: { prepare: number; compile: number; solve: number };
}
