// The worker's side in Node.
import "../node.js";
import { serveNode } from "./platform/node-thread.js";

export { loadLibrariesBy } from "./serve.js";

serveNode(new URL(import.meta.url));
