// A program that reads files and measures in the package's worker.
import { Hausdorff } from "nurbs-hausdorff/worker";
import { measureBalls } from "./shared/measure-balls.js";

globalThis.outcome = measureBalls(Hausdorff);
