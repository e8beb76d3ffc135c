// Loading of models from shapes and files.
import { type Hausdorff, HausdorffError, type NurbsModel } from "nurbs-hausdorff";
import { type DisplayModel, SIDES, type Sides, type Source } from "../protocol.ts";
import { type FileReader, reader } from "./cadFiles.ts";
import { outline } from "./outline.ts";

/** Loaded models and what is drawn of them. */
export interface Loaded {
  models: Sides<NurbsModel>;
  display: Sides<DisplayModel>;
}

/**
 * Loads all of the models or, if one is invalid, none. Calls `onLibrary` before
 * a library is fetched that a file needs.
 *
 * @throws {HausdorffError} whose message names the file.
 */
export async function load(
  engine: Hausdorff,
  sources: Sides<Source>,
  onLibrary: (text: string) => void,
): Promise<Loaded> {
  const readFile = reader(engine, onLibrary);
  const models: Sides<NurbsModel> = {};
  const display: Sides<DisplayModel> = {};
  try {
    for (const side of SIDES) {
      const source = sources[side];
      if (source === undefined) continue;
      const model = await createModel(engine, source, readFile);
      models[side] = model;
      const tessellation = model.tessellate();
      display[side] = {
        source,
        faceCount: model.faceCount,
        unit: model.unit,
        report: model.report,
        box: model.boundingBox,
        tessellation,
        outline: outline(tessellation),
      };
    }
  } catch (error) {
    for (const model of Object.values(models)) model.dispose();
    throw error;
  }
  return { models, display };
}

async function createModel(
  engine: Hausdorff,
  source: Source,
  readFile: FileReader,
): Promise<NurbsModel> {
  if ("shape" in source) return engine.shape(source.shape);
  const { file, firstSurface } = source;
  try {
    const bytes = await readBytes(file);
    if (!firstSurface) return await readFile(bytes, file.name);
    return engine.model(withFirstSurface(new TextDecoder().decode(bytes)));
  } catch (error) {
    if (!(error instanceof HausdorffError)) throw error;
    throw new HausdorffError(error.code, `${file.name}: ${error.message}`, { cause: error });
  }
}

/** The model reduced to its first surface. Invalid text is returned unchanged; the engine reports its error. */
function withFirstSurface(json: string): string {
  try {
    const model = JSON.parse(json);
    return JSON.stringify({ ...model, surfaces: model.surfaces.slice(0, 1) });
  } catch {
    return json;
  }
}

async function readBytes(file: File): Promise<ArrayBuffer> {
  try {
    return await file.arrayBuffer();
  } catch (error) {
    // For example a folder, or a file that was moved after it was chosen.
    throw new HausdorffError("FILE_UNREADABLE", `${error}`, { cause: error });
  }
}
