import type { Tessellation } from "../model/tessellation.js";
import type { LibraryOptions } from "./peers/peers.js";

/** A face of a file that is being read, to draw before the model is complete. */
export interface FaceDraft {
  /** About which part of the work is done, from 0 to 1. */
  fraction: number;
  /** Of a face that was read: the ends of segments along its edges, x, y, z each. */
  edges?: Float64Array<ArrayBuffer>;
  /** Of a face that was cut: triangles, coarser than those of the model; nothing is measured on them. */
  triangles?: Tessellation;
}

/** Options of `readCad` and `convertCad`. */
export interface CadOptions extends LibraryOptions {
  /** The file's name, for errors and as the model's name. */
  name?: string;
  /** Metres per unit of the file's coordinates, where the file does not state it. */
  unit?: number;
  /**
   * The reader of STEP and IGES: the package's own (default), with OpenCASCADE for a file that
   * it refuses; or OpenCASCADE at once.
   */
  reader?: "built-in" | "occt";
  /**
   * Called for each face of a STEP, IGES or BREP file, first as it is read and then as it is cut,
   * in the order of the file. Faces that stand in several places are read once.
   */
  onFace?: (face: FaceDraft) => void;
  /**
   * Cancels the reading, before it begins or between its steps: the promise rejects with code
   * `CANCELLED`. A worker's rejects at once.
   */
  signal?: AbortSignal;
}
