/// <reference types="node" />
import { Worker } from "node:worker_threads";
import { HausdorffError } from "../../error.js";
import type { Connect } from "../messages.js";

/** Connects to a new worker of `node:worker_threads` that runs this file. */
export const node =
  (thread: URL): Connect =>
  (listener, given) => {
    if (given !== undefined) {
      throw new HausdorffError("OPTION_INVALID", "worker: in Node the package starts its own");
    }
    const worker = new Worker(thread);
    worker.on("message", (reply) => listener.message(reply));
    worker.on("error", ({ message }) => listener.failed(`the worker failed: ${message}`));
    worker.on("exit", () => listener.failed("the worker ended"));
    return {
      post: (message, transfer) => worker.postMessage(message, transfer),
      hold: (held) => (held ? worker.ref() : worker.unref()),
      close: () => void worker.terminate(),
    };
  };
