import { PreparedModel } from "../wasm/nurbs_hausdorff.js";
import type { ModuleReport } from "./brep.js";
import type { InterchangeFaces } from "./interchange.js";
import type { CadReport } from "./report.js";

/** A model that a reader here made, and its report. */
export interface FacesFile {
  model: InterchangeFaces;
  report: CadReport;
}

/** The model of the faces that the module accepts, and the report with those that it refuses. */
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

function completed({ model, report }: FacesFile, { skipped }: ModuleReport): CadReport {
  const refused = new Set(skipped.map(({ face }) => face));
  const curves = (index: number) => model.surfaces[index]?.trim?.flat().length ?? 0;
  const lost = [...refused].reduce((sum, index) => sum + curves(index), 0);
  const named = skipped.map(({ face, why }) => ({
    face: model.surfaces[face]?.part ?? `face ${face}`,
    why,
  }));
  return {
    ...report,
    surfaces: report.surfaces - refused.size,
    trims: report.trims - lost,
    exact: Math.max(0, report.exact - lost),
    skipped: [...report.skipped, ...named],
  };
}
