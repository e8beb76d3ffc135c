import type { Interval } from "../model/facts.js";
import type { Transform } from "./options.js";
import type { OnProgress } from "./progress.js";
import type { AuditReport } from "./result.js";

/** Options of `Hausdorff.statistics`. */
export interface StatisticsOptions {
  /** The permitted width of the intervals of the mean, the root mean square and the percentiles, in model units. */
  tolerance?: number;
  /** The same as a fraction of the larger diagonal; 1e-4 if neither is given. Both at once are an error. */
  relativeTolerance?: number;
  /** The percentiles, as parts of the whole above 0 and below 1; 0.5, 0.95 and 0.99 if not given. */
  percentiles?: number[];
  /** A distance: the part of A that is farther from B is returned as `beyond`. */
  limit?: number;
  /** The permitted width of the interval of that part; 1e-3 if not given. */
  partTolerance?: number;
  /** Parts of A after which the intervals reached are the result; 300,000 if not given. */
  maxCells?: number;
  /** Seconds after which the intervals reached are the result. */
  maxSeconds?: number;
  /** The parts whose bounds are compared with certified distances of their points at the end: a share if not given. */
  audit?: "share" | "all";
  /** Whether B is scaled to A's unit where both state different ones; else that is an error. */
  scaleUnits?: boolean;
  /** Moves A before it is measured. */
  transform?: Transform;
  /** Cancels the work: the promise rejects with code `CANCELLED`. */
  signal?: AbortSignal;
  /** Called with the part of the budget that is spent. An error that it throws cancels the work. */
  onProgress?: OnProgress;
}

/** Statistics of the distances from the points of A to B. Guarantee: every number is in its interval. */
export interface CertifiedStatistics {
  /** What they are over: the points of a cloud, each once, or the area. */
  over: "count" | "area";
  /** The number of points, or the area in squares of the model unit. */
  total: Interval;
  mean: Interval;
  /** The root of the mean square. */
  rms: Interval;
  /** For each percentile the least distance that this part of A is within. */
  percentiles: { part: number; distance: Interval }[];
  /** With a limit, the part of A that is farther than it, between 0 and 1. */
  beyond?: { limit: number; part: Interval };
  /**
   * Whether all intervals are as narrow as requested. A percentile at which distances jump stays as
   * wide as the jump.
   */
  converged: boolean;
  /** The permitted width of lengths, in model units. */
  tolerance: number;
  /** The larger diagonal of the two models' boxes. */
  diagonal: number;
  /** Metres per unit of every length, if a model states its unit. */
  unit?: number;
  /**
   * What may be wrong with the units: that one model states none, or that the extents agree after a factor that two
   * units have. Nothing was scaled for it.
   */
  hint?: string;
  /** Number of parts of A bounded. */
  cells: number;
  /** The parts whose bounds were compared with certified distances of their points. */
  audit: AuditReport;
  /** A bound that the audit refuted: a fault of the library, without whose lemma the intervals were computed. */
  notice?: string;
  /** Where the time went. */
  seconds: { prepare: number; compile: number; solve: number };
}
