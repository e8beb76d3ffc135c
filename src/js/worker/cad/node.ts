// `nurbs-hausdorff/worker/cad` in Node.
import { connectBy } from "../hausdorff.js";
import { node } from "../platform/node.js";

connectBy(node(new URL("./thread-node.js", import.meta.url)), { readers: true });

export * from "../exports.js";
export { readCad, type WorkerCadOptions } from "./read.js";
