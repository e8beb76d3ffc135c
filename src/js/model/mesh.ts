import { HausdorffError } from "../error.js";
import { checkKeys } from "../keys.js";
import { coordinatesOf, type Numbers } from "./surface.js";

/** A mesh of triangles, or without `triangles` a cloud of points. */
export interface MeshArrays {
  /** x, y, z of every vertex or point. Vertices of equal coordinates are joined. */
  positions: Numbers;
  /** The indices of the corners, three a triangle. */
  triangles?: Uint32Array | Uint16Array | Uint8Array | readonly number[];
  /** Metres per unit of the positions, if known. */
  unit?: number;
  /**
   * The faces of the mesh: groups of triangles that follow each other, all triangles together. A
   * mesh without groups is one face.
   */
  groups?: readonly MeshGroup[];
}

/** Triangles that follow each other, a face of their mesh. */
export interface MeshGroup {
  /** The name of the face. */
  name?: string;
  /** The number of triangles, at least 1. */
  triangles: number;
}

/** The largest index that the module's 32 bits take. */
const MAX_INDEX = 2 ** 32 - 1;

/**
 * The arrays as the module takes them.
 * @internal
 */
export function facetArrays(
  input: MeshArrays,
): [
  positions: Float64Array,
  triangles: Uint32Array | undefined,
  unit: number | undefined,
  counts: Uint32Array | undefined,
  names: string[] | undefined,
] {
  checkKeys("the mesh", input, ["positions", "triangles", "unit", "groups"]);
  const { positions, triangles, unit, groups } = input;
  for (const group of groups ?? []) checkKeys("a group", group, ["name", "triangles"]);
  return [
    coordinatesOf(positions),
    triangles === undefined ? undefined : indicesOf(triangles),
    unit,
    groups && indicesOf(groups.map(({ triangles }) => triangles)),
    groups?.map(({ name }) => name ?? ""),
  ];
}

function indicesOf(triangles: NonNullable<MeshArrays["triangles"]>): Uint32Array {
  if (triangles instanceof Uint32Array) return triangles;
  if (triangles instanceof Uint16Array || triangles instanceof Uint8Array) {
    return Uint32Array.from(triangles);
  }
  if (!Array.isArray(triangles)) {
    throw new HausdorffError("ARGUMENT_INVALID", "triangles is no array of indices");
  }
  const wrong = triangles.findIndex(
    (index) => !Number.isInteger(index) || index < 0 || index > MAX_INDEX,
  );
  if (wrong >= 0) {
    const found = `triangles[${wrong}] is ${triangles[wrong]}`;
    throw new HausdorffError("ARGUMENT_INVALID", `${found}, expected an index`);
  }
  return Uint32Array.from(triangles);
}
