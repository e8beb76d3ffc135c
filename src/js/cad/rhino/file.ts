import { type ErrorCode, HausdorffError } from "../../error.js";
import type {
  InterchangeInstance,
  InterchangeModel,
  InterchangeSurface,
} from "../../model/surface.js";
import type { CadReport, SkippedFace } from "../report.js";
import { brepFaces, type RhinoFaces } from "./faces.js";
import { nurbsForm, nurbsOf } from "./surface.js";
import type {
  Rhino,
  RhinoBrep,
  RhinoExtrusion,
  RhinoFile,
  RhinoInstanceReference,
  RhinoSurface,
} from "./types.js";
import { unitInMetres } from "./units.js";

/** A row-major 3x4 matrix. */
type Matrix = readonly number[];

const IDENTITY: Matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/** A limit on nested blocks, against definitions that contain themselves. */
const MAX_DEPTH = 32;

/** An object's faces, or the block that it places. */
interface Placed {
  name: string;
  id: string;
  inBlock: boolean;
  surfaces: number[];
  reference: { definition: string; transform: Matrix } | null;
}

/**
 * The model of a 3DM file's surfaces, B-reps, extrusions and blocks.
 *
 * @throws {HausdorffError} `CAD_UNREADABLE`, `EMPTY_MODEL`.
 */
export function rhinoModel(
  rhino: Rhino,
  bytes: Uint8Array,
  name: string | undefined,
): { model: InterchangeModel; report: CadReport } {
  const file = rhino.File3dm.fromByteArray(bytes);
  if (file === null) throw new HausdorffError("CAD_UNREADABLE", "rhino3dm cannot read the file");
  const faces: InterchangeSurface[] = [];
  const skipped: SkippedFace[] = [];
  const counts = { trims: 0, fitted: 0, gap: 0 };
  const placed = objectsOf(rhino, file).map(({ geometry, type, ...object }, number): Placed => {
    const read = facesOf(geometry, type, object.name);
    const surfaces = read.faces.map((_, index) => faces.length + index);
    // The faces of an object are joined with each other first, and no object is a void of another one.
    faces.push(...read.faces.map((face) => ({ ...face, shell: number, solid: number })));
    skipped.push(...read.skipped);
    counts.trims += read.trims;
    counts.fitted += read.fitted;
    counts.gap = Math.max(counts.gap, read.gap);
    return {
      ...object,
      surfaces,
      reference: type === "InstanceReference" ? block(geometry) : null,
    };
  });
  if (faces.length === 0) {
    const left = skipped.length > 0 ? `; ${skipped[0]?.face}: ${skipped[0]?.why}` : "";
    throw new HausdorffError("EMPTY_MODEL", `the 3DM file has no surface that is read${left}`);
  }
  const unit = unitInMetres(rhino, file.settings().modelUnitSystem);
  const instances = placements(file, placed);
  const model: InterchangeModel = {
    ...(name === undefined ? {} : { name }),
    ...(unit === null ? {} : { unit }),
    surfaces: faces,
    ...(instances === null ? {} : { instances }),
  };
  const { trims, fitted, gap } = counts;
  return {
    model,
    report: {
      kind: "3dm",
      reader: "rhino3dm",
      faces: faces.length,
      trims,
      exact: trims - fitted,
      fitted,
      gap,
      // The gaps are the tolerances of the file, and deviations at points.
      gapProven: gap === 0,
      unit,
      skipped,
      notes: [],
    },
  };
}

function objectsOf(rhino: Rhino, file: RhinoFile) {
  const objects = file.objects();
  return Array.from({ length: objects.count }, (_, index) => {
    const object = objects.get(index);
    const attributes = object.attributes();
    const geometry = object.geometry();
    const { objectType } = (geometry ?? {}) as { objectType?: unknown };
    return {
      name: attributes.name || `object ${index}`,
      id: attributes.id.toLowerCase(),
      inBlock: attributes.isInstanceDefinitionObject,
      geometry,
      type: Object.keys(rhino.ObjectType).find((key) => rhino.ObjectType[key] === objectType) ?? "",
    };
  });
}

const NOTHING: RhinoFaces = { faces: [], trims: 0, fitted: 0, gap: 0, skipped: [] };

/** The faces of an object; curves, points and annotations have none. */
function facesOf(geometry: object | null, type: string, name: string): RhinoFaces {
  const skip = (code: ErrorCode, why: string): RhinoFaces => ({
    ...NOTHING,
    skipped: [{ face: name, code, why }],
  });
  try {
    if (type === "Brep") return brepFaces(geometry as RhinoBrep, name);
    if (type === "Extrusion") {
      const brep = (geometry as RhinoExtrusion).toBrep(false);
      return brep === null
        ? skip("CAD_UNREADABLE", "rhino3dm makes no B-rep of the extrusion")
        : brepFaces(brep, name);
    }
    if (type === "Surface") {
      return {
        ...NOTHING,
        faces: [{ ...nurbsForm(nurbsOf(geometry as RhinoSurface)), part: name }],
      };
    }
  } catch (error) {
    if (error instanceof HausdorffError) return skip(error.code, error.message);
    throw error;
  }
  if (type === "Mesh") return skip("FORMAT_UNSUPPORTED", "it is a mesh of triangles, not NURBS");
  if (type === "SubD") {
    const why = "it is a subdivision surface: convert it to NURBS in Rhino";
    return skip("FORMAT_UNSUPPORTED", why);
  }
  return NOTHING;
}

function block(geometry: object | null): Placed["reference"] {
  const { parentIdefId, xform } = geometry as RhinoInstanceReference;
  const transform = [0, 1, 2].flatMap((row) =>
    [0, 1, 2, 3].map((column) => Number(xform[`m${row}${column}`])),
  );
  return { definition: parentIdefId, transform };
}

/** The placements of all faces, or null where each lies where it is. */
function placements(file: RhinoFile, placed: readonly Placed[]): InterchangeInstance[] | null {
  if (!placed.some(({ reference, inBlock }) => reference !== null || inBlock)) return null;
  const byId = new Map(placed.map((object) => [object.id, object]));
  const instances: InterchangeInstance[] = [];
  const place = (object: Placed, transform: Matrix, depth: number): void => {
    if (depth > MAX_DEPTH) {
      throw new HausdorffError("CAD_UNREADABLE", `${object.name}: blocks are nested too deep`);
    }
    if (object.surfaces.length > 0) {
      instances.push({ surfaces: object.surfaces, transform, name: object.name });
    }
    if (object.reference === null) return;
    const { definition, transform: own } = object.reference;
    const ids = file.instanceDefinitions().findId(definition)?.getObjectIds() ?? [];
    for (const id of Array.from(ids as ArrayLike<string>)) {
      const member = byId.get(id.toLowerCase());
      if (member) place(member, product(transform, own), depth + 1);
    }
  };
  for (const object of placed) if (!object.inBlock) place(object, IDENTITY, 0);
  return instances;
}

/** The map that applies `b`, then `a`. */
function product(a: Matrix, b: Matrix): Matrix {
  const entry = (matrix: Matrix, row: number, column: number) => matrix[4 * row + column] ?? 0;
  return IDENTITY.map((_, index) => {
    const [row, column] = [Math.floor(index / 4), index % 4];
    const sum = [0, 1, 2].reduce((sum, k) => sum + entry(a, row, k) * entry(b, k, column), 0);
    return column === 3 ? sum + entry(a, row, 3) : sum;
  });
}
