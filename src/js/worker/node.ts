// `nurbs-hausdorff/worker` in Node, on a worker of `node:worker_threads`.
/// <reference types="node" />
import { Worker } from "node:worker_threads";
import { HausdorffError } from "../error.js";
import { connectBy } from "./hausdorff.js";

connectBy((listener, given) => {
  if (given !== undefined) {
    throw new HausdorffError("OPTION_INVALID", "worker: in Node the package starts its own");
  }
  const worker = new Worker(new URL("./thread-node.js", import.meta.url));
  worker.on("message", (reply) => listener.message(reply));
  worker.on("error", ({ message }) => listener.failed(`the worker failed: ${message}`));
  worker.on("exit", () => listener.failed("the worker ended"));
  return {
    post: (message, transfer) => worker.postMessage(message, transfer),
    hold: (held) => (held ? worker.ref() : worker.unref()),
    close: () => void worker.terminate(),
  };
});

export * from "./exports.js";
