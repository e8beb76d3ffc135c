// Which models are meshes or clouds of points: their triangles are the model itself.
import type { NurbsModel } from "nurbs-hausdorff/worker";

const meshes = new WeakSet<NurbsModel>();

/** Notes that a model was read as a mesh, and returns it. */
export function noted(model: NurbsModel): NurbsModel {
  meshes.add(model);
  return model;
}

export const isMesh = (model: NurbsModel): boolean => meshes.has(model);
