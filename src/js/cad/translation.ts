import { translating } from "../error.js";
import { type BrepFile, brepInterchange } from "./brep.js";
import type { FacesFile } from "./faces.js";
import { type DocumentShapes, documentShapes } from "./fcstd.js";
import type { InterchangeFaces } from "./interchange.js";
import { joined } from "./join.js";
import type { CadKind } from "./kind.js";
import { declaredFaces, translated } from "./occt.js";
import type { CadOptions } from "./options.js";
import type { CadReport } from "./report.js";
import { readRhino } from "./rhino/index.js";

/** A file as BREP text, as the faces of a reader here, or as interchange JSON. */
export type Translation = BrepFile | FacesFile | { text: string };

/** Metres per unit of FreeCAD's shapes. */
const FREECAD_UNIT = 0.001;

/**
 * Translates a file of this kind.
 *
 * @throws {HausdorffError} as `readCad`.
 */
export async function translation(
  bytes: Uint8Array,
  kind: CadKind,
  { name, unit, occt, rhino }: CadOptions,
): Promise<Translation> {
  switch (kind) {
    case "step":
    case "iges":
      return {
        kind,
        ...(await translated(bytes, kind, occt)),
        declared: declaredFaces(bytes, kind),
      };
    case "brep":
      return { kind, brep: text(bytes), ...(unit === undefined ? {} : { unit }), declared: 0 };
    case "3dm": {
      const { model, report } = await readRhino(bytes, name, rhino);
      const known = report.unit ?? unit;
      return known === undefined
        ? { model, report }
        : { model: { ...model, unit: known }, report: { ...report, unit: known } };
    }
    case "fcstd":
      return documentModel(await documentShapes(bytes), name);
    case "json":
      return { text: text(bytes) };
  }
}

function text(bytes: Uint8Array): string {
  return new TextDecoder().decode(bytes);
}

/** The shapes of a FreeCAD document as one model. */
function documentModel({ shapes, skipped }: DocumentShapes, name: string | undefined): Translation {
  const files = shapes.map(({ name, brep }) =>
    translating(() =>
      brepInterchange({ kind: "fcstd", brep, unit: FREECAD_UNIT, declared: 0 }, name),
    ),
  );
  const models = files.map(({ json }) => JSON.parse(json) as InterchangeFaces);
  const sum = (count: (report: CadReport) => number) =>
    files.reduce((total, { report }) => total + count(report), 0);
  return {
    model: { ...(name === undefined ? {} : { name }), unit: FREECAD_UNIT, ...joined(models) },
    report: {
      kind: "fcstd",
      surfaces: sum(({ surfaces }) => surfaces),
      trims: sum(({ trims }) => trims),
      exact: sum(({ exact }) => exact),
      fitted: sum(({ fitted }) => fitted),
      gap: Math.max(...files.map(({ report }) => report.gap)),
      unit: FREECAD_UNIT,
      skipped: [...skipped, ...files.flatMap(({ report }) => report.skipped)],
    },
  };
}
