import type { Vector3 } from "./options.js";

/** A point of a model. */
export interface SurfacePoint {
  /** Index of the surface. */
  surface: number;
  /** Its parameters there. */
  u: number;
  v: number;
  point: Vector3;
}

/** All samples of one surface, v fastest. */
export interface Field {
  /** Index of the surface in the sampled model. */
  surface: number;
  /** Numbers of samples along u and v. */
  counts: [number, number];
  /** x, y, z of every sample, after the transform. */
  points: Float64Array<ArrayBuffer>;
  /** x, y, z of every sample's nearest point on the other model. */
  feet: Float64Array<ArrayBuffer>;
  /** Their distances. */
  distances: Float64Array<ArrayBuffer>;
  /** How the projections ended: 0 converged, 1 iteration limit, 2 on an edge. */
  statuses: Uint8Array<ArrayBuffer>;
}

/**
 * A distance. Guaranteed whatever converged: `lower <= true distance <= upper`.
 */
export interface DistanceResult {
  method: "iteration";
  backend: "gpu" | "cpu";
  /** The GPU's name; browsers keep it to themselves. */
  adapter: string | null;
  /** The larger diagonal of the two models' boxes. */
  diagonal: number;
  /** The largest distance of a sample. */
  computed: number;
  lower: number;
  upper: number;
  /** Whether `computed` is the largest distance of all samples to rounding. */
  converged: boolean;
  /**
   * The paper's bounds K_A and K_B (the latter null where it does not apply),
   * and what a point between the samples can add for certain.
   */
  bounds: { k_a: number; k_a_rigorous: number; k_b: number | null };
  /** Where the distance is attained; `a` after the transform. */
  witness: { a: SurfacePoint; b: SurfacePoint };
  /** Number of samples. */
  samples: number;
  /** Numbers of samples by how their projection ended. */
  statuses: { converged: number; iteration_limit: number; on_edge: number };
  /** Numbers of Bézier patches after cutting. */
  patches: { a: number; b: number };
  seconds: { prepare: number; compile: number; solve: number };
  /** Why the CPU was used although the GPU was not ruled out. */
  notice?: string;
  /** With `symmetric`: from A to B. The result itself is the larger's. */
  forward?: DistanceResult;
  /** With `symmetric`: from B to A; its witness is still named by a and b. */
  reverse?: DistanceResult;
  /** With `field`: one entry a surface of the sampled model; with `symmetric`, in both directions' results. */
  field?: Field[];
}
