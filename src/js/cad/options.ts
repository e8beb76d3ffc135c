import type { PeerLoader } from "./peers/peers.js";

/** Options of `readCad` and `convertCad`. */
export interface CadOptions {
  /** The file's name, for errors and as the model's name. */
  name?: string;
  /** Metres per unit of the file's coordinates, where the file does not state it. */
  unit?: number;
  /** Loads OpenCASCADE for STEP and IGES; default the package `@bitbybit-dev/occt`. */
  occt?: PeerLoader;
  /** Loads rhino3dm for 3DM; default the package `rhino3dm`. */
  rhino?: PeerLoader;
}
