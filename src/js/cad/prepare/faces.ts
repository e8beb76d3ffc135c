import type { InterchangeModel } from "../../model/surface.js";
import { PreparedModel } from "../../wasm/nurbs_hausdorff.js";
import type { CadReport } from "../report.js";
import type { ModuleReport } from "./read.js";

/** A model that a reader here made, and its report. */
export interface FacesFile {
  model: InterchangeModel;
  report: CadReport;
}

/**
 * The model of the faces that the module accepts, and the report with those that it refuses.
 * @internal
 */
export function prepareFaces(file: FacesFile): { prepared: PreparedModel; report: CadReport } {
  const prepared = PreparedModel.fromReader(JSON.stringify(file.model));
  return { prepared, report: completed(file, prepared.report as ModuleReport) };
}

/** The interchange JSON of the faces that the module accepts, and the report. */
export function facesInterchange(file: FacesFile): { json: string; report: CadReport } {
  const { json, report } = PreparedModel.readerToJson(JSON.stringify(file.model)) as {
    json: string;
    report: ModuleReport;
  };
  return { json, report: completed(file, report) };
}

function completed({ model, report }: FacesFile, read: ModuleReport): CadReport {
  const refused = read.skipped.map(({ face, code, why }) => ({
    face: model.surfaces[face]?.part ?? face,
    code,
    why,
  }));
  return {
    ...report,
    faces: read.faces,
    trims: read.trims,
    exact: Math.max(0, read.trims - report.fitted),
    skipped: [...report.skipped, ...refused],
  };
}
