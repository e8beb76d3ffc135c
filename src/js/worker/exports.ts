export type { CreateOptions, ShapeInfo } from "../hausdorff.js";
export * from "../types.js";
export {
  Hausdorff,
  type WorkerClosestPointOptions,
  type WorkerCreateOptions,
} from "./hausdorff.js";
export { NurbsModel } from "./model.js";
