import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";

const page = (name: string) => fileURLToPath(new URL(name, import.meta.url));

export default defineConfig({
  base: "./",
  build: {
    target: "es2022",
    chunkSizeWarningLimit: 900,
    rolldownOptions: { input: [page("index.html"), page("experiments.html")] },
  },
  worker: { format: "es" },
  // The package finds its wasm module beside its own files, which the
  // development server's pre-bundling would take it away from.
  optimizeDeps: { exclude: ["nurbs-hausdorff"] },
});
