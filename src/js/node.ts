// The package in Node, where files are read, not fetched.
/// <reference types="node" />
import { readFile } from "node:fs/promises";
import { findModulesBy } from "./load.js";

findModulesBy((name) => readFile(new URL(`./wasm/${name}_bg.wasm`, import.meta.url)));

export * from "./index.js";
