/** An interval that contains a number. */
export interface Interval {
  lower: number;
  upper: number;
}

/** Three intervals, along x, y and z. */
export type Intervals3 = [Interval, Interval, Interval];

/** How the faces of a body are oriented in its source. */
export type Orientation = "consistent" | "insideOut" | "mixed" | "notOrientable" | "undecided";

/** Why a volume is not known. */
export type VolumeUnknown = "open" | "notOrientable" | "nesting" | "points";

/**
 * Facts of a body or of a model, in model units and at density 1. Guarantee: every number is in its interval. They
 * are those of the patches that are measured; the extents hold for the faces themselves.
 */
export interface Facts {
  /** The volume: of a model, the sum over its bodies. */
  volume: Interval | null;
  /** Why there is no volume. */
  volumeUnknown?: VolumeUnknown;
  /** About the volume between the faces and their source: an estimate, and no part of the interval. */
  volumeOfGap?: number;
  /** The area of all faces; none of points. */
  area: Interval | null;
  /** The lengths along x, y and z. */
  extents: Intervals3;
  min: Intervals3;
  max: Intervals3;
  /** The centroid of the volume. */
  centroid: Intervals3 | null;
  /** The tensor of inertia about the centroid. */
  inertia: [Intervals3, Intervals3, Intervals3] | null;
  /** The moments about the principal axes, ascending. */
  principalMoments: Intervals3 | null;
  /** Unit vectors along the principal axes. */
  principalAxes: [number, number, number][] | null;
  /** Upper bounds on the angles, in radians, between these and the principal axes. */
  principalAngles: [number, number, number] | null;
  /** The lengths along `principalAxes`. */
  principalExtents: Intervals3 | null;
}

/** An outer shell and its voids, a sheet, or a cloud of points. */
export interface Body {
  /** The last name of its path, if it has one. */
  name: string | null;
  /**
   * The name that no other body of the model has, by which comparisons and checks call it: the names of its path
   * joined, else `body 1` by its number; equal names are numbered.
   */
  fullName: string;
  /** The names of the levels that all its faces have, from the outermost. */
  path: string[];
  kind: "solid" | "sheet" | "points";
  /** Whether every edge of its faces has a partner. */
  closed: boolean;
  orientation: Orientation | null;
  /** The indices of its faces. */
  faces: number[];
  /** Of a mesh, the number of its triangles. */
  triangles?: number;
  /** Of a cloud, the number of its points. */
  points?: number;
  /** The number of its shells that are voids. */
  voids: number;
  /** The number of its edges without a partner. */
  freeEdges: number;
  facts: Facts;
}
