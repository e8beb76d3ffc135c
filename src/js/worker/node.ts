// `nurbs-hausdorff/worker` in Node, on a worker of `node:worker_threads`.
import { connectBy } from "./hausdorff.js";
import { node } from "./platform/node.js";

connectBy(node(new URL("./thread-node.js", import.meta.url)));

export * from "./exports.js";
