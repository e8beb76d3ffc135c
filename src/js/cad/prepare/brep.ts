import { PreparedModel } from "../../wasm/nurbs_hausdorff.js";
import type { CadKind } from "../kind.js";
import type { CadReport, SkippedFace } from "../report.js";

/** A file translated to BREP text. */
export interface BrepFile {
  /** The kind of the file. */
  kind: CadKind;
  brep: string;
  /** Metres per unit of the text's coordinates. */
  unit?: number;
  /** Number of faces that the file declares before the translation; 0 if unknown. */
  declared: number;
}

/** A report of the module: it numbers the faces. */
export interface ModuleReport extends Omit<CadReport, "kind" | "skipped" | "notes"> {
  skipped: { face: number; why: string }[];
  notes: { face: number; why: string }[];
}

/**
 * The model of a BREP text, and the report on the file.
 * @internal
 */
export function prepareBrep(
  file: BrepFile,
  name: string | undefined,
): { prepared: PreparedModel; report: CadReport } {
  const prepared = PreparedModel.fromBrep(file.brep, name, file.unit);
  return { prepared, report: completed(file, prepared.report as ModuleReport) };
}

/** The interchange JSON of a BREP text, and the report on the file. */
export function brepInterchange(
  file: BrepFile,
  name: string | undefined,
): { json: string; report: CadReport } {
  const { json, report } = PreparedModel.brepToJson(file.brep, name, file.unit) as {
    json: string;
    report: ModuleReport;
  };
  return { json, report: completed(file, report) };
}

/** The report with what the translation to BREP text lost. */
function completed({ kind, declared }: BrepFile, report: ModuleReport): CadReport {
  const named = ({ face, why }: { face: number; why: string }) => ({ face: `face ${face}`, why });
  const skipped: SkippedFace[] = report.skipped.map(named);
  const missing = declared - report.faces - skipped.length;
  if (missing > 0) {
    const why = "OpenCASCADE did not translate them";
    skipped.push({ face: `${missing} of ${declared} faces`, why });
  }
  return { ...report, kind, unit: report.unit ?? null, skipped, notes: report.notes.map(named) };
}
