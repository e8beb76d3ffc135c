// The package with the wasm module inlined, for bundlers that do not copy it.
import { findModuleBy } from "./load.js";
import inlined from "./wasm/inlined.js";

findModuleBy(async () => {
  const compressed = Uint8Array.from(atob(inlined), (character) => character.charCodeAt(0));
  const stream = new Blob([compressed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
});

export * from "./index.js";
