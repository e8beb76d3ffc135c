// The worker's side in Node, with the readers of CAD files.
import "../../node.js";
import { readCad } from "../../cad/read.js";
import { serveNode } from "../platform/node-thread.js";

serveNode(readCad);
