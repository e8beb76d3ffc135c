import { HausdorffError } from "../../error.js";
import { entryBytes, type ZipEntry, zipEntries } from "../archive/zip.js";
import { unsupported } from "../kind.js";
import type { FaceNote, SkippedFace } from "../report.js";

const PLACED = "its parts are placed by a container: export the document as STEP";
const BINARY = "its shape is stored in binary: export the document as STEP";
const MESH = "its triangles are not read: export the object as STL or PLY";

/** Why objects with these elements are no part of the model. */
const WITHOUT_SURFACE = [
  [/<Points\b/, "its points are no surface"],
  [/<FemMesh\b/, "its mesh of an analysis is no shape"],
] as const;

/** A shape of a FreeCAD document. */
export interface DocumentShape {
  name: string;
  /** Its BREP text. */
  brep: Uint8Array;
}

/** The shapes of a document, and what of it is not read or no part of the model. */
export interface DocumentShapes {
  shapes: DocumentShape[];
  skipped: SkippedFace[];
  notes: FaceNote[];
}

/** An object of a document's XML. */
interface DocumentObject {
  name: string;
  xml: string;
}

const IDENTITY_PLACEMENT = /Q0="0(?:\.0+)?" Q1="0(?:\.0+)?" Q2="0(?:\.0+)?"/;

/**
 * The visible shapes of a FreeCAD document. A body's features are left out, as
 * the body's own shape is that of the last, and so are the members of a part that
 * is hidden. Meshes are listed as skipped, and points are noted.
 *
 * @throws {HausdorffError} `FORMAT_UNSUPPORTED` for other archives,
 * `CAD_UNREADABLE`, `EMPTY_MODEL`.
 */
export async function documentShapes(bytes: Uint8Array): Promise<DocumentShapes> {
  const entries = new Map(zipEntries(bytes).map((entry) => [entry.name, entry]));
  if (!entries.has("Document.xml")) throw otherArchive(entries);
  const bytesOf = async (name: string) => {
    const entry = entries.get(name);
    return entry ? entryBytes(entry) : new Uint8Array();
  };
  const text = async (name: string) => new TextDecoder().decode(await bytesOf(name));
  const objects = elements(await text("Document.xml"), "Object");
  // Documents made without a window have no views, and say it of the objects.
  const views = entries.has("GuiDocument.xml")
    ? elements(await text("GuiDocument.xml"), "ViewProvider")
    : objects;
  const omitted = omittedObjects(objects, hiddenObjects(views));
  const shapes: DocumentShape[] = [];
  const skipped: SkippedFace[] = [];
  const notes: FaceNote[] = [];
  for (const { name, xml } of objects) {
    if (omitted.has(name)) continue;
    // Features of PartDesign and sketches have other shapes beside their own.
    const file = /<Part\b[^>]*\bfile="([^"]+)"/.exec(property(xml, "Shape"))?.[1];
    const why = unsupportedBecause(xml, file);
    if (why !== undefined) skipped.push({ face: name, code: "FORMAT_UNSUPPORTED", why });
    else if (file === undefined) notes.push(...withoutSurface(name, xml));
    else if (entries.has(file)) shapes.push({ name, brep: await bytesOf(file) });
    else {
      const missing = `its shape is in ${file}, which the archive does not have`;
      skipped.push({ face: name, code: "CAD_UNREADABLE", why: missing });
    }
  }
  if (shapes.length === 0) {
    const left = skipped.map(({ face, why }) => `; ${face}: ${why}`).join("");
    throw new HausdorffError("EMPTY_MODEL", `the FreeCAD document has no visible shape${left}`);
  }
  return { shapes, skipped, notes };
}

function otherArchive(entries: ReadonlyMap<string, ZipEntry>): HausdorffError {
  const names = [...entries.keys()];
  if (names.some((name) => name.endsWith(".model"))) {
    return unsupported("a 3MF file", "it holds triangles, not NURBS: export STEP instead");
  }
  return unsupported("a zip archive", "unpack it, and choose the file inside");
}

/** The elements of this name that have properties inside. */
function elements(xml: string, tag: string): DocumentObject[] {
  const pattern = new RegExp(
    `<${tag} [^>]*\\bname="([^"]+)"[^>]*(?<!/)>([\\s\\S]*?)</${tag}>`,
    "g",
  );
  return [...xml.matchAll(pattern)].map(([, name = "", content = ""]) => ({ name, xml: content }));
}

/** The content of a property of an object; empty where it has none. */
function property(xml: string, name: string): string {
  const pattern = new RegExp(`<Property name="${name}"[^>]*(?<!/)>([\\s\\S]*?)</Property>`);
  return pattern.exec(xml)?.[1] ?? "";
}

/** Why an object is left out of the model that it is a part of. */
function unsupportedBecause(xml: string, file: string | undefined): string | undefined {
  if (isContainer(xml)) return PLACED;
  if (file === undefined) return /<Mesh\b/.test(xml) ? MESH : undefined;
  return file.endsWith(".bin") ? BINARY : undefined;
}

/** Notes on an object without a shape. */
function withoutSurface(face: string, xml: string): FaceNote[] {
  const found = WITHOUT_SURFACE.find(([pattern]) => pattern.test(xml));
  return found === undefined ? [] : [{ face, code: "NOT_MEASURED", why: found[1] }];
}

function hiddenObjects(views: readonly DocumentObject[]): string[] {
  const isHidden = ({ xml }: DocumentObject) =>
    /<Property name="Visibility"[^>]*>\s*<Bool value="false"/.test(xml);
  return views.filter(isHidden).map(({ name }) => name);
}

/** The objects that are hidden, the features of bodies, and all that is below a hidden part. */
function omittedObjects(
  objects: readonly DocumentObject[],
  hidden: readonly string[],
): ReadonlySet<string> {
  const omitted = new Set(hidden);
  const isClosed = (object: DocumentObject) =>
    isBody(object) || (isPart(object.xml) && omitted.has(object.name));
  const pending = objects.filter(isClosed).flatMap(({ xml }) => links(xml));
  const xmlOf = new Map(objects.map(({ name, xml }) => [name, xml]));
  const met = new Set<string>();
  for (let name = pending.pop(); name !== undefined; name = pending.pop()) {
    if (met.has(name)) continue;
    met.add(name);
    pending.push(...links(xmlOf.get(name) ?? ""));
  }
  for (const name of met) omitted.add(name);
  return omitted;
}

/** Whether the members of the object are shown only if it is: those of parts, not of plain groups. */
function isPart(xml: string): boolean {
  return /<Property name="(?:OriginFeatures|Origin)"/.test(xml);
}

/** Whether the object is a body of PartDesign, which alone has a tip. */
function isBody({ xml }: DocumentObject): boolean {
  return xml.includes('<Property name="Tip"');
}

/**
 * Whether the object shows others at other places: a link, a group of links, or a part
 * whose placement is not the identity.
 */
function isContainer(xml: string): boolean {
  if (isBody({ name: "", xml })) return false;
  const isLink =
    xml.includes('<Property name="LinkedObject"') || /<Link\b/.test(property(xml, "ElementList"));
  const placement = /<Property name="(?:Link)?Placement"[\s\S]*?<PropertyPlacement ([^>]*)>/.exec(
    xml,
  );
  if (isLink || !isPart(xml) || placement === null) return isLink;
  const [, attributes = ""] = placement;
  const isZero = ["Px", "Py", "Pz"].every(
    (key) => Number(new RegExp(`${key}="([^"]*)"`).exec(attributes)?.[1] ?? 0) === 0,
  );
  return !isZero || !IDENTITY_PLACEMENT.test(attributes);
}

function links(xml: string): string[] {
  return [...property(xml, "Group").matchAll(/<Link value="([^"]+)"/g)].map(
    ([, name = ""]) => name,
  );
}
