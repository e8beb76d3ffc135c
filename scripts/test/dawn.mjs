// WebGPU for Node, as the package finds it in a browser: npm's `webgpu` (Dawn)
// on the driver that the tests run on.
import { create, globals } from "webgpu";

/** Gives this process `navigator.gpu` and the WebGPU constants. */
export function installWebGpu() {
  Object.assign(globalThis, globals);
  const navigator = { gpu: create([]) };
  Object.defineProperty(globalThis, "navigator", { value: navigator, configurable: true });
  // wgpu looks for WebGPU only where it finds the class of a browser's global.
  globalThis.Window ??= class Window {};
}
