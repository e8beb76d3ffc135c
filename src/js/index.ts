// The package `nurbs-hausdorff`: certified Hausdorff distances of NURBS models.
export { type CreateOptions, Hausdorff, type ShapeInfo } from "./hausdorff.js";
export { NurbsModel } from "./model/model.js";
export * from "./types.js";
