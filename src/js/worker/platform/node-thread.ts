/// <reference types="node" />
import { parentPort } from "node:worker_threads";
import { type ReadCad, serve } from "../serve.js";

/** Answers the calls of the thread that started this worker. */
export function serveNode(readCad?: ReadCad): void {
  const take = serve((reply, transfer) => parentPort?.postMessage(reply, transfer), readCad);
  parentPort?.on("message", take);
}
