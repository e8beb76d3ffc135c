import { PreparedModel } from "../../wasm/nurbs_hausdorff.js";
import type { CadReport } from "../report.js";
import type { ModuleReport } from "./read.js";

/**
 * The model of interchange JSON, which is read without a change or not at all.
 * @internal
 */
export function prepareInterchange(
  text: string,
  unit: number | undefined,
): { prepared: PreparedModel; report: CadReport } {
  const prepared = PreparedModel.fromJson(text, unit);
  return { prepared, report: exact(prepared.report as ModuleReport) };
}

/** Interchange JSON, validated and written anew by the module. */
export function rewritten(
  text: string,
  unit: number | undefined,
): { json: string; report: CadReport } {
  const { json, report } = PreparedModel.jsonToJson(text, unit) as {
    json: string;
    report: ModuleReport;
  };
  return { json, report: exact(report) };
}

function exact(report: ModuleReport): CadReport {
  return {
    ...report,
    kind: "json",
    reader: "built-in",
    unit: report.unit ?? null,
    skipped: [],
    notes: [],
  };
}
