import { HausdorffError } from "./error.js";
import init from "./wasm/nurbs_hausdorff.js";

/** The wasm module: compiled, its bytes, or where to fetch it. */
export type ModuleSource = WebAssembly.Module | BufferSource | Response | Request | URL | string;

let loading: Promise<void> | undefined;
let loaded = false;

/** Finds the module where the caller names none; undefined: it is fetched from beside its glue. */
let find: () => Promise<ModuleSource | undefined> = async () => undefined;

/**
 * Sets where the module is found unless the caller names it.
 * @internal
 */
export function findModuleBy(finder: () => Promise<ModuleSource>): void {
  find = finder;
}

/**
 * Loads the wasm module once; after a failure it can be loaded again.
 *
 * @throws {HausdorffError} `MODULE_FAILED`.
 * @internal
 */
export async function load(module?: ModuleSource): Promise<void> {
  loading ??= instantiate(module).then(() => {
    loaded = true;
  });
  try {
    await loading;
  } catch (cause) {
    loading = undefined;
    const why = cause instanceof Error ? cause.message : `${cause}`;
    throw new HausdorffError(
      "MODULE_FAILED",
      `the wasm module could not be loaded: ${why} (where a bundler does not copy it, import ` +
        '"nurbs-hausdorff/inline", or pass its address or bytes as `module`)',
      { cause },
    );
  }
}

async function instantiate(module: ModuleSource | undefined): Promise<void> {
  const source = module ?? (await find());
  await init(source === undefined ? undefined : { module_or_path: source });
}

/** @internal */
export function requireLoaded(): void {
  if (!loaded) {
    throw new HausdorffError("MODULE_NOT_LOADED", "await Hausdorff.create() first");
  }
}
