// The package with the wasm modules inlined, for bundlers that do not copy them. The readers of
// CAD files, of meshes and of scans are parts of their own, which a bundler that splits programs loads
// with the first file.
import { findModulesBy, type ModuleName } from "./load.js";
import core from "./wasm/inlined.js";

const texts: Readonly<Record<ModuleName, () => Promise<string>>> = {
  nurbs_hausdorff: async () => core,
  nurbs_hausdorff_readers: async () => (await import("./wasm/inlined-readers.js")).default,
  nurbs_hausdorff_meshes: async () => (await import("./wasm/inlined-meshes.js")).default,
  nurbs_hausdorff_scans: async () => (await import("./wasm/inlined-scans.js")).default,
};

findModulesBy(async (name) => {
  const compressed = Uint8Array.from(atob(await texts[name]()), (character) =>
    character.charCodeAt(0),
  );
  const stream = new Blob([compressed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
});

export * from "./index.js";
