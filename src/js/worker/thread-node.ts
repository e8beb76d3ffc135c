// The worker's side in Node.
/// <reference types="node" />
import { parentPort } from "node:worker_threads";
import "../node.js";
import { serve } from "./serve.js";

const take = serve((reply, transfer) => parentPort?.postMessage(reply, transfer));
parentPort?.on("message", take);
