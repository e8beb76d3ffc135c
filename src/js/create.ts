import type { CreateOptions } from "./hausdorff.js";

/**
 * The names of the options of `create`, which the worker's entry knows without the module.
 * @internal
 */
export const CREATE_OPTIONS: readonly (keyof CreateOptions)[] = [
  ...(["backend", "module", "readers", "meshes", "scans"] as const),
];
