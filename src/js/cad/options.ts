import type { LibraryOptions } from "./peers/peers.js";

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
   * Cancels the reading, before it begins or between its steps: the promise rejects with code
   * `CANCELLED`. A worker's rejects at once.
   */
  signal?: AbortSignal;
}
