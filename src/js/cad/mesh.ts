import { HausdorffError, translating } from "../error.js";
import { checkKeys } from "../keys.js";
import { load, loadModule } from "../load.js";
import { requireGoing } from "../measure/cancelled.js";
import { NurbsModel } from "../model/model.js";
import { PreparedModel } from "../wasm/nurbs_hausdorff.js";
import initMeshes, {
  type ReadMesh,
  readMesh as readTriangles,
} from "../wasm/nurbs_hausdorff_meshes.js";
import initReaders, {
  readStepTriangles,
  type StepTriangles,
} from "../wasm/nurbs_hausdorff_readers.js";
import initScans, { type ReadMesh as ReadPoints, readScan } from "../wasm/nurbs_hausdorff_scans.js";
import { head, kindOfText } from "./kind.js";
import type { CadReport, FaceNote, SkippedFace } from "./report.js";

/** A format of meshes or clouds of points: the ending of its files' names. */
export type MeshFormat =
  | "stl"
  | "ply"
  | "obj"
  | "off"
  | "vtk"
  | "vtp"
  | "gltf"
  | "glb"
  | "3mf"
  | "xyz"
  | "xyzn"
  | "pts"
  | "csv"
  | "asc"
  | "txt"
  | "pcd"
  | "ptx"
  | "las"
  | "laz"
  | "e57"
  | "stp"
  | "step";

/** Formats of a module of their own. */
const SCANS: readonly MeshFormat[] = ["las", "laz", "e57"];

/** STEP, which is a mesh only where it has triangles and no faces: `readCad` reads the others. */
const STEP: readonly MeshFormat[] = ["stp", "step"];

/** The formats that hold nothing but meshes or points. */
const FORMATS: readonly MeshFormat[] = [
  ...(["stl", "ply", "obj", "off", "vtk", "vtp", "gltf", "glb", "3mf"] as const),
  ...(["xyz", "xyzn", "pts", "csv", "asc", "txt", "pcd", "ptx"] as const),
  ...SCANS,
];

/** Options of `readMesh`. */
export interface MeshOptions {
  /** Metres per unit of the file's coordinates, where the file does not state it. */
  unit?: number;
  /**
   * The contents of other files that a glTF consists of, as its `.bin`, by their paths from the glTF's
   * folder, as it states them.
   */
  resources?: Readonly<Record<string, Uint8Array | ArrayBuffer>>;
  /**
   * Cancels the reading, before it begins or between its steps: the promise rejects with code
   * `CANCELLED`. A worker's rejects at once.
   */
  signal?: AbortSignal;
}

/**
 * The format of a file by the ending of its name, in any case; undefined for others, and for STEP, whose files
 * are most often CAD models.
 */
export function meshFormatOf(name: string): MeshFormat | undefined {
  const ending = name.slice(name.lastIndexOf(".") + 1).toLowerCase();
  return FORMATS.find((format) => format === ending);
}

/**
 * Reads a mesh of triangles, or a cloud of points: STL, PLY, OFF and VTK's surfaces (clouds if they
 * have no faces), OBJ, glTF with its buffers embedded or in `resources`, GLB, 3MF, points as text, PCD,
 * PTX, STEP of triangles alone, or a scan: LAS, LAZ or E57. Where the content has a signature, it decides
 * rather than `format`. Scenes are placed, polygons cut in their plane, whose distance is the model's
 * `gap`, and equal vertices joined. glTF, 3MF, STEP and E57 state their unit, LAS where it has a
 * coordinate reference system with one, text where the names of its columns do. The model's `report`
 * says what was left out, and what was decided.
 *
 * @throws {HausdorffError} `CANCELLED`, `MESH_SYNTAX`, `STEP_SYNTAX`, `STEP_UNREADABLE` for a STEP file with
 * faces, `FILE_TOO_LARGE`, `MODULE_FAILED`, and the errors of `Hausdorff.mesh`.
 */
export async function readMesh(
  bytes: Uint8Array | ArrayBuffer,
  format: MeshFormat,
  options: MeshOptions = {},
): Promise<NurbsModel> {
  checkKeys("options", options, ["unit", "resources", "signal"]);
  const { signal, resources = {} } = options;
  requireGoing(signal);
  const known = [...FORMATS, ...STEP];
  if (!known.includes(format)) {
    const expected = known.join(", ");
    throw new HausdorffError("ARGUMENT_INVALID", `format is ${format}, expected ${expected}`);
  }
  const content = asBytes(bytes);
  await load();
  const isStep = STEP.includes(format) || kindOfText(head(content, HEADER_LENGTH)) === "step";
  const read = isStep ? await stepReader() : await reader(format, resources);
  requireGoing(signal);
  return translating(() => {
    const mesh = read(content);
    try {
      const unit = mesh.unit ?? options.unit;
      const { positions, triangles, groupCounts, groupNames, gap } = mesh;
      const [counts, names] = triangles ? [groupCounts, groupNames] : [];
      const prepared = PreparedModel.fromFacets(positions, triangles, unit, counts, names, gap);
      return NurbsModel.of(prepared, reportOf(mesh, unit), { positions, triangles, counts });
    } finally {
      mesh.free();
    }
  });
}

/** Bytes in which the signature of a STEP file is searched. */
const HEADER_LENGTH = 1 << 14;

/** What a module read of a mesh or of points. */
type Read = ReadMesh | ReadPoints | StepTriangles;

type Reader = (bytes: Uint8Array) => Read;

/** Loads what reads a format. */
async function reader(
  format: MeshFormat,
  resources: NonNullable<MeshOptions["resources"]>,
): Promise<Reader> {
  if (SCANS.includes(format)) {
    await loadModule("nurbs_hausdorff_scans", initScans);
    return (bytes) => readScan(bytes, format);
  }
  await loadModule("nurbs_hausdorff_meshes", initMeshes);
  const contents = Object.values(resources).map(asBytes);
  return (bytes) => readTriangles(bytes, format, Object.keys(resources), contents);
}

/** Loads what reads the triangles of STEP files. */
async function stepReader(): Promise<Reader> {
  await loadModule("nurbs_hausdorff_readers", initReaders);
  return readStepTriangles;
}

/** The report on a mesh or on points, which are one face. */
function reportOf(mesh: Read, unit: number | undefined): CadReport {
  const { notes, skipped } = mesh.account as { notes: FaceNote[]; skipped: SkippedFace[] };
  const counts = { faces: 1, trims: 0, exact: 0, fitted: 0 };
  const accuracy = { gap: mesh.gap, gapProven: true, unit: unit ?? null };
  return { kind: "mesh", reader: "built-in", ...counts, ...accuracy, skipped, notes };
}

function asBytes(bytes: Uint8Array | ArrayBuffer): Uint8Array {
  return bytes instanceof Uint8Array ? bytes : new Uint8Array(bytes);
}
