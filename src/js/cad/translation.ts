import { HausdorffError } from "../error.js";
import { documentModel } from "./freecad/document.js";
import { documentShapes } from "./freecad/fcstd.js";
import type { CadKind } from "./kind.js";
import type { CadOptions } from "./options.js";
import { declaredFaces, translated } from "./peers/occt.js";
import type { FacesFile } from "./prepare/faces.js";
import type { ReadFile } from "./prepare/read.js";
import { type ReadableKind, readFaces } from "./readers.js";
import { readRhino } from "./rhino/index.js";

/** A file as the readers' module gave it, as the faces of a reader here, or as interchange JSON. */
export type Translation = ReadFile | FacesFile | { text: string };

/**
 * Translates a file of this kind.
 *
 * @throws {HausdorffError} as `readCad`.
 */
export async function translation(
  bytes: Uint8Array,
  kind: CadKind,
  options: CadOptions,
): Promise<Translation> {
  const { name, unit } = options;
  switch (kind) {
    case "step":
    case "iges":
      return options.reader === "occt"
        ? byOcct(bytes, kind, options)
        : ownElseOcct(bytes, kind, options);
    case "brep":
      return own(bytes, kind, options);
    case "3dm": {
      const { model, report } = await readRhino(bytes, options);
      const known = report.unit ?? unit;
      return known === undefined
        ? { model, report }
        : { model: { ...model, unit: known }, report: { ...report, unit: known } };
    }
    case "fcstd":
      return documentModel(await documentShapes(bytes), name);
    case "json":
      return { text: new TextDecoder().decode(bytes) };
  }
}

async function own(
  bytes: Uint8Array,
  kind: ReadableKind,
  { unit, onFace }: CadOptions,
): Promise<ReadFile> {
  const read = await readFaces(bytes, kind, onFace);
  return { kind, reader: "built-in", read, ...(unit === undefined ? {} : { unit }), declared: 0 };
}

/** A file by the package's reader, or by OpenCASCADE where that refuses it and this is at hand. */
async function ownElseOcct(
  bytes: Uint8Array,
  kind: "step" | "iges",
  options: CadOptions,
): Promise<ReadFile> {
  try {
    return await own(bytes, kind, options);
  } catch (refusal) {
    if (!isRefusal(refusal)) throw refusal;
    const file = await byOcct(bytes, kind, options).catch(() => {
      // OpenCASCADE is missing or refuses the file too: the first reason is the one to act on.
      throw refusal;
    });
    return { ...file, refusal: refusal.message };
  }
}

/** Whether the file is the reason, and not its size or the module. */
function isRefusal(error: unknown): error is HausdorffError {
  return (
    error instanceof HausdorffError && !["FILE_TOO_LARGE", "MODULE_FAILED"].includes(error.code)
  );
}

/** A file that OpenCASCADE translates to BREP text, which it scales to millimetres. */
async function byOcct(
  bytes: Uint8Array,
  kind: "step" | "iges",
  options: CadOptions,
): Promise<ReadFile> {
  const { brep, unit } = await translated(bytes, kind, options);
  const read = await readFaces(new TextEncoder().encode(brep), "brep", options.onFace);
  const declared = declaredFaces(bytes, kind);
  return { kind, reader: "occt", read, ...(unit === undefined ? {} : { unit }), declared };
}
