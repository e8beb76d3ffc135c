import { documentModel } from "./freecad/document.js";
import { documentShapes } from "./freecad/fcstd.js";
import type { CadKind } from "./kind.js";
import type { CadOptions } from "./options.js";
import { declaredFaces, translated } from "./peers/occt.js";
import type { BrepFile } from "./prepare/brep.js";
import type { FacesFile } from "./prepare/faces.js";
import { readRhino } from "./rhino/index.js";

/** A file as BREP text, as the faces of a reader here, or as interchange JSON. */
export type Translation = BrepFile | FacesFile | { text: string };

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
