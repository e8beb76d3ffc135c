import { fromOcct, MILLIMETRE } from "../../adapters/occt.js";
import { HausdorffError } from "../../error.js";
import type { BrepText } from "../../model/surface.js";
import type { CadOptions } from "../options.js";
import { type Peer, restart, start } from "./peers.js";

const OCCT: Peer = {
  name: "@bitbybit-dev/occt",
  purpose: "reading by OpenCASCADE",
  option: "occt",
  node: "@bitbybit-dev/occt/bitbybit-dev-occt/node.js",
};

interface Reader {
  ReadFile(path: string): unknown;
  NbRootsForTransfer(): number;
  TransferRoots(progress: unknown): number;
  OneShape(): { IsNull(): boolean; delete(): void };
  delete(): void;
}

interface Occt {
  FS: { writeFile(path: string, bytes: Uint8Array): void; unlink(path: string): void };
  STEPControl_Reader_1?: new () => Reader;
  STEPControl_Reader?: new () => Reader;
  IGESControl_Reader_1?: new () => Reader;
  IGESControl_Reader?: new () => Reader;
  Message_ProgressRange_1?: new () => unknown;
  Message_ProgressRange?: new () => unknown;
}

/**
 * A STEP or IGES file as BREP text, translated by OpenCASCADE, which scales it
 * to millimetres.
 *
 * @throws {HausdorffError} `PEER_MISSING`, `CAD_UNREADABLE`.
 */
export async function translated(
  bytes: Uint8Array,
  kind: "step" | "iges",
  options: CadOptions,
): Promise<BrepText> {
  const oc = (await start(OCCT, options)) as Occt;
  const unreadable = (why: string, cause?: unknown) =>
    new HausdorffError(
      "CAD_UNREADABLE",
      `OpenCASCADE cannot read the ${kind.toUpperCase()} file: ${why}`,
      { cause },
    );
  const Constructor =
    kind === "step"
      ? (oc.STEPControl_Reader_1 ?? oc.STEPControl_Reader)
      : (oc.IGESControl_Reader_1 ?? oc.IGESControl_Reader);
  const Progress = oc.Message_ProgressRange_1 ?? oc.Message_ProgressRange;
  if (!Constructor || !Progress) {
    throw new HausdorffError(
      "PEER_MISSING",
      `this OpenCASCADE module reads no ${kind.toUpperCase()}: ${OCCT.name} does (npm install ${OCCT.name})`,
    );
  }
  const path = `/nurbs-hausdorff.${kind}`;
  try {
    oc.FS.writeFile(path, bytes);
    const reader = new Constructor();
    reader.ReadFile(path);
    oc.FS.unlink(path);
    if (reader.NbRootsForTransfer() === 0) throw unreadable("it has no shape");
    reader.TransferRoots(new Progress());
    const shape = reader.OneShape();
    if (shape.IsNull())
      throw unreadable("no shape can be translated; an assembly may only refer to files of parts");
    const text = fromOcct(oc, shape, { unit: MILLIMETRE });
    shape.delete();
    reader.delete();
    return text;
  } catch (error) {
    if (error instanceof HausdorffError) throw error;
    // C++ exceptions come as addresses, and may leave the module in disorder.
    restart(OCCT, options);
    throw unreadable(error instanceof Error ? error.message : "it threw an exception", error);
  }
}

const FACES: Readonly<Record<"step" | "iges", RegExp>> = {
  step: /=\s*(?:ADVANCED_FACE|FACE_SURFACE)\s*\(/g,
  // A directory entry of a trimmed surface, of a bounded surface or of a face of a
  // solid: the first of its two lines, which alone has a pointer to parameters.
  iges: /^ {5}(?:144|143|510).{64}D *\d*[13579]\r?$/gm,
};

/** Number of trimmed faces that the file's text declares. */
export function declaredFaces(bytes: Uint8Array, kind: "step" | "iges"): number {
  const text = new TextDecoder("latin1").decode(bytes);
  return text.match(FACES[kind])?.length ?? 0;
}
