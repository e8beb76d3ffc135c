import { HausdorffError, translating } from "../error.js";
import { requireLoaded } from "../load.js";
import { NurbsModel } from "../model/model.js";
import type { PreparedModel } from "../wasm/nurbs_hausdorff.js";
import { inflate } from "./archive/inflate.js";
import { isGzip, kindByContent } from "./kind.js";
import type { CadOptions } from "./options.js";
import { brepInterchange, prepareBrep } from "./prepare/brep.js";
import { facesInterchange, prepareFaces } from "./prepare/faces.js";
import { prepareInterchange, rewritten } from "./prepare/json.js";
import type { CadReport } from "./report.js";
import { type Translation, translation } from "./translation.js";

/** The most bytes that are read: as much text as the module parses. */
const MAX_BYTES = 256 * 2 ** 20;

/**
 * Reads a CAD file: STEP, IGES, Rhino 3DM, OpenCASCADE BREP text, FreeCAD FCStd
 * or interchange JSON, each also compressed by gzip. The kind is found by the
 * content. The model's `report` says what was kept, approximated and left out.
 *
 * @throws {HausdorffError} `FORMAT_UNSUPPORTED` with the way to convert,
 * `PEER_MISSING` with the package to install, `CAD_UNREADABLE`,
 * `FILE_TOO_LARGE`, `EMPTY_MODEL`, `MODULE_NOT_LOADED` before the first
 * `Hausdorff.create`, and the errors of `Hausdorff.model`.
 */
export async function readCad(
  bytes: Uint8Array | ArrayBuffer,
  options: CadOptions = {},
): Promise<NurbsModel> {
  const file = await translatedFile(bytes, options);
  return translating(() => {
    if ("brep" in file) return modelOf(prepareBrep(file, options.name));
    if ("model" in file) return modelOf(prepareFaces(file));
    return modelOf(prepareInterchange(file.text));
  });
}

/**
 * As `readCad`, but to the text of interchange JSON, which `Hausdorff.model` takes.
 *
 * @throws {HausdorffError} as `readCad`.
 */
export async function convertCad(
  bytes: Uint8Array | ArrayBuffer,
  options: CadOptions = {},
): Promise<{ json: string; report: CadReport }> {
  const file = await translatedFile(bytes, options);
  return translating(() => {
    if ("brep" in file) return brepInterchange(file, options.name);
    return "model" in file ? facesInterchange(file) : rewritten(file.text);
  });
}

function modelOf({ prepared, report }: { prepared: PreparedModel; report: CadReport }): NurbsModel {
  return NurbsModel.of(prepared, report);
}

async function translatedFile(
  bytes: Uint8Array | ArrayBuffer,
  options: CadOptions,
): Promise<Translation> {
  requireLoaded();
  let content = asBytes(bytes);
  if (isGzip(content)) content = await inflate(content, "gzip");
  if (content.length > MAX_BYTES) {
    throw new HausdorffError(
      "FILE_TOO_LARGE",
      `the file has ${content.length} bytes, expected at most ${MAX_BYTES}`,
    );
  }
  return translation(content, kindByContent(content), options);
}

function asBytes(bytes: Uint8Array | ArrayBuffer): Uint8Array {
  if (bytes instanceof Uint8Array) return bytes;
  if (bytes instanceof ArrayBuffer) return new Uint8Array(bytes);
  throw new HausdorffError(
    "ARGUMENT_INVALID",
    `the file is ${bytes === null ? "null" : typeof bytes}, expected its bytes`,
  );
}
