// The files of the package: the wasm modules, then the TypeScript API around it.
import { buildApi } from "./api.mjs";
import { buildWasm } from "./wasm.mjs";

/** Builds what has changed since the last build, with a line on each part. */
export async function buildPackage() {
  console.log(`build: wasm modules: ${await buildWasm()}`);
  console.log(`build: TypeScript API: ${await buildApi()}`);
}
