import { defineConfig } from "vite";

export default defineConfig({
  base: "./",
  build: { target: "es2022", chunkSizeWarningLimit: 900 },
  worker: { format: "es" },
  // The package finds its wasm module beside its own files, which the
  // development server's pre-bundling would take it away from.
  optimizeDeps: { exclude: ["nurbs-hausdorff"] },
});
