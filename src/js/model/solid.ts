import type { Vector3 } from "../measure/options.js";

/** Whether a model's faces close, and where not. */
export interface Solid {
  /** Whether every edge of a face has a partner, so that points lie inside or outside. */
  closed: boolean;
  /** The sets of faces that joined edges connect, voids of solids among them. */
  shells: { faces: number[]; closed: boolean }[];
  /** The edges without a partner, or the parts of edges; none for a solid. */
  freeEdges: FreeEdge[];
}

/** An edge of a face that no other edge joins, or a part of it. */
export interface FreeEdge {
  /** Index of the face. */
  face: number;
  /** The face's name in its source, if it has one. */
  faceName?: string;
  start: Vector3;
  /** A point between. */
  middle: Vector3;
  end: Vector3;
}
