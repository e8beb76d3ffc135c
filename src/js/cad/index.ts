// `nurbs-hausdorff/cad`: reads and converts CAD files without an engine. Nothing of a format is
// loaded before a file of it comes.
export type { CadKind } from "./kind.js";
export { type MeshFormat, type MeshOptions, meshFormatOf, readMesh } from "./mesh.js";
export type { CadOptions, FaceDraft } from "./options.js";
export type { Libraries, LibraryOptions, PeerLoader } from "./peers/peers.js";
export { convertCad, readCad } from "./read.js";
export type { CadReader, CadReport, FaceNote, SkippedFace } from "./report.js";
