// The bounds of geometries, by which is decided what is drawn and hit.
import { Box3, BufferGeometry, type Object3D, Sphere, Vector3 } from "three";
import type { Bounds } from "../common/bounds.ts";

/** Gives a geometry bounds that are known, so that no vertex is read for them. */
export function setBounds(geometry: BufferGeometry, { min, max }: Bounds): void {
  const box = new Box3(new Vector3(...min), new Vector3(...max));
  geometry.boundingBox = box;
  geometry.boundingSphere = box.getBoundingSphere(new Sphere());
}

/** Returns a geometry that shares vertices and bounds with another one, and has no triangles. */
export function ofSameVertices(source: BufferGeometry, ...attributes: string[]): BufferGeometry {
  const geometry = new BufferGeometry();
  for (const name of attributes) geometry.setAttribute(name, source.getAttribute(name));
  geometry.boundingBox = source.boundingBox;
  geometry.boundingSphere = source.boundingSphere;
  return geometry;
}

/** Has bounds computed anew, after vertices were moved. */
export function forgetBounds(geometry: BufferGeometry): void {
  geometry.boundingBox = null;
  geometry.boundingSphere = null;
}

/** Has the bounds of all that is drawn below an object computed anew. */
export function forgetAllBounds(group: Object3D): void {
  group.traverse((object) => {
    if ("geometry" in object) forgetBounds(object.geometry as BufferGeometry);
  });
}
