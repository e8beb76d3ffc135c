import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";

const page = (name: string) => fileURLToPath(new URL(name, import.meta.url));

export default defineConfig({
  base: "./",
  build: {
    target: "es2022",
    chunkSizeWarningLimit: 900,
    rolldownOptions: { input: ["index.html", "experiments.html", "deforming.html"].map(page) },
  },
  worker: { format: "es" },
  // These packages load their wasm modules relative to their own files, and the
  // pre-bundling of the development server would move those files.
  optimizeDeps: { exclude: ["nurbs-hausdorff", "@bitbybit-dev/occt", "rhino3dm"] },
});
