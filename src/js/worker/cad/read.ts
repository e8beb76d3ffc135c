import type { CadOptions } from "../../cad/options.js";
import { HausdorffError } from "../../error.js";
import { Hausdorff } from "../hausdorff.js";
import type { NurbsModel } from "../model.js";

/** Options of `readCad` of this entry: the worker loads the formats' libraries itself. */
export interface WorkerCadOptions extends Pick<CadOptions, "name" | "unit"> {
  /** Whether the file's buffer is transferred, and empty afterwards, not copied; default no. */
  transfer?: boolean;
}

/**
 * Reads a CAD file in the worker of `hausdorff`: `readCad` of `nurbs-hausdorff/cad`,
 * of which nothing runs on the caller's thread.
 *
 * @throws {HausdorffError} as that; `WORKER_FAILED` if `hausdorff` was given a
 * worker that runs another file than `nurbs-hausdorff/worker/cad/thread`.
 */
export async function readCad(
  hausdorff: Hausdorff,
  bytes: Uint8Array | ArrayBuffer,
  options: WorkerCadOptions = {},
): Promise<NurbsModel> {
  if (!(hausdorff instanceof Hausdorff)) {
    throw new HausdorffError("ARGUMENT_INVALID", "hausdorff is not a Hausdorff of this entry");
  }
  const { transfer, ...rest } = options;
  const buffer = bytes instanceof Uint8Array ? bytes.buffer : bytes;
  const moved = transfer === true && buffer instanceof ArrayBuffer ? [buffer] : [];
  return Hausdorff.newModel(hausdorff, "readCad", [bytes, rest], moved);
}
