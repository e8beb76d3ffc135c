// `nurbs-hausdorff/cad` in Node, where the wasm modules are read, not fetched.
import "../node.js";

export * from "./index.js";
