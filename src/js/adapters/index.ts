// `nurbs-hausdorff/adapters`: geometry of other libraries as what `hd.model` takes, or `hd.readCad` of OpenCASCADE's.
export type { BrepText, InterchangeModel } from "../model/surface.js";
export { fromOcct } from "./occt.js";
export { fromRhino, type RhinoGeometry } from "./rhino.js";
export { fromThree, type ThreeNurbsSurface } from "./three.js";
export { fromVerb, type VerbSurface, type VerbSurfaceData } from "./verb.js";
