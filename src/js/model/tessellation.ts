/** Options of `NurbsModel.tessellate`. */
export interface TessellationOptions {
  /** The permitted deviation of the triangles from the model, in model units. */
  tolerance?: number;
  /** The same as a fraction of the model's diagonal; 2e-4 if neither is given. Both at once are an error. */
  relativeTolerance?: number;
}

/** Triangles that display a model; nothing is measured on them. */
export interface Tessellation {
  /** x, y, z of every vertex, relative to `origin`. */
  positions: Float32Array<ArrayBuffer>;
  /** Unit normals, x, y, z of every vertex. */
  normals: Float32Array<ArrayBuffer>;
  /** Three vertices a triangle, anticlockwise seen from where the normal points. */
  indices: Uint32Array<ArrayBuffer>;
  /** The point that positions are relative to, in float64. */
  origin: [x: number, y: number, z: number];
  /** The range of `indices` of each face. */
  faces: { firstIndex: number; indexCount: number }[];
}
