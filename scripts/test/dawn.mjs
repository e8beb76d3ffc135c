// WebGPU in Node, for the package to use as in a browser: npm's `webgpu` (Dawn)
// on the driver of the tests.
import { create, globals } from "webgpu";

/** Defines `navigator.gpu` and the WebGPU constants in this process. */
export function installWebGpu() {
  Object.assign(globalThis, globals);
  const navigator = { gpu: create([]) };
  Object.defineProperty(globalThis, "navigator", { value: navigator, configurable: true });
  // wgpu looks for WebGPU only if a browser's class `Window` exists.
  globalThis.Window ??= class Window {};
}
