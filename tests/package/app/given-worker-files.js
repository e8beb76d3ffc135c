// A program that reads files in the package's worker, which it starts from a bundle of its own.
import { Hausdorff } from "nurbs-hausdorff/worker";
import { measureBalls } from "./shared/measure-balls.js";

const worker = new Worker(new URL("./thread.js", import.meta.url), { type: "module" });
globalThis.outcome = measureBalls(Hausdorff, { worker });
