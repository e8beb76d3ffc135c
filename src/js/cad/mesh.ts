import { HausdorffError, translating } from "../error.js";
import { checkKeys } from "../keys.js";
import { load, loadModule } from "../load.js";
import { requireGoing } from "../measure/cancelled.js";
import { NurbsModel } from "../model/model.js";
import { PreparedModel } from "../wasm/nurbs_hausdorff.js";
import initMeshes, { readMesh as readTriangles } from "../wasm/nurbs_hausdorff_meshes.js";
import initScans, { readScan } from "../wasm/nurbs_hausdorff_scans.js";

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
  | "e57";

/** Formats of a module of their own. */
const SCANS: readonly MeshFormat[] = ["las", "laz", "e57"];

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
   * Cancels the reading, before it begins or between its steps: the promise rejects with code
   * `CANCELLED`. A worker's rejects at once.
   */
  signal?: AbortSignal;
}

/** The format of a file by the ending of its name, in any case; undefined for others. */
export function meshFormatOf(name: string): MeshFormat | undefined {
  const ending = name.slice(name.lastIndexOf(".") + 1).toLowerCase();
  return FORMATS.find((format) => format === ending);
}

/**
 * Reads a mesh of triangles, or a cloud of points: STL, PLY, OFF and VTK's surfaces (clouds if they
 * have no faces), OBJ, glTF with embedded buffers, GLB, 3MF, points as text, PCD, PTX, or a scan:
 * LAS, LAZ or E57. Where the content has a signature, it decides rather than `format`. Scenes are
 * placed, polygons cut in their plane, whose distance is the model's `gap`, and equal vertices
 * joined. glTF, 3MF and E57 state their unit, LAS where it has a coordinate reference system with
 * one, text where the names of its columns do.
 *
 * @throws {HausdorffError} `CANCELLED`, `MESH_SYNTAX`, `FILE_TOO_LARGE`, `MODULE_FAILED`, and the errors of
 * `Hausdorff.mesh`.
 */
export async function readMesh(
  bytes: Uint8Array | ArrayBuffer,
  format: MeshFormat,
  options: MeshOptions = {},
): Promise<NurbsModel> {
  checkKeys("options", options, ["unit", "signal"]);
  const { signal } = options;
  requireGoing(signal);
  if (!FORMATS.includes(format)) {
    const expected = FORMATS.join(", ");
    throw new HausdorffError("ARGUMENT_INVALID", `format is ${format}, expected ${expected}`);
  }
  const content = bytes instanceof Uint8Array ? bytes : new Uint8Array(bytes);
  await load();
  const read = await reader(format);
  requireGoing(signal);
  return translating(() => {
    const mesh = read(content, format);
    try {
      const unit = mesh.unit ?? options.unit;
      const { positions, triangles, groupCounts, groupNames, gap } = mesh;
      const [counts, names] = triangles ? [groupCounts, groupNames] : [];
      const prepared = PreparedModel.fromFacets(positions, triangles, unit, counts, names, gap);
      return NurbsModel.of(prepared, null, { positions, triangles });
    } finally {
      mesh.free();
    }
  });
}

/** Loads what reads a format. */
async function reader(format: MeshFormat): Promise<typeof readTriangles> {
  if (SCANS.includes(format)) {
    await loadModule("nurbs_hausdorff_scans", initScans);
    return readScan;
  }
  await loadModule("nurbs_hausdorff_meshes", initMeshes);
  return readTriangles;
}
