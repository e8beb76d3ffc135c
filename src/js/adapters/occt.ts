import { HausdorffError } from "../error.js";
import type { BrepText } from "../model/surface.js";

/** A file of the module's in-memory file system. */
const FILE = "/nurbs-hausdorff.brep";

/** Metres per unit of the shapes of OpenCASCADE's readers and of most who model with it. */
export const MILLIMETRE = 0.001;

type Write = (shape: unknown, ...rest: unknown[]) => unknown;

/** The parts of an OpenCASCADE module that write a shape; builds have one or another. */
interface Writers {
  BRepToolsWrapper?: { Write?: Write };
  BRepTools?: { Write_3?: Write; Write?: Write };
  Message_ProgressRange_1?: new () => unknown;
  Message_ProgressRange?: new () => unknown;
  FS?: {
    readFile(path: string, options: { encoding: "utf8" }): string;
    unlink(path: string): void;
  };
}

/**
 * A shape of opencascade.js, replicad or bitbybit, as BREP text, which is exact.
 * For `hd.readCad`.
 *
 * @param oc the started OpenCASCADE module.
 * @param shape a `TopoDS_Shape` of it.
 * @param unit metres per unit of the shape; default a millimetre.
 * @throws {HausdorffError} `ARGUMENT_INVALID` if the module has no function that
 * writes BREP text, or it fails on the shape.
 */
export function fromOcct(oc: object, shape: object, { unit = MILLIMETRE } = {}): BrepText {
  return { brep: brepText(oc, shape), unit };
}

function brepText(oc: object, shape: object): string {
  const { BRepToolsWrapper, BRepTools, FS, ...module } = oc as Writers;
  const failed = (why: string, cause?: unknown) =>
    new HausdorffError("ARGUMENT_INVALID", `the shape cannot be written: ${why}`, { cause });
  try {
    if (BRepToolsWrapper?.Write) return String(BRepToolsWrapper.Write(shape));
    const write = BRepTools?.Write_3 ?? BRepTools?.Write;
    if (!write || !FS) {
      throw failed("the OpenCASCADE module has neither BRepToolsWrapper.Write nor BRepTools.Write");
    }
    const Progress = module.Message_ProgressRange_1 ?? module.Message_ProgressRange;
    const done = Progress ? write(shape, FILE, new Progress()) : write(shape, FILE);
    if (done === false) throw failed("BRepTools.Write fails");
    const text = FS.readFile(FILE, { encoding: "utf8" });
    FS.unlink(FILE);
    return text;
  } catch (error) {
    if (error instanceof HausdorffError) throw error;
    // The module throws addresses of C++ exceptions.
    throw failed(error instanceof Error ? error.message : "OpenCASCADE threw an exception", error);
  }
}
