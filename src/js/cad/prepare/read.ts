import type { Tessellation } from "../../model/tessellation.js";
import { PreparedModel } from "../../wasm/nurbs_hausdorff.js";
import type { CadKind } from "../kind.js";
import type { CadOptions } from "../options.js";
import { READING_PART } from "../readers.js";
import type { CadReader, CadReport, FaceNote, SkippedFace } from "../report.js";

/** What the readers' module gave of a file. */
export interface ReadFile {
  /** The kind of the file. */
  kind: CadKind;
  /** The reader that took the file itself. */
  reader: CadReader;
  /** The faces and the account of them, as the core takes them. */
  read: Uint8Array;
  /** Metres per unit of the coordinates, where the file does not state it. */
  unit?: number;
  /** Number of faces that the file declares before a translation; 0 if unknown. */
  declared: number;
  /** The reason for which the package's own reader refused the file, if it did. */
  refusal?: string;
}

/** A face of a module's report, with its number. */
interface ModuleFace {
  face: number;
  entity?: number | null;
  code: string;
  why: string;
}

/** A report of the module: it numbers the faces. */
export interface ModuleReport extends Omit<CadReport, "kind" | "reader" | "skipped" | "notes"> {
  skipped: ModuleFace[];
  notes: ModuleFace[];
}

/**
 * The model of what was read, and the report on the file.
 * @internal
 */
export function prepareRead(
  file: ReadFile,
  { name, onFace }: Pick<CadOptions, "name" | "onFace">,
): { prepared: PreparedModel; report: CadReport } {
  const tell =
    onFace &&
    ((part: number, triangles: Tessellation) =>
      onFace({ fraction: READING_PART + (1 - READING_PART) * part, triangles }));
  const prepared = PreparedModel.fromRead(file.read, name, file.unit, tell);
  return { prepared, report: completed(file, prepared.report as ModuleReport) };
}

/** The interchange JSON of what was read, and the report on the file. */
export function readInterchange(
  file: ReadFile,
  name: string | undefined,
): { json: string; report: CadReport } {
  const { json, report } = PreparedModel.readToJson(file.read, name, file.unit) as {
    json: string;
    report: ModuleReport;
  };
  return { json, report: completed(file, report) };
}

/** The report with the file's kind and reader, and with what a translation lost. */
function completed(file: ReadFile, report: ModuleReport): CadReport {
  const { kind, reader, declared, refusal } = file;
  const skipped: SkippedFace[] = report.skipped.map(accounted);
  const missing = declared - report.faces - skipped.length;
  if (missing > 0) {
    const why = "OpenCASCADE did not translate them";
    skipped.push({ face: `${missing} of ${declared} faces`, code: "OCCT_TRANSLATION", why });
  }
  const notes: FaceNote[] = report.notes.map(accounted);
  if (refusal !== undefined) {
    const why = `OpenCASCADE read it, as the package's reader refused it: ${refusal}`;
    notes.unshift({ face: "the file", code: "OCCT_READER", why });
  }
  return { ...report, kind, reader, unit: report.unit ?? null, skipped, notes };
}

function accounted({ face, entity, code, why }: ModuleFace): SkippedFace {
  return { face, ...(entity == null ? {} : { entity }), code, why };
}
