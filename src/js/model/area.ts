/** An interval that contains an area, in squares of the model unit. */
export interface Area {
  /** A lower bound on the area. */
  lower: number;
  /** An upper bound on the area. */
  upper: number;
}

/** The area of a model. */
export interface ModelArea extends Area {
  /** The areas of its surfaces, in order. */
  faces: Area[];
}
