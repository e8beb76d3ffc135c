import { HausdorffError, translating } from "../error.js";
import { checkKeys } from "../keys.js";
import { load } from "../load.js";
import { requireGoing } from "../measure/cancelled.js";
import { NurbsModel } from "../model/model.js";
import { type BrepText, isBrepText } from "../model/surface.js";
import type { PreparedModel } from "../wasm/nurbs_hausdorff.js";
import { inflate } from "./archive/inflate.js";
import { isGzip, kindByContent } from "./kind.js";
import type { CadOptions } from "./options.js";
import { facesInterchange, prepareFaces } from "./prepare/faces.js";
import { prepareInterchange, rewritten } from "./prepare/json.js";
import { prepareRead, readInterchange } from "./prepare/read.js";
import type { CadReport } from "./report.js";
import { type Translation, translation } from "./translation.js";

/** The names of the options. */
const OPTIONS = [
  "name",
  "unit",
  "reader",
  "occt",
  "rhino",
  "onLibrary",
  "onFace",
  "signal",
] as const satisfies (keyof CadOptions)[];

/** The most bytes that are read: as much text as the module parses. */
const MAX_BYTES = 256 * 2 ** 20;

/**
 * Reads a CAD file: STEP, IGES, Rhino 3DM, OpenCASCADE BREP text, FreeCAD FCStd
 * or interchange JSON, each also compressed by gzip; or the BREP text of a shape in
 * memory, which `fromOcct` writes. The kind is found by the content. The model's `report`
 * says what was kept, approximated and left out, and by which reader. The modules that a
 * file needs are loaded when it comes; no engine is needed.
 *
 * @throws {HausdorffError} `CANCELLED`; `FORMAT_UNSUPPORTED` with the way to convert,
 * `PEER_MISSING` with the package to install, `CAD_UNREADABLE`, `STEP_SYNTAX`, `BREP_SYNTAX` and
 * the others of the formats, `FILE_TOO_LARGE`, `EMPTY_MODEL`, `MODULE_FAILED`, and the errors of
 * `Hausdorff.model`.
 */
export async function readCad(
  bytes: Uint8Array | ArrayBuffer | BrepText,
  options: CadOptions = {},
): Promise<NurbsModel> {
  const file = await translatedFile(bytes, options);
  requireGoing(options.signal);
  return translating(() => {
    if ("read" in file) return modelOf(prepareRead(file, options));
    if ("model" in file) return modelOf(prepareFaces(file));
    return modelOf(prepareInterchange(file.text, options.unit));
  });
}

/**
 * As `readCad`, but to the text of interchange JSON, which `Hausdorff.model` takes.
 *
 * @throws {HausdorffError} as `readCad`.
 */
export async function convertCad(
  bytes: Uint8Array | ArrayBuffer | BrepText,
  options: CadOptions = {},
): Promise<{ json: string; report: CadReport }> {
  const file = await translatedFile(bytes, options);
  requireGoing(options.signal);
  return translating(() => {
    if ("read" in file) return readInterchange(file, options.name);
    return "model" in file ? facesInterchange(file) : rewritten(file.text, options.unit);
  });
}

function modelOf({ prepared, report }: { prepared: PreparedModel; report: CadReport }): NurbsModel {
  return NurbsModel.of(prepared, report);
}

async function translatedFile(
  bytes: Uint8Array | ArrayBuffer | BrepText,
  options: CadOptions,
): Promise<Translation> {
  checkKeys("options", options, OPTIONS);
  requireGoing(options.signal);
  if (isBrepText(bytes)) return ofShape(bytes, options);
  let content = asBytes(bytes);
  if (isGzip(content)) content = await inflate(content, "gzip");
  if (content.length > MAX_BYTES) {
    throw new HausdorffError(
      "FILE_TOO_LARGE",
      `the file has ${content.length} bytes, expected at most ${MAX_BYTES}`,
    );
  }
  const kind = kindByContent(content);
  await load();
  requireGoing(options.signal);
  return translation(content, kind, options);
}

/** The BREP text of a shape in memory, which may state its unit. */
async function ofShape(text: BrepText, options: CadOptions): Promise<Translation> {
  checkKeys("the BREP text", text, ["brep", "unit"]);
  const { brep, unit = options.unit } = text;
  requireType("brep", brep, "string");
  if (unit !== undefined) requireType("unit", unit, "number");
  await load();
  const content = new TextEncoder().encode(brep);
  return translation(content, "brep", { ...options, ...(unit === undefined ? {} : { unit }) });
}

function requireType(name: string, value: unknown, type: "string" | "number"): void {
  if (typeof value === type) return;
  throw new HausdorffError("ARGUMENT_INVALID", `${name} is ${typeof value}, expected a ${type}`);
}

function asBytes(bytes: Uint8Array | ArrayBuffer): Uint8Array {
  if (bytes instanceof Uint8Array) return bytes;
  if (bytes instanceof ArrayBuffer) return new Uint8Array(bytes);
  throw new HausdorffError(
    "ARGUMENT_INVALID",
    `the file is ${bytes === null ? "null" : typeof bytes}, expected its bytes`,
  );
}
