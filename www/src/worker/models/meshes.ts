// Which models are meshes or clouds of points: their triangles are the model itself.
import type { NurbsModel } from "nurbs-hausdorff/worker";

const meshes = new WeakSet<NurbsModel>();
const clouds = new WeakSet<NurbsModel>();

/** Notes that a model was read as a mesh, and returns it. */
export function noted(model: NurbsModel): NurbsModel {
  meshes.add(model);
  return model;
}

/** Notes that a mesh has no triangles: a scan. */
export function notedCloud(model: NurbsModel): void {
  clouds.add(model);
}

export const isMesh = (model: NurbsModel): boolean => meshes.has(model);
export const isCloud = (model: NurbsModel): boolean => clouds.has(model);
