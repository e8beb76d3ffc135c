// The package in Node, where files are read, not fetched.
/// <reference types="node" />
import { readFile } from "node:fs/promises";
import { findModuleBy } from "./load.js";

findModuleBy(() => readFile(new URL("./wasm/nurbs_hausdorff_bg.wasm", import.meta.url)));

export * from "./index.js";
