import type { Tessellation as Source } from "./wasm/nurbs_hausdorff.js";

/** Triangles to show a model by; nothing is measured on them. */
export interface Tessellation {
  /** x, y, z of every vertex, relative to `origin`. */
  positions: Float32Array<ArrayBuffer>;
  /** Unit normals, x, y, z of every vertex. */
  normals: Float32Array<ArrayBuffer>;
  /** Three vertices a triangle, anticlockwise seen from where the normal points. */
  indices: Uint32Array<ArrayBuffer>;
  /** The point that positions are relative to, in float64. */
  origin: [x: number, y: number, z: number];
  /** The part of `indices` that is each surface's. */
  surfaces: { firstIndex: number; indexCount: number }[];
}

/**
 * The arrays taken out of the module's memory, which is freed.
 * @internal
 */
export function take(source: Source): Tessellation {
  try {
    const [x = 0, y = 0, z = 0] = source.origin;
    const ranges = source.surfaces;
    return {
      positions: source.positions as Float32Array<ArrayBuffer>,
      normals: source.normals as Float32Array<ArrayBuffer>,
      indices: source.indices as Uint32Array<ArrayBuffer>,
      origin: [x, y, z],
      surfaces: Array.from({ length: ranges.length / 2 }, (_, index) => ({
        firstIndex: ranges[2 * index] ?? 0,
        indexCount: ranges[2 * index + 1] ?? 0,
      })),
    };
  } finally {
    source.free();
  }
}
