import { HausdorffError } from "./error.js";
import init from "./wasm/nurbs_hausdorff.js";

/** The wasm module: compiled, its bytes, or where to fetch it. */
export type ModuleSource = WebAssembly.Module | BufferSource | Response | Request | URL | string;

let loading: Promise<void> | undefined;
let loaded = false;

/**
 * Loads the wasm module once, by default from the folder of this file; after a
 * failure it can be loaded again.
 * @internal
 */
export async function load(module?: ModuleSource): Promise<void> {
  loading ??= init(module === undefined ? undefined : { module_or_path: module }).then(() => {
    loaded = true;
  });
  try {
    await loading;
  } catch (error) {
    loading = undefined;
    throw error;
  }
}

/** @internal */
export function requireLoaded(): void {
  if (!loaded) {
    throw new HausdorffError("MODULE_NOT_LOADED", "await Hausdorff.create() first");
  }
}
