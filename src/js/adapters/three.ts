import { HausdorffError } from "../error.js";
import type { MeshArrays } from "../model/mesh.js";
import type { ControlPoint, InterchangeModel } from "../model/surface.js";

/** The parts of three's `NURBSSurface` that are used. */
export interface ThreeNurbsSurface {
  degree1: number;
  degree2: number;
  knots1: readonly number[];
  knots2: readonly number[];
  /** `controlPoints[i][j]`, i along the first direction; not multiplied by w. */
  controlPoints: readonly (readonly { x: number; y: number; z: number; w: number }[])[];
}

/**
 * A `NURBSSurface` of three/examples/jsm/curves. For `hd.model`.
 *
 * @throws {HausdorffError} `ARGUMENT_INVALID` for another object.
 */
export function fromThree(surface: ThreeNurbsSurface): InterchangeModel {
  const { degree1, degree2, knots1, knots2, controlPoints } = surface ?? {};
  if (!controlPoints || !knots1 || !knots2) {
    throw new HausdorffError("ARGUMENT_INVALID", "expected a NURBSSurface of three");
  }
  const ctrl = controlPoints.map((row) => row.map(({ x, y, z, w }): ControlPoint => [x, y, z, w]));
  return {
    surfaces: [{ degree: [degree1, degree2], knots_u: knots1, knots_v: knots2, ctrl }],
  };
}

/** The parts of three's `BufferAttribute` and `InterleavedBufferAttribute` that are used. */
export interface ThreeAttribute {
  readonly count: number;
  getX(index: number): number;
  getY(index: number): number;
  getZ(index: number): number;
}

/** The parts of three's `BufferGeometry` that are used. */
export interface ThreeGeometry {
  readonly attributes: { readonly position?: ThreeAttribute };
  readonly index: { readonly count: number; getX(index: number): number } | null;
}

/** The parts of three's `Matrix4` that are used: 16 numbers, column by column. */
export interface ThreeMatrix {
  readonly elements: readonly number[];
}

/**
 * The triangles of a `BufferGeometry` of three, indexed or not, moved by a matrix such as an
 * object's `matrixWorld`, if one is given. For `hd.mesh`.
 *
 * The positions are multiplied in float64. Groups and the draw range are not looked at.
 *
 * @throws {HausdorffError} `ARGUMENT_INVALID` for another object, and for a matrix whose last row is not 0, 0, 0, 1.
 */
export function fromThreeGeometry(geometry: ThreeGeometry, matrixWorld?: ThreeMatrix): MeshArrays {
  const position = geometry?.attributes?.position;
  if (position === undefined) {
    throw new HausdorffError("ARGUMENT_INVALID", "expected a BufferGeometry with positions");
  }
  const positions = new Float64Array(3 * position.count);
  for (let index = 0; index < position.count; index++) {
    positions.set([position.getX(index), position.getY(index), position.getZ(index)], 3 * index);
  }
  if (matrixWorld !== undefined) move(positions, matrixWorld.elements);
  const corners = geometry.index;
  const count = corners === null ? position.count : corners.count;
  const triangles = new Uint32Array(count - (count % 3));
  for (let corner = 0; corner < triangles.length; corner++) {
    triangles[corner] = corners === null ? corner : corners.getX(corner);
  }
  return { positions, triangles };
}

/** Applies a matrix to points. */
function move(positions: Float64Array, elements: readonly number[]): void {
  const [
    a = 0,
    b = 0,
    c = 0,
    d,
    e = 0,
    f = 0,
    g = 0,
    h,
    i = 0,
    j = 0,
    k = 0,
    l,
    x = 0,
    y = 0,
    z = 0,
    w,
  ] = elements;
  if (d !== 0 || h !== 0 || l !== 0 || w !== 1) {
    throw new HausdorffError("ARGUMENT_INVALID", "the matrix is not affine");
  }
  for (let index = 0; index < positions.length; index += 3) {
    const [p = 0, q = 0, r = 0] = positions.subarray(index, index + 3);
    positions.set(
      [a * p + e * q + i * r + x, b * p + f * q + j * r + y, c * p + g * q + k * r + z],
      index,
    );
  }
}
