/// <reference types="node" />
import { parentPort } from "node:worker_threads";
import { serve } from "../serve.js";

/** Answers the calls of the thread that started this worker. */
export function serveNode(): void {
  const take = serve((reply, transfer) => parentPort?.postMessage(reply, transfer));
  parentPort?.on("message", take);
}
