import type { Interval } from "../model/facts.js";
import type { Transform } from "./options.js";
import type { OnProgress } from "./progress.js";
import type { SurfacePoint } from "./result.js";

/** Options of `Hausdorff.diff`. */
export interface DiffOptions {
  /** The distance, in model units, up to which a face counts as unchanged; default 1e-3. */
  limit?: number;
  /** Cells after which a face is given up as undecided; default 1,000,000. */
  maxCells?: number;
  /** Seconds after which the faces that are not decided yet are given up as undecided. */
  maxSeconds?: number;
  /** Whether B is scaled to A's unit where both state different ones; else that is an error. */
  scaleUnits?: boolean;
  /** Moves A before it is compared. */
  transform?: Transform;
  /** Cancels the work: the promise rejects with code `CANCELLED`. */
  signal?: AbortSignal;
  /** Called with the fraction of the work done, rising to 1. An error that it throws cancels the work. */
  onProgress?: OnProgress;
}

/**
 * Whether a face, or a model, differs by more than the limit: `unchanged` where
 * `upper` is at most the limit, `changed` where `lower` exceeds it, else `undecided`.
 */
export type FaceState = "unchanged" | "undecided" | "changed";

/**
 * One face. Guarantee: the directed distance from the face to the other model is
 * in `[lower, upper]`.
 */
export interface FaceDifference {
  /** Index of the face in its model. */
  face: number;
  state: FaceState;
  lower: number;
  upper: number;
  /** The face's own gap and the largest of the other model. */
  gap: number;
  /** The state that holds for the sources, which differ from the models by up to their gaps. */
  withGaps: FaceState;
  /** The farthest point found on the face and its nearest point on the other model; `a` after the transform. */
  witness: { a: SurfacePoint; b: SurfacePoint };
  /** Number of cells bounded. */
  cells: number;
  /** The face of the other model that a changed round face became. */
  counterpart?: FaceCounterpart;
}

/**
 * The face of the other model that a round face is taken to have become. Both changed and lie on a sphere, a cylinder
 * or a torus, and of all such faces the box of each is the nearest to that of the other. Which two faces belong
 * together is a guess; what is said of the two is certain as in `FaceForm`.
 */
export interface FaceCounterpart {
  /** Index of the face in the other model. */
  face: number;
  /** `resized`: radii certainly differ by more than the limit; `moved`: the centre or the axis is farther than it away. */
  change: "resized" | "moved" | "resizedAndMoved";
  /** The radius of this face; of a torus that of the tube. */
  radius: Interval;
  /** The radius of the other face, in the same unit. */
  otherRadius: Interval;
  /** The way from A's centre, after the transform, to that of B; of cylinders across the axis, from A's to B's. */
  shift: [number, number, number];
}

/**
 * What became of a part: `same`, `renamed`, `moved` and `mirrored` are proven to the limit, of `changed` and
 * `movedAndChanged` faces certainly differ by more.
 */
export type PartState =
  | "same"
  | "renamed"
  | "moved"
  | "mirrored"
  | "changed"
  | "movedAndChanged"
  | "added"
  | "removed"
  | "undecided";

/** A part of A, of B or of both; the Hausdorff distance after its motion is in `[lower, upper]`. */
export interface PartDifference {
  nameOfA: string | null;
  nameOfB: string | null;
  state: PartState;
  /**
   * A turn by `angle` degrees about `axis` through the origin, then a move by `translation`; `shift` is
   * the displacement of the centre of the part's box. Of mirrored parts it follows the change of the sign of every x.
   */
  motion: {
    translation: [number, number, number];
    axis: [number, number, number];
    angle: number;
    shift: [number, number, number];
  } | null;
  lower: number | null;
  upper: number | null;
  /** The indices of the faces that certainly changed. */
  faces: { ofA: number[]; ofB: number[] };
}

/** The difference of two models, face by face. */
export interface DiffResult {
  /** `changed` if a face is, else `undecided` if one is. */
  state: FaceState;
  /** The limit that the states refer to, in model units. */
  limit: number;
  /** The larger diagonal of the two models' boxes. */
  diagonal: number;
  /** Metres per unit of every length, if a model states its unit. */
  unit?: number;
  /**
   * What may be wrong with the units: that one model states none, or that the extents agree after a factor that two
   * units have. Nothing was scaled for it.
   */
  hint?: string;
  /** The sum of both models' gaps, as in a distance. */
  gap: number;
  /** Whether the gaps are upper bounds by what both readers have proven. */
  gapProven: boolean;
  /** The state of both models' sources together. */
  withGaps: FaceState;
  /** Every face of A, in order, compared with B. */
  facesOfA: FaceDifference[];
  /** Every face of B, in order, compared with A. */
  facesOfB: FaceDifference[];
  /** What became of each body; empty for clouds of points, and if `partsUnknown` is present. */
  parts: PartDifference[];
  /** The reason why the parts were not compared: the time was spent before, or a model has more than 2,000 bodies. */
  partsUnknown?: "budget" | "too-many";
  /** Where the time went. */
  seconds: { prepare: number; compile: number; solve: number };
}
