export type { CreateOptions, ShapeInfo } from "../hausdorff.js";
export * from "../types.js";
export {
  Hausdorff,
  type WorkerCadOptions,
  type WorkerClosestPointOptions,
  type WorkerCreateOptions,
} from "./hausdorff.js";
export { NurbsModel } from "./model.js";
export type { PoolOptions } from "./pool/options.js";
