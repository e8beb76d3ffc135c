import { HausdorffError, translating } from "../../error.js";
import type { InterchangeModel } from "../../model/surface.js";
import { brepInterchange } from "../prepare/brep.js";
import type { FacesFile } from "../prepare/faces.js";
import type { CadReport, FaceNote, SkippedFace } from "../report.js";
import type { DocumentShape, DocumentShapes } from "./fcstd.js";
import { joined } from "./join.js";

/** Metres per unit of FreeCAD's shapes. */
const FREECAD_UNIT = 0.001;

/**
 * The shapes of a FreeCAD document as one model. Shapes without faces, as sketches
 * are, have no part in it.
 *
 * @throws {HausdorffError} `EMPTY_MODEL`.
 */
export function documentModel(
  { shapes, skipped }: DocumentShapes,
  name: string | undefined,
): FacesFile {
  const models: InterchangeModel[] = [];
  const reports: CadReport[] = [];
  const lost: SkippedFace[] = [...skipped];
  const notes: FaceNote[] = [];
  for (const shape of shapes) {
    try {
      const { model, report } = shapeModel(shape);
      models.push(model);
      reports.push(report);
      const named = ({ face, why }: SkippedFace) => ({ face: `${shape.name} ${face}`, why });
      lost.push(...report.skipped.map(named));
      notes.push(...report.notes.map(named));
    } catch (error) {
      if (!(error instanceof HausdorffError)) throw error;
      const hasNoFace = error.code === "EMPTY_MODEL" || shape.brep.trim() === "";
      if (!hasNoFace) lost.push({ face: shape.name, why: error.message });
    }
  }
  if (models.length === 0) {
    const left = lost.map(({ face, why }) => `; ${face}: ${why}`).join("");
    throw new HausdorffError("EMPTY_MODEL", `no shape of the document has faces${left}`);
  }
  const sum = (count: (report: CadReport) => number) =>
    reports.reduce((total, report) => total + count(report), 0);
  return {
    model: { ...(name === undefined ? {} : { name }), unit: FREECAD_UNIT, ...joined(models) },
    report: {
      kind: "fcstd",
      faces: sum(({ faces }) => faces),
      trims: sum(({ trims }) => trims),
      exact: sum(({ exact }) => exact),
      fitted: sum(({ fitted }) => fitted),
      gap: reports.reduce((largest, { gap }) => Math.max(largest, gap), 0),
      unit: FREECAD_UNIT,
      skipped: lost,
      notes,
    },
  };
}

function shapeModel({ name, brep }: DocumentShape): { model: InterchangeModel; report: CadReport } {
  const file = { kind: "fcstd", brep, unit: FREECAD_UNIT, declared: 0 } as const;
  const { json, report } = translating(() => brepInterchange(file, name));
  return { model: JSON.parse(json) as InterchangeModel, report };
}
