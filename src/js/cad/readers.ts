import { HausdorffError, translating } from "../error.js";
import { loadModule } from "../load.js";
import init, { readBrep, readIges, readStep } from "../wasm/nurbs_hausdorff_readers.js";
import type { CadKind } from "./kind.js";

/** The kinds of file that a reader of the package's takes. */
export type ReadableKind = Extract<CadKind, "brep" | "step" | "iges">;

/** Those readers: each gives what the core takes. */
const READERS: Readonly<Record<ReadableKind, (bytes: Uint8Array) => Uint8Array>> = {
  brep: readBrep,
  step: readStep,
  iges: readIges,
};

/**
 * Reads a file by the package's reader, whose module is loaded with the first.
 *
 * @throws {HausdorffError} those of the format, `EMPTY_MODEL`, `FILE_TOO_LARGE`, `MODULE_FAILED`.
 */
export async function readFaces(bytes: Uint8Array, kind: ReadableKind): Promise<Uint8Array> {
  await loadModule("nurbs_hausdorff_readers", init);
  try {
    return translating(() => READERS[kind](bytes));
  } catch (error) {
    if (!(error instanceof WebAssembly.RuntimeError)) throw error;
    const why = "the reader failed on it (out of memory, or a defect of the package)";
    throw new HausdorffError("CAD_UNREADABLE", `the file cannot be read: ${why}`, { cause: error });
  }
}
