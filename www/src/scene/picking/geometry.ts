// The triangles that a tree is of, as the page and its worker share them.
import { BufferAttribute, BufferGeometry } from "three";
import type { SerializedBVH } from "three-mesh-bvh";

/** The triangles of a mesh: x, y, z a vertex, and three vertices each. */
export interface Triangles {
  positions: Float32Array;
  indices: Uint32Array;
}

/** A tree whose triangles stay where they are. */
export type Serialized = Omit<SerializedBVH, "index">;

/** The geometry that a tree is of. */
export function geometryOf({ positions, indices }: Triangles): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(indices, 1));
  return geometry;
}
