import type { Interval } from "../../model/facts.js";
import type { Transform } from "../options.js";
import type { BestFit, Rigid } from "../points/fit.js";
import type { OnProgress } from "../progress.js";

/** A number of a score that may be required. */
export type ScoreNumber =
  | "valid"
  | "volumeRatio"
  | "areaRatio"
  | "centroidDistance"
  | "extentDifference"
  | "precision"
  | "recall"
  | "f1"
  | "normalPrecision"
  | "normalRecall"
  | "normalF1"
  | "edgePrecision"
  | "edgeRecall"
  | "edgeF1"
  | "chamfer"
  | "chamferSquared"
  | "hausdorff"
  | "iou";

/** Options of `Hausdorff.score`. */
export interface ScoreOptions {
  /** Distances at which precision, recall and F1 are stated, in model units. */
  thresholds?: number[];
  /** The same as fractions of the diagonal of the truth's box; 0.01 if neither names any. */
  relativeThresholds?: number[];
  /** The largest angle between tangent planes that count as alike, in degrees from 0 to 90; 30 if not given. */
  normalAngle?: number;
  /** The angle by which a surface turns at a feature edge at least, in degrees from 0 to 180; 30 if not given. */
  featureAngle?: number;
  /**
   * How the candidate is laid on the truth: as it is (default); scaled and shifted so that the middles
   * and the longest sides of both boxes agree; or by the best fit from any pose.
   */
  align?: "none" | "box" | "best-fit";
  /** The permitted width of the intervals of lengths, in model units. */
  tolerance?: number;
  /** The same as a fraction of the truth's diagonal; 1e-3 if neither is given. Both at once are an error. */
  relativeTolerance?: number;
  /** The permitted width of the intervals of precision and recall, of areas, with normals and of edges; 1e-3 if not given. */
  partTolerance?: number;
  /** Compares faces one by one: those within this distance of the other model are unchanged. */
  limit?: number;
  /** Numbers that have to be at least so large. Work ends where one is certainly missed. */
  atLeast?: Partial<Record<ScoreNumber, number>>;
  /** Numbers that have to be at most so large. */
  atMost?: Partial<Record<ScoreNumber, number>>;
  /** Parts of a model after which the intervals reached are the result; 300,000 if not given. */
  maxCells?: number;
  /** Seconds after which the intervals reached are the result. */
  maxSeconds?: number;
  /** Whether the truth is scaled to the candidate's unit where both state different ones; else that is an error. */
  scaleUnits?: boolean;
  /** Moves the candidate before it is aligned. */
  transform?: Transform;
  /** Cancels the work: the promise rejects with code `CANCELLED`. */
  signal?: AbortSignal;
  /** Called with the part of the work that is done. An error that it throws cancels the work. */
  onProgress?: OnProgress;
}

/** How the candidate was laid on the truth: its coordinates times the scale, then a motion. */
export interface Placement extends Rigid {
  align: "none" | "box" | "best-fit";
  scale: number;
  /** The best fit with the other poses that fit as well, if that is the rule: estimates. */
  fit?: BestFit;
}

/** A model as a score sees it. */
export interface ScoredModel {
  /** 1 if it is closed, oriented, without copies of faces, and all its bodies are embedded; 0 if it certainly is not. */
  valid: Interval;
  /** Whether there is a body, and every edge of every face has a partner. */
  closed: boolean;
  /** Whether the normals of all faces point out of their bodies; null where that is not decided. */
  oriented: boolean | null;
  /** The number of faces with the surface and the loops of one before, or of such triangles. */
  duplicates: number;
  /** Whether all bodies are certainly embedded up to their gaps, or one certainly is not; null where neither is known. */
  embedded: boolean | null;
  /** The number of bodies that certainly meet themselves. */
  selfOverlaps: number;
  /** The numbers of bodies that close, of those that do not, and of voids. */
  bodies: number;
  sheets: number;
  voids: number;
  /** The volume, if all bodies close. */
  volume?: Interval;
  /** The area of all faces; none of points. */
  area?: Interval;
  centroid?: [Interval, Interval, Interval];
  /** The lengths along x, y and z. */
  extents: [Interval, Interval, Interval];
}

/** Two numbers compared. */
export interface Difference {
  /** That of the candidate less that of the truth. */
  difference: Interval;
  /** The smaller over the larger. */
  ratio: Interval;
}

/** The distances of one model's points from the other model. */
export interface SurfaceScore {
  mean: Interval;
  meanSquare: Interval;
}

/** The parts of both areas within a threshold of the other model, and their harmonic mean. */
export interface AtThreshold {
  threshold: number;
  precision: Interval;
  recall: Interval;
  f1: Interval;
  /** The largest angle between tangent planes that count as alike, in degrees. */
  normalAngle?: number;
  /**
   * The parts of both areas with a like counterpart, a point of the other model within the threshold whose tangent
   * plane forms at most that angle, and their harmonic mean; none of clouds.
   */
  normalPrecision?: Interval;
  normalRecall?: Interval;
  normalF1?: Interval;
  /**
   * The parts of the lengths of both models' feature edges within the threshold of the other one's, and their harmonic
   * mean; none of clouds, and of meshes of more than 250,000 triangles.
   */
  edgePrecision?: Interval;
  edgeRecall?: Interval;
  edgeF1?: Interval;
}

/** The lengths of all feature edges, at which a surface turns by more than the angle, in degrees, or ends. */
export interface EdgeLengths {
  featureAngle: number;
  candidate: Interval;
  truth: Interval;
}

/** The Hausdorff distance to the truth, back, and the larger of both. */
export interface HausdorffScore {
  forward: Interval;
  reverse: Interval;
  distance: Interval;
}

/** The parts of the faces, by number, that are unchanged, and the numbers of those certainly changed and of all. */
export interface FaceCounts {
  limit: number;
  candidate: Interval;
  truth: Interval;
  changedOfCandidate: [changed: number, all: number];
  changedOfTruth: [changed: number, all: number];
}

/** A number that has to be large or small enough, with what was found. */
export interface Requirement {
  number: ScoreNumber;
  atLeast?: number;
  atMost?: number;
  found: Interval;
  /** Whether it is met; null where the interval does not decide that. */
  met: boolean | null;
}

/**
 * The score of a candidate against the truth. Guarantee: every number is in its interval. What is not
 * there was not measured: a model that does not close has no volume, and work that ended early leaves
 * the rest out.
 */
export interface Score {
  placement: Placement;
  /** The diagonal of the truth's box. */
  diagonal: number;
  /** Metres per unit of every length, if a model states its unit. */
  unit?: number;
  /**
   * What may be wrong with the units: that one model states none, or that the extents agree after a factor that two
   * units have. Nothing was scaled for it; A is the candidate and B the truth.
   */
  hint?: string;
  candidate: ScoredModel;
  truth: ScoredModel;
  volume?: Difference;
  area?: Difference;
  centroidDistance?: Interval;
  /** The differences of the extents along x, y and z, without their signs. */
  extentDifferences: [Interval, Interval, Interval];
  /** From the candidate to the truth. */
  forward?: SurfaceScore;
  /** From the truth to the candidate. */
  reverse?: SurfaceScore;
  /** The sum of both mean distances. */
  chamfer?: Interval;
  /** The sum of both mean squared distances. */
  chamferSquared?: Interval;
  thresholds: AtThreshold[];
  edgeLength?: EdgeLengths;
  hausdorff?: HausdorffScore;
  /** The volume of the intersection over that of the union, if both models close. It has a budget of its own. */
  iou?: Interval;
  faces?: FaceCounts;
  requirements: Requirement[];
  /** Whether all requirements are met; null where that is not decided or there is none. */
  met: boolean | null;
  /** Whether a missed requirement ended the work before all numbers were there. */
  endedEarly: boolean;
  /** Whether all intervals of lengths and of parts of areas are as narrow as requested. */
  converged: boolean;
  /** The permitted width of lengths, in model units. */
  tolerance: number;
  seconds: { prepare: number; compile: number; solve: number };
}
