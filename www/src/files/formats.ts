// The formats of files, for the dialogues that choose them.

import type { CadKind } from "nurbs-hausdorff/cad";
import { texts } from "../texts/index.ts";

/** The value of `accept`: endings, since browsers know no types of CAD files. */
export const ACCEPT =
  ".step,.stp,.iges,.igs,.3dm,.brep,.brp,.FCStd,.json,.gz,.stl,.ply,.obj,.off,.vtk,.vtp,.gltf,.glb,.3mf,.xyz,.xyzn,.pts,.csv,.asc,.txt,.pcd,.ptx,.las,.laz,.e57";

/** The names of the formats. */
export const FORMATS: Readonly<Record<CadKind | "mesh", string>> = {
  step: "STEP",
  iges: "IGES",
  "3dm": "Rhino 3DM",
  brep: "BREP",
  fcstd: "FreeCAD",
  json: "JSON",
  mesh: texts.files.mesh,
};
