// The triangles or points that a tree is of, as the page and its worker share them.
import { BufferAttribute, BufferGeometry } from "three";
import type { SerializedBVH } from "three-mesh-bvh";

/** What is hit: x, y, z a vertex, and three vertices a triangle; without triangles, the vertices as points. */
export interface Hittable {
  positions: Float32Array;
  indices: Uint32Array;
}

/** A tree whose triangles stay where they are. */
export type Serialized = Omit<SerializedBVH, "index">;

/** The geometry that a tree is of: a point is a triangle whose corners are one. */
export function geometryOf({ positions, indices }: Hittable): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  const corners =
    indices.length > 0
      ? indices
      : Uint32Array.from(positions, (_, corner) => Math.floor(corner / 3));
  geometry.setIndex(new BufferAttribute(corners, 1));
  return geometry;
}
