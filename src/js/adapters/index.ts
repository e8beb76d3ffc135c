// `nurbs-hausdorff/adapters`: geometry of other libraries as what `hd.model` takes, or `hd.readCad` of OpenCASCADE's.
export type { MeshArrays } from "../model/mesh.js";
export type { BrepText, InterchangeModel } from "../model/surface.js";
export { fromOcct } from "./occt.js";
export { fromRhino, type RhinoGeometry } from "./rhino.js";
export {
  fromThree,
  fromThreeGeometry,
  type ThreeAttribute,
  type ThreeGeometry,
  type ThreeMatrix,
  type ThreeNurbsSurface,
} from "./three.js";
export { fromVerb, type VerbSurface, type VerbSurfaceData } from "./verb.js";
