import type { Vector3 } from "./options.js";

/** A point of a model. */
export interface SurfacePoint {
  /** Index of the face. */
  face: number;
  /** The face's name in its source, if it has one. */
  faceName?: string;
  /** Its parameters there. */
  u: number;
  v: number;
  /** On a mesh: the index of the triangle; u and v are the weights of its second and third corner. */
  triangle?: number;
  /** On a mesh: the weights of the triangle's corners. */
  barycentric?: Vector3;
  /** Of a cloud: the index of the point. */
  index?: number;
  point: Vector3;
}

/**
 * What the signs of deviations stand for. `solid`: negative inside the other model, positive
 * outside; where neither is certain, on its boundary and in its gaps, 0, and farther off NaN.
 * `faces`, where it is no solid: negative behind the normal of the face with the foot; where the
 * foot is on an edge, a corner or the rim, behind the angle-weighted normal of the faces there; NaN
 * where no normal exists, where those of the faces cancel, and in the tangent plane beside the rim.
 */
export type Signs = "solid" | "faces";

/**
 * All samples of one face, or of a piece of a trimmed one, v fastest; of a group of a mesh its
 * vertices, in the order in which its triangles use them, and points within large triangles; of a
 * cloud its points in their order.
 */
export interface FaceDeviations {
  /** Index of the face in the sampled model. */
  face: number;
  /** Numbers of samples along u and v; of a mesh or a cloud, all of them and 1. */
  counts: [number, number];
  /** x, y, z of every sample, after the transform. */
  points: Float64Array<ArrayBuffer>;
  /** x, y, z of every sample's nearest point on the other model. */
  feet: Float64Array<ArrayBuffer>;
  /** Their distances. */
  distances: Float64Array<ArrayBuffer>;
  /** The distances with signs. */
  signed: Float64Array<ArrayBuffer>;
  /** What the signs stand for. */
  signs: Signs;
  /** The area that each sample stands for; 1 for a point of a cloud. */
  areas: Float64Array<ArrayBuffer>;
  /** Of a mesh: the corners of triangles between the samples, three indices each, which cover it. */
  triangles?: Uint32Array<ArrayBuffer>;
  /** The ends of the projections: 0 converged, 1 iteration limit, 2 on an edge. */
  statuses: Uint8Array<ArrayBuffer>;
}

/** Statistics of the deviation over the area of the sampled model: estimates. */
export interface Statistics {
  estimate: true;
  area: number;
  mean: number;
  rms: number;
  signedMean: number;
  median: number;
  percentile95: number;
  percentile99: number;
}

/**
 * The interval that holds for every pair of sources within the gaps of both models. Where the
 * gap is not proven it is an estimate.
 */
export interface WithGaps {
  lower: number;
  upper: number;
  /**
   * With a limit: whether the distance of the sources is at most the limit; absent where the
   * gaps could change that or the search ended before it was known.
   */
  within?: boolean;
}

/**
 * The results of all methods. Guarantee: `lower <= true distance <= upper`,
 * whether the method converged or not.
 */
interface Common {
  backend: "gpu" | "cpu";
  /** The GPU's name; browsers do not report it. */
  adapter: string | null;
  /** The larger diagonal of the two models' boxes. */
  diagonal: number;
  /** Metres per unit of every length, if a model states its unit. */
  unit?: number;
  /**
   * What may be wrong with the units: that one model states none, or that the extents agree after a factor that two
   * units have. Nothing was scaled for it.
   */
  hint?: string;
  /**
   * The sum of both models' gaps: how far their sources may be from what was measured. It
   * stands beside the interval and is not part of it.
   */
  gap: number;
  /** Whether the gap is an upper bound by what both readers have proven. */
  gapProven: boolean;
  /** The interval, and the verdict, that hold for the sources of the models. */
  withGaps: WithGaps;
  /** The distance of the witness, which the method takes for the farthest point. */
  computed: number;
  lower: number;
  upper: number;
  /** Where the distance is attained; `a` after the transform. */
  witness: { a: SurfacePoint; b: SurfacePoint };
  /** Numbers of Bézier patches after cutting. */
  patches: { a: number; b: number };
  seconds: { prepare: number; compile: number; solve: number };
  /**
   * The reason why the CPU was used although the options allow the GPU, and that
   * a relative tolerance is 0 where both models are single points.
   */
  notice?: string;
  /** With `deviations`, where there is an area. */
  statistics?: Statistics;
  /** With `deviations`: one entry a face of the sampled model, or a piece of a trimmed one; with `symmetric`, in both directions' results. */
  deviations?: FaceDeviations[];
}

/** The work of an audit, and its outcome. */
export interface AuditReport {
  /** The number of cells whose bounds were looked at. */
  cells: number;
  /** The number of their points. */
  points: number;
  /**
   * The sections of the lemmas that were refuted, without which the interval was computed, and valid; empty
   * unless the library has a fault, which `notice` then describes.
   */
  struck: string[];
}

/** A distance by method `certified`. */
export interface CertifiedResult extends Common {
  method: "certified";
  /** Whether the interval is as narrow as requested, or the limit is decided. */
  converged: boolean;
  /** The requested width of the interval, in model units. */
  tolerance: number;
  /**
   * The least tolerance, in model units, that the rounding of these coordinates
   * allows: a search for a smaller one stops with `precision` at about this width.
   */
  minTolerance: number;
  /** Number of cells bounded. */
  cells: number;
  /** Number of those bounded in float64 on the CPU. */
  cpuCells: number;
  /** Halvings from the whole model to the smallest cell. */
  levels: number;
  /** Why the search ended. */
  stop: "converged" | "cells" | "time" | "precision";
  /** With `limit`: whether the distance is at most the limit, absent if that was not decided. */
  within?: boolean;
  /** The upper bounds that were audited while the search ran. */
  audit: AuditReport;
  /** With `symmetric`: from A to B. The result itself is the larger's. */
  forward?: CertifiedResult;
  /** With `symmetric`: from B to A; its witness is still named by a and b. */
  reverse?: CertifiedResult;
}

/** A distance by method `iteration`. */
export interface IterationResult extends Common {
  method: "iteration";
  /** Whether `computed` is the largest distance of all samples up to rounding. */
  converged: boolean;
  /**
   * The paper's bounds K_A and K_B (the latter null where it does not apply),
   * and a rigorous bound on what a point between the samples can add.
   */
  bounds: { kA: number; kARigorous: number; kB: number | null };
  /** Number of samples. */
  samples: number;
  /** Numbers of samples by the end of their projection. */
  statuses: { converged: number; iterationLimit: number; onEdge: number };
  /** With `symmetric`: from A to B. The result itself is the larger's. */
  forward?: IterationResult;
  /** With `symmetric`: from B to A; its witness is still named by a and b. */
  reverse?: IterationResult;
}

/** A distance by method `hierarchy`. */
export interface HierarchyResult extends Common {
  method: "hierarchy";
  /** Whether the interval, whose width follows from the grid, is as narrow as `tolerance`. */
  converged: boolean;
  /** Cells along each direction of every surface. */
  grid: number;
  /** Levels of boxes, from the whole models to the cells. */
  levels: number;
  /** On every level, the pairs of boxes left after culling. */
  pairs: number[];
  /** With `symmetric`: from A to B. The result itself is the larger's, its pairs those of both. */
  forward?: HierarchyResult;
  /** With `symmetric`: from B to A; its witness is still named by a and b. */
  reverse?: HierarchyResult;
}

/** The result of each method. */
export interface Results {
  certified: CertifiedResult;
  iteration: IterationResult;
  hierarchy: HierarchyResult;
}

/** A distance, by the method that it names. */
export type DistanceResult = Results[keyof Results];
