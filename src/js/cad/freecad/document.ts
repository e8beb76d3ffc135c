import { HausdorffError, translating } from "../../error.js";
import { level } from "../../model/face-path.js";
import type { InterchangeModel } from "../../model/surface.js";
import type { FacesFile } from "../prepare/faces.js";
import { readInterchange } from "../prepare/read.js";
import { readFaces } from "../readers.js";
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
export async function documentModel(
  { shapes, skipped, notes: noted }: DocumentShapes,
  name: string | undefined,
): Promise<FacesFile> {
  const models: InterchangeModel[] = [];
  const reports: CadReport[] = [];
  const lost: SkippedFace[] = [...skipped];
  const notes: FaceNote[] = [...noted];
  for (const shape of shapes) {
    try {
      const { model, report } = await shapeModel(shape);
      models.push(model);
      reports.push(report);
      const named = <Face extends FaceNote>(one: Face) => ({
        ...one,
        face: `${shape.name} ${one.face}`,
      });
      lost.push(...report.skipped.map(named));
      notes.push(...report.notes.map(named));
    } catch (error) {
      if (!(error instanceof HausdorffError)) throw error;
      const hasNoFace = error.code === "EMPTY_MODEL" || isBlank(shape.brep);
      if (!hasNoFace) lost.push({ face: shape.name, code: error.code, why: error.message });
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
      reader: "built-in",
      faces: sum(({ faces }) => faces),
      trims: sum(({ trims }) => trims),
      exact: sum(({ exact }) => exact),
      fitted: sum(({ fitted }) => fitted),
      gap: reports.reduce((largest, { gap }) => Math.max(largest, gap), 0),
      gapProven: reports.every(({ gapProven }) => gapProven),
      unit: FREECAD_UNIT,
      skipped: lost,
      notes,
    },
  };
}

async function shapeModel({
  name,
  brep,
}: DocumentShape): Promise<{ model: InterchangeModel; report: CadReport }> {
  const read = await readFaces(brep, "brep");
  const file = {
    kind: "fcstd",
    reader: "built-in",
    read,
    unit: FREECAD_UNIT,
    declared: 0,
  } as const;
  const { json, report } = translating(() => readInterchange(file, name));
  const model = JSON.parse(json) as InterchangeModel;
  // Faces of several shapes have the same names.
  const named = model.surfaces.map((face) => ({
    ...face,
    part: `${level(name)} / ${face.part ?? ""}`,
  }));
  return { model: { ...model, surfaces: named }, report };
}

/** Whether a text is empty, as that of a sketch may be. */
function isBlank(text: Uint8Array): boolean {
  return new TextDecoder().decode(text).trim() === "";
}
