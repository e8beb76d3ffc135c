// CAD files, and the notes while a library is fetched that one of them needs.

import type { FaceDraft } from "nurbs-hausdorff/cad";
import type { Hausdorff, NurbsModel } from "nurbs-hausdorff/worker";
import { texts } from "../../texts/index.ts";

/** Reads a model from a file's bytes; the name is for errors, the unit for a file that states none. */
export type FileReader = (
  bytes: ArrayBuffer,
  { name, unit }: { name: string; unit: number | undefined },
  onFace: (face: FaceDraft) => void,
) => Promise<NurbsModel>;

const NOTES = {
  occt: texts.files.loadingOpenCascade,
  rhino: texts.files.loadingRhino,
};

/** Returns the reader of files, which announces the library that it fetches. */
export function reader(engine: Hausdorff, onLibrary: (text: string) => void): FileReader {
  return (bytes, { name, unit }, onFace) =>
    engine.readCad(bytes, {
      ...{ name, onLibrary: (library) => onLibrary(NOTES[library]), onFace },
      ...(unit !== undefined && { unit }),
    });
}
