import { HausdorffError } from "../error.js";

/** The kinds of file that are read. */
export type CadKind = "step" | "iges" | "3dm" | "brep" | "fcstd" | "json";

/** The formats that are read, for the errors' texts. */
const READ =
  "read are STEP, IGES, Rhino 3DM, OpenCASCADE BREP text, FreeCAD FCStd and interchange JSON";

/** Bytes in which a text's signature is searched, behind comments. */
const HEAD_LENGTH = 1024;

/** The column, from 0, that names a line's section in IGES. */
const IGES_SECTION_COLUMN = 72;

const BY_MESH = "readMesh reads it, as the command does by the ending of its name";
const TRIANGLES = `it holds triangles: ${BY_MESH}`;
const POINTS = `it holds points: ${BY_MESH}`;

/** Bytes in which a STEP file's schema is searched. */
const HEADER_LENGTH = 1 << 14;

const BY_ENDING = "meshes and points are known by the endings of their names";

const EXPORT_STEP = "export it as STEP from the program that made it";

/** Formats that are recognised and not read: signature, name, advice. */
const OTHERS: readonly (readonly [signature: RegExp, name: string, advice: string])[] = [
  [
    /^\s*Open CASCADE Topology V/,
    "an OpenCASCADE BREP file in binary",
    "write it with BRepTools.Write",
  ],
  [
    /^version https:\/\/git-lfs/,
    "a pointer of Git LFS",
    "fetch the file that it stands for: git lfs pull",
  ],
  [
    /^\s*<(!doctype html|html)/i,
    "a page in HTML",
    "fetch the file itself, and not the page that shows it",
  ],
  [
    /^\s*iso-10303-21/i,
    "a STEP file in lower case",
    "ISO 10303-21 has its keywords in upper case: write it again with another exporter",
  ],
  [/iso[_-]10303[_-]28/i, "a STEP file in XML (ISO 10303-28)", "write it as text of ISO 10303-21"],
  [/^(\xFF\xFE|\xFE\xFF)/, "a text in UTF-16", "write it in ASCII or UTF-8"],
  [/^(\*\*ABCDEFG|PS\0)/, "a Parasolid file", EXPORT_STEP],
  [/^(ACIS BinaryFile|ASM BinaryFile|\d{2,5} \d+ \d+ \d+\s)/, "an ACIS file", EXPORT_STEP],
  [/^Version \d+\.\d+ JT/, "a JT file", EXPORT_STEP],
  [/^V5_CFV2/, "a CATIA file", EXPORT_STEP],
  [/^\xD0\xCF.\xE0\xA1/s, "a SolidWorks, Inventor or other compound file", EXPORT_STEP],
  [/^AC10\d\d/, "a DWG file", EXPORT_STEP],
  [/^\s*0\s+SECTION/, "a DXF file", EXPORT_STEP],
  [/^glTF/, "a glTF file", TRIANGLES],
  [/^Kaydara FBX/, "an FBX file", "it holds triangles, not NURBS: export STEP instead"],
  [/^ply\s/, "a PLY file", TRIANGLES],
  [/^solid\s/, "an STL file", TRIANGLES],
  [/^\s*(#.*\n\s*)*(v|mtllib|o) /, "an OBJ file", TRIANGLES],
  [/^LASF/, "a LAS or LAZ file", POINTS],
  [/^ASTM-E57/, "an E57 file", POINTS],
];

/** The error for bytes that no reader takes. */
export function unsupported(found: string, advice: string): HausdorffError {
  return new HausdorffError("FORMAT_UNSUPPORTED", `found ${found}; ${READ}; ${advice}`);
}

/** The first bytes, one character each. */
export function head(bytes: Uint8Array, length = HEAD_LENGTH): string {
  let text = "";
  for (const byte of bytes.subarray(0, length)) text += String.fromCharCode(byte);
  return text;
}

/** The kind of a CAD file by the beginning of its text, or undefined. */
export function kindOfText(text: string): "step" | "brep" | "iges" | undefined {
  const start = text.slice(0, HEAD_LENGTH);
  // Comments of any length may stand before the text of a STEP file.
  const commented = text.replace(/^\s*(\/\*[\s\S]*?\*\/\s*)*/, "").slice(0, HEAD_LENGTH);
  if (commented.includes("ISO-10303-21")) return "step";
  if (/^\s*(DBRep_DrawableShape|CASCADE Topology V)/.test(start)) return "brep";
  return /^S[ \d]{6}\d/.test(start.slice(IGES_SECTION_COLUMN)) ? "iges" : undefined;
}

/** Whether the bytes are compressed by gzip. */
export function isGzip(bytes: Uint8Array): boolean {
  return bytes[0] === 0x1f && bytes[1] === 0x8b;
}

/** Whether the bytes are a zip archive. */
export function isZip(bytes: Uint8Array): boolean {
  return head(bytes.subarray(0, 4)) === "PK\x03\x04";
}

/**
 * The kind of a file by its content, never by its name. A zip archive counts as
 * `fcstd`; its reader looks inside.
 *
 * @throws {HausdorffError} `FORMAT_UNSUPPORTED`, naming what was recognised and
 * how to convert it.
 */
export function kindByContent(bytes: Uint8Array): CadKind {
  if (bytes.length === 0) throw unsupported("an empty file", "choose another file");
  if (isZip(bytes)) return "fcstd";
  const text = head(bytes, HEADER_LENGTH).replace(/^\xEF\xBB\xBF/, "");
  if (text.startsWith("3D Geometry File Format")) return "3dm";
  const kind = kindOfText(text);
  if (kind === "step") refuseBuildings(head(bytes, HEADER_LENGTH));
  if (kind !== undefined) return kind;
  if (/^\s*\{/.test(text)) return "json";
  const other = OTHERS.find(([signature]) => signature.test(text));
  if (other) throw unsupported(other[1], other[2]);
  throw unsupported("an unknown format", `${EXPORT_STEP}; ${BY_ENDING}`);
}

/** Refuses IFC files, which are of the syntax of STEP alone. */
function refuseBuildings(header: string): void {
  const schema = /FILE_SCHEMA\s*\(\s*\(\s*'(IFC[^']*)'/i.exec(header)?.[1];
  if (schema === undefined) return;
  throw unsupported(
    "an IFC file, as of buildings",
    `its schema is ${schema}, and IfcConvert of IfcOpenShell writes its shapes as STEP`,
  );
}
