// Loading of models from shapes and files.
import { type Hausdorff, HausdorffError, type NurbsModel } from "nurbs-hausdorff";
import { outline } from "./outline.ts";
import { type DisplayModel, SIDES, type Sides, type Source } from "./protocol.ts";

/** Loaded models and what is drawn of them. */
export interface Loaded {
  models: Sides<NurbsModel>;
  display: Sides<DisplayModel>;
}

/**
 * Loads all of the models or, if one is invalid, none.
 *
 * @throws {HausdorffError} whose message names the file.
 */
export async function load(engine: Hausdorff, sources: Sides<Source>): Promise<Loaded> {
  const models: Sides<NurbsModel> = {};
  const display: Sides<DisplayModel> = {};
  try {
    for (const side of SIDES) {
      const source = sources[side];
      if (source === undefined) continue;
      const model = await createModel(engine, source);
      models[side] = model;
      const tessellation = model.tessellate();
      display[side] = {
        source,
        surfaceCount: model.surfaceCount,
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

async function createModel(engine: Hausdorff, source: Source): Promise<NurbsModel> {
  if ("shape" in source) return engine.shape(source.shape);
  const { file, firstSurface } = source;
  try {
    const json = await readText(file);
    return engine.model(firstSurface ? withFirstSurface(json) : json);
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

async function readText(file: File): Promise<string> {
  try {
    return await file.text();
  } catch (error) {
    // For example a folder, or a file that was moved after it was chosen.
    throw new HausdorffError("FILE_UNREADABLE", `${error}`, { cause: error });
  }
}
