import type { InterchangeModel, InterchangeSurface } from "../surface.js";

/** A trimming curve of interchange version 2: u, v and the weight of every control point. */
export interface InterchangeCurve {
  degree: number;
  knots: readonly number[];
  ctrl: readonly (readonly [u: number, v: number, w: number])[];
  /** Bound on the distance to the edge that the curve stands for, in model units. */
  gap?: number;
  /** The edge's number; neighbouring faces share it. */
  edge?: number;
}

/** A trimmed face of interchange version 2. */
export interface InterchangeFace extends InterchangeSurface {
  /** Loops of curves head to tail, material on the left; absent: the whole surface. */
  trim?: readonly (readonly InterchangeCurve[])[];
  reversed?: boolean;
  part?: string;
}

/** A placement of some faces. */
export interface InterchangeInstance {
  surfaces: readonly number[];
  /** A row-major 3x4 matrix. */
  transform: readonly number[];
  name?: string;
}

/** A model of interchange version 2. */
export interface InterchangeFaces extends InterchangeModel {
  /** Metres per model unit. */
  unit?: number;
  surfaces: readonly InterchangeFace[];
  instances?: readonly InterchangeInstance[];
}
