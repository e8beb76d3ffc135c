import { HausdorffError } from "../../error.js";
import { entryBytes, type ZipEntry, zipEntries } from "../archive/zip.js";
import { unsupported } from "../kind.js";
import type { SkippedFace } from "../report.js";

const PLACED = "its parts are placed by a container: export the document as STEP";
const BINARY = "its shape is stored in binary: export the document as STEP";

/** A shape of a FreeCAD document. */
export interface DocumentShape {
  name: string;
  /** Its BREP text. */
  brep: Uint8Array;
}

/** The shapes of a document, and what of it is not read. */
export interface DocumentShapes {
  shapes: DocumentShape[];
  skipped: SkippedFace[];
}

/** An object of a document's XML. */
interface DocumentObject {
  name: string;
  xml: string;
}

const IDENTITY_PLACEMENT = /Q0="0(?:\.0+)?" Q1="0(?:\.0+)?" Q2="0(?:\.0+)?"/;

/**
 * The visible shapes of a FreeCAD document. A body's features are left out, as
 * the body's own shape is that of the last.
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
  const hidden = hiddenObjects(await text("GuiDocument.xml"));
  const members = new Set(objects.filter(isBody).flatMap(({ xml }) => links(xml)));
  const shapes: DocumentShape[] = [];
  const skipped: SkippedFace[] = [];
  for (const { name, xml } of objects) {
    if (hidden.has(name) || members.has(name)) continue;
    const file = /<Part\b[^>]*\bfile="([^"]+)"/.exec(xml)?.[1];
    const why = isContainer(xml) ? PLACED : file?.endsWith(".bin") ? BINARY : undefined;
    if (why !== undefined) skipped.push({ face: name, code: "FORMAT_UNSUPPORTED", why });
    else if (file !== undefined) shapes.push({ name, brep: await bytesOf(file) });
  }
  if (shapes.length === 0) {
    const left = skipped.map(({ face, why }) => `; ${face}: ${why}`).join("");
    throw new HausdorffError("EMPTY_MODEL", `the FreeCAD document has no visible shape${left}`);
  }
  return { shapes, skipped };
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

function hiddenObjects(gui: string): Set<string> {
  const isHidden = ({ xml }: DocumentObject) =>
    /<Property name="Visibility"[^>]*>\s*<Bool value="false"/.test(xml);
  return new Set(
    elements(gui, "ViewProvider")
      .filter(isHidden)
      .map(({ name }) => name),
  );
}

/** Whether the object is a body of PartDesign, which alone has a tip. */
function isBody({ xml }: DocumentObject): boolean {
  return xml.includes('<Property name="Tip"');
}

/** Whether the object moves others: a part or a link whose placement is not the identity. */
function isContainer(xml: string): boolean {
  const moves = /<Property name="(?:LinkedObject|OriginFeatures|Origin)"/.test(xml);
  const placement = /<Property name="(?:Link)?Placement"[\s\S]*?<PropertyPlacement ([^>]*)>/.exec(
    xml,
  );
  if (!moves || isBody({ name: "", xml }) || placement === null) return false;
  const [, attributes = ""] = placement;
  const isZero = ["Px", "Py", "Pz"].every(
    (key) => Number(new RegExp(`${key}="([^"]*)"`).exec(attributes)?.[1] ?? 0) === 0,
  );
  return xml.includes('name="LinkedObject"') || !isZero || !IDENTITY_PLACEMENT.test(attributes);
}

function links(xml: string): string[] {
  const group = /<Property name="Group"[\s\S]*?<\/Property>/.exec(xml)?.[0] ?? "";
  return [...group.matchAll(/<Link value="([^"]+)"/g)].map(([, name = ""]) => name);
}
