// CAD files. The package's own readers, and the libraries of others, are fetched when the first
// such file comes.
import { type Hausdorff, HausdorffError, type NurbsModel } from "nurbs-hausdorff";

/** Reads a model from a file's bytes; the name is for errors. */
export type FileReader = (bytes: ArrayBuffer, name: string) => Promise<NurbsModel>;

/** The notes shown while a library is fetched. */
const OPENCASCADE = "loading OpenCASCADE (5 MB)…";
const RHINO = "loading rhino3dm (1 MB)…";

let note: (text: string) => void = () => {};

// The package starts the library that a loader stands for only once.
const occt = () => {
  note(OPENCASCADE);
  return import("@bitbybit-dev/occt/bitbybit-dev-occt/nuxt.js");
};
const rhino = () => {
  note(RHINO);
  return import("rhino3dm/rhino3dm.module.js");
};

/** Returns the reader of files, which announces the library that it fetches. */
export function reader(engine: Hausdorff, onLibrary: (text: string) => void): FileReader {
  return async (bytes, name) => {
    note = onLibrary;
    try {
      return await engine.readCad(bytes, { name, occt, rhino });
    } catch (error) {
      if (!(error instanceof TypeError)) throw error;
      // The browser could not fetch the library, for example without a network.
      const message = `the library for this format could not be loaded: ${error.message}`;
      throw new HausdorffError("PEER_MISSING", message, { cause: error });
    }
  };
}
