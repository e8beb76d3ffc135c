import { brepFaces } from "../cad/rhino/faces.js";
import { nurbsForm, nurbsOf } from "../cad/rhino/surface.js";
import type { RhinoBrep, RhinoExtrusion, RhinoSurface } from "../cad/rhino/types.js";
import { HausdorffError } from "../error.js";
import type { InterchangeModel } from "../model/surface.js";

/** A `Brep`, `Extrusion`, `BrepFace` or `Surface` of rhino3dm. */
export type RhinoGeometry = object;

/**
 * A B-rep with its trimming curves, an extrusion, or an untrimmed surface of
 * rhino3dm. For `hd.model`.
 *
 * @param unit metres per unit; rhino3dm's geometry does not know it.
 * @throws {HausdorffError} `ARGUMENT_INVALID` for other geometry and for faces
 * that cannot be read, which are named: none is left out.
 */
export function fromRhino(
  geometry: RhinoGeometry,
  { unit, name = "B-rep" }: { unit?: number; name?: string } = {},
): InterchangeModel {
  const common = { name, ...(unit === undefined ? {} : { unit }) };
  const brep = brepOf(geometry);
  if (brep === null) {
    if (typeof (geometry as Partial<RhinoSurface>)?.toNurbsSurface !== "function") {
      throw new HausdorffError("ARGUMENT_INVALID", "expected a Brep or a Surface of rhino3dm");
    }
    return { ...common, surfaces: [nurbsForm(nurbsOf(geometry as RhinoSurface))] };
  }
  const { faces, skipped } = brepFaces(brep, name);
  const [first] = skipped;
  if (first) throw new HausdorffError("ARGUMENT_INVALID", `${first.face}: ${first.why}`);
  return { ...common, surfaces: faces };
}

function brepOf(geometry: RhinoGeometry): RhinoBrep | null {
  const { faces, toBrep } = (geometry ?? {}) as Partial<RhinoBrep & RhinoExtrusion>;
  if (typeof faces === "function") return geometry as RhinoBrep;
  return typeof toBrep === "function" ? (geometry as RhinoExtrusion).toBrep(false) : null;
}
