import { HausdorffError } from "./error.js";
import init from "./wasm/nurbs_hausdorff.js";

/** A wasm module: compiled, its bytes, or where to fetch it. */
export type ModuleSource = WebAssembly.Module | BufferSource | Response | Request | URL | string;

/** The package's wasm modules: the core, the readers of CAD files, those of meshes, and those of scans. */
export type ModuleName =
  | "nurbs_hausdorff"
  | "nurbs_hausdorff_readers"
  | "nurbs_hausdorff_meshes"
  | "nurbs_hausdorff_scans";

/** The function of a module's glue that starts it; without a source it fetches from beside itself. */
type Init = (options?: { module_or_path: ModuleSource }) => Promise<unknown>;

/** The option of `Hausdorff.create` that names a module's source. */
const OPTIONS: Readonly<Record<ModuleName, string>> = {
  nurbs_hausdorff: "module",
  nurbs_hausdorff_readers: "readers",
  nurbs_hausdorff_meshes: "meshes",
  nurbs_hausdorff_scans: "scans",
};

const sources = new Map<ModuleName, ModuleSource>();
const loading = new Map<ModuleName, Promise<unknown>>();
let coreIsLoaded = false;

/** Finds a module where the caller names none; undefined: it is fetched from beside its glue. */
let find: (name: ModuleName) => Promise<ModuleSource | undefined> = async () => undefined;

/**
 * Sets where the modules are found unless the caller names them.
 * @internal
 */
export function findModulesBy(finder: (name: ModuleName) => Promise<ModuleSource>): void {
  find = finder;
}

/**
 * Sets the source of a module that is loaded later.
 * @internal
 */
export function setSource(name: ModuleName, source: ModuleSource | undefined): void {
  if (source !== undefined) sources.set(name, source);
}

/**
 * Loads a module once; after a failure it can be loaded again.
 *
 * @throws {HausdorffError} `MODULE_FAILED`.
 * @internal
 */
export async function loadModule(name: ModuleName, init: Init): Promise<void> {
  let started = loading.get(name);
  if (started === undefined) {
    started = instantiate(name, init);
    loading.set(name, started);
  }
  try {
    await started;
  } catch (cause) {
    loading.delete(name);
    sources.delete(name);
    const why = cause instanceof Error ? cause.message : `${cause}`;
    throw new HausdorffError(
      "MODULE_FAILED",
      `the wasm module could not be loaded: ${why} (where a bundler does not copy ${name}_bg.wasm, ` +
        `import "nurbs-hausdorff/inline", or pass its address or bytes as \`${OPTIONS[name]}\`)`,
      { cause },
    );
  }
}

async function instantiate(name: ModuleName, init: Init): Promise<void> {
  const source = sources.get(name) ?? (await find(name));
  await init(source === undefined ? undefined : { module_or_path: source });
}

/**
 * Loads the core, as `loadModule`.
 * @internal
 */
export async function load(source?: ModuleSource): Promise<void> {
  if (!coreIsLoaded) setSource("nurbs_hausdorff", source);
  await loadModule("nurbs_hausdorff", init);
  coreIsLoaded = true;
}

/** @internal */
export function requireLoaded(): void {
  if (!coreIsLoaded) {
    throw new HausdorffError("MODULE_NOT_LOADED", "await Hausdorff.create() first");
  }
}
