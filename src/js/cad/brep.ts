import { PreparedModel } from "../wasm/nurbs_hausdorff.js";
import type { CadKind } from "./kind.js";
import type { CadReport, SkippedFace } from "./report.js";

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

/** The module's report on a BREP text. */
type BrepReport = Omit<CadReport, "kind" | "unit">;

/** The model of a BREP text, and the report on the file. */
export function prepareBrep(
  file: BrepFile,
  name: string | undefined,
): { prepared: PreparedModel; report: CadReport } {
  const prepared = PreparedModel.fromBrep(file.brep, name, file.unit);
  return { prepared, report: completed(file, prepared.report as BrepReport) };
}

/** The interchange JSON of a BREP text, and the report on the file. */
export function brepInterchange(
  file: BrepFile,
  name: string | undefined,
): { json: string; report: CadReport } {
  const { json, report } = PreparedModel.brepToJson(file.brep, name, file.unit) as {
    json: string;
    report: BrepReport;
  };
  return { json, report: completed(file, report) };
}

/** The report with what the translation to BREP text lost. */
function completed({ kind, unit, declared }: BrepFile, report: BrepReport): CadReport {
  const lost: SkippedFace[] = [];
  const missing = declared - report.surfaces - report.skipped.length;
  if (missing > 0) {
    const why = "OpenCASCADE did not translate them";
    lost.push({ face: `${missing} of ${declared} faces`, why });
  }
  return { kind, ...report, unit: unit ?? null, skipped: [...report.skipped, ...lost] };
}
