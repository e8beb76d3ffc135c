/// <reference types="node" />
import { availableParallelism } from "node:os";
import { parentPort } from "node:worker_threads";
import { serve } from "../serve.js";
import { node } from "./node.js";

/** Answers the calls of the thread that started this worker, which runs this file. */
export function serveNode(thread: URL): void {
  const take = serve((reply, transfer) => parentPort?.postMessage(reply, transfer), {
    connect: node(thread),
    processors: availableParallelism,
  });
  parentPort?.on("message", take);
}
