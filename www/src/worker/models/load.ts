// Loading of models from shapes and files.

import { meshFormatOf } from "nurbs-hausdorff/cad";
import { type Hausdorff, HausdorffError, type NurbsModel } from "nurbs-hausdorff/worker";
import { boundsOf } from "../../common/bounds.ts";
import { example } from "../../examples/index.ts";
import { texts } from "../../texts/index.ts";
import { faceName } from "../probe.ts";
import {
  type DisplayModel,
  type Draft,
  SIDES,
  type Side,
  type Sides,
  type Source,
} from "../protocol.ts";
import { reader } from "./cadFiles.ts";
import { Drafts } from "./drafts.ts";
import { isMesh, noted, notedCloud } from "./meshes.ts";
import { outline } from "./outline.ts";

/** Loaded models and what is drawn of them. */
export interface Loaded {
  models: Sides<NurbsModel>;
  display: Sides<DisplayModel>;
}

/** What is told while models are loaded. */
export interface LoadListener {
  /** A library is fetched that a file needs. */
  onLibrary: (text: string) => void;
  /** Faces of a file were read. */
  onDraft: (side: Side, draft: Draft) => void;
}

/**
 * Loads all of the models or, if one is invalid, none.
 *
 * @throws {HausdorffError} whose message names the file.
 */
export async function load(
  engine: Hausdorff,
  sources: Sides<Source>,
  { onLibrary, onDraft }: LoadListener,
): Promise<Loaded> {
  const readFile = reader(engine, onLibrary);
  const models: Sides<NurbsModel> = {};
  const display: Sides<DisplayModel> = {};
  const drawn: Promise<void>[] = [];
  try {
    for (const side of SIDES) {
      const source = sources[side];
      if (source === undefined) continue;
      const drafts = new Drafts((draft) => onDraft(side, draft));
      const model = await createModel(engine, source, (bytes, name, unit) =>
        readFile(bytes, { name, unit }, (face) => drafts.add(face)),
      );
      models[side] = model;
      // The engine reads the next file while this one is outlined.
      drawn.push(
        displayOf(source, model).then((one) => {
          display[side] = one;
        }),
      );
    }
    await Promise.all(drawn);
  } catch (error) {
    await Promise.allSettled(drawn);
    for (const model of Object.values(models)) model.dispose();
    throw error;
  }
  return { models, display };
}

async function displayOf(source: Source, model: NurbsModel): Promise<DisplayModel> {
  const tessellation = await model.tessellate();
  const bounds = boundsOf(tessellation.positions);
  if (isMesh(model) && tessellation.indices.length === 0) notedCloud(model);
  return {
    source,
    faceCount: model.faceCount,
    unit: model.unit,
    report: model.report,
    box: model.boundingBox,
    tessellation,
    bounds,
    outline: outline(tessellation, bounds, isMesh(model)),
    isMesh: isMesh(model),
    faceNames: Array.from({ length: model.faceCount }, (_, face) => listedName(model, face)),
    faceColors: colorsOf(model),
    faceForms: await model.faceForms(),
  };
}

/** A face by its name; the groups of a mesh and the points of a scan are no faces. */
function listedName(model: NurbsModel, face: number): string {
  if (!isMesh(model)) return faceName(model, face);
  return (
    model.faceName(face) ?? (model.faceCount === 1 ? texts.files.allOfIt : texts.files.group(face))
  );
}

/** The colours of the faces; none at all if no face has one. */
function colorsOf(model: NurbsModel): DisplayModel["faceColors"] {
  const colors = Array.from({ length: model.faceCount }, (_, face) => model.faceColor(face));
  return colors.some((color) => color !== null) ? colors : [];
}

/** A file's name without the ending of its packing. */
const unpackedName = ({ name }: File): string =>
  name.toLowerCase().endsWith(PACKED) ? name.slice(0, -PACKED.length) : name;

/** The ending of gzipped files, which CAD readers unpack themselves. */
const PACKED = ".gz";

function unpacked(file: File): Promise<ArrayBuffer> {
  const stream = file.stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

async function createModel(
  engine: Hausdorff,
  source: Source,
  readFile: (bytes: ArrayBuffer, name: string, unit?: number) => Promise<NurbsModel>,
): Promise<NurbsModel> {
  if ("shape" in source) {
    const own = example(source.shape);
    return own === undefined ? engine.shape(source.shape) : engine.model(own);
  }
  const { file, firstSurface, unit } = source;
  try {
    const bytes = await readBytes(file);
    const name = unpackedName(file);
    const mesh = meshFormatOf(name);
    if (mesh !== undefined) {
      const content = name === file.name ? bytes : await unpacked(file);
      return noted(await engine.readMesh(content, mesh, unit === undefined ? {} : { unit }));
    }
    if (!firstSurface) {
      return await readFile(bytes, file.name, unit).catch((error) => stepMesh(engine, file, error));
    }
    return engine.model(withFirstSurface(new TextDecoder().decode(bytes)));
  } catch (error) {
    if (!(error instanceof HausdorffError)) throw error;
    throw new HausdorffError(error.code, `${file.name}: ${error.message}`, { cause: error });
  }
}

/** The mesh of a STEP file of triangles alone, which is how reading it as a CAD model failed. */
async function stepMesh(engine: Hausdorff, file: File, error: unknown): Promise<NurbsModel> {
  if (!(error instanceof HausdorffError && error.code === "STEP_TRIANGLES")) throw error;
  const isPacked = unpackedName(file) !== file.name;
  // The bytes went to the engine with the first call.
  return noted(
    await engine.readMesh(isPacked ? await unpacked(file) : await readBytes(file), "step"),
  );
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
