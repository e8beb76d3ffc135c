import { HausdorffError, translating } from "../error.js";
import { loadModule } from "../load.js";
import init, { readBrep, readIges, readStep } from "../wasm/nurbs_hausdorff_readers.js";
import type { CadKind } from "./kind.js";
import type { CadOptions } from "./options.js";

/** The kinds of file that a reader of the package's takes. */
export type ReadableKind = Extract<CadKind, "brep" | "step" | "iges">;

type OnReadFace = (part: number, edges: Float64Array<ArrayBuffer>) => void;

/** The part of the work that is reading faces, about, where the rest is cutting them. */
export const READING_PART = 0.6;

/** Those readers: each gives what the core takes. */
const READERS: Readonly<
  Record<ReadableKind, (bytes: Uint8Array, onFace?: OnReadFace) => Uint8Array>
> = {
  brep: readBrep,
  step: readStep,
  iges: readIges,
};

/**
 * Reads a file by the package's reader, whose module is loaded with the first.
 *
 * @throws {HausdorffError} those of the format, `EMPTY_MODEL`, `FILE_TOO_LARGE`, `MODULE_FAILED`.
 */
export async function readFaces(
  bytes: Uint8Array,
  kind: ReadableKind,
  onFace?: CadOptions["onFace"],
): Promise<Uint8Array> {
  const tell: OnReadFace | undefined =
    onFace && ((part, edges) => onFace({ fraction: READING_PART * part, edges }));
  await loadModule("nurbs_hausdorff_readers", init);
  try {
    return translating(() => READERS[kind](bytes, tell));
  } catch (error) {
    if (!(error instanceof WebAssembly.RuntimeError)) throw error;
    const why = "the reader failed on it (out of memory, or a defect of the package)";
    throw new HausdorffError("CAD_UNREADABLE", `the file cannot be read: ${why}`, { cause: error });
  }
}
