// Models from shapes and files, with what there is to show of them.
import { type Hausdorff, HausdorffError, type NurbsModel } from "nurbs-hausdorff";
import { outline } from "./outline.ts";
import { type Shown, SIDES, type Sides, type Source } from "./protocol.ts";

/** What `load` gives. */
export interface Loaded {
  models: Sides<NurbsModel>;
  shown: Sides<Shown>;
}

/**
 * All of the models or, if one is invalid, none.
 *
 * @throws {HausdorffError} that names the file.
 */
export async function load(engine: Hausdorff, sources: Sides<Source>): Promise<Loaded> {
  const models: Sides<NurbsModel> = {};
  const shown: Sides<Shown> = {};
  try {
    for (const side of SIDES) {
      const source = sources[side];
      if (source === undefined) continue;
      const model = await made(engine, source);
      models[side] = model;
      const tessellation = model.tessellate();
      shown[side] = {
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
  return { models, shown };
}

async function made(engine: Hausdorff, source: Source): Promise<NurbsModel> {
  if ("shape" in source) return engine.shape(source.shape);
  const { file, firstSurface } = source;
  try {
    const json = await text(file);
    return engine.model(firstSurface ? withFirstSurface(json) : json);
  } catch (error) {
    if (!(error instanceof HausdorffError)) throw error;
    throw new HausdorffError(error.code, `${file.name}: ${error.message}`, { cause: error });
  }
}

/** The model's first surface alone; what is not a model stays as it is, to be refused for what it is. */
function withFirstSurface(json: string): string {
  try {
    const model = JSON.parse(json);
    return JSON.stringify({ ...model, surfaces: model.surfaces.slice(0, 1) });
  } catch {
    return json;
  }
}

async function text(file: File): Promise<string> {
  try {
    return await file.text();
  } catch (error) {
    // A folder, for one, or a file that was moved since it was chosen.
    throw new HausdorffError("FILE_UNREADABLE", `${error}`, { cause: error });
  }
}
