import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { defineConfig, type HtmlTagDescriptor, type Plugin } from "vite";
import { filled } from "./src/texts/filled.ts";

const { version } = JSON.parse(readFileSync(new URL("../package.json", import.meta.url), "utf8"));

const page = (name: string) => fileURLToPath(new URL(name, import.meta.url));

const tag = (tag: string, attrs: HtmlTagDescriptor["attrs"]): HtmlTagDescriptor => ({
  ...{ tag, attrs, injectTo: "head-prepend" },
});

/** What the heads of all pages begin with. */
const commonHead: Plugin = {
  name: "common-head",
  transformIndexHtml: {
    // Before the style sheet is bundled.
    order: "pre",
    handler: () => [
      tag("meta", { charset: "utf-8" }),
      tag("meta", { name: "viewport", content: "width=device-width, initial-scale=1" }),
      // No icon, and no request for one.
      tag("link", { rel: "icon", href: "data:," }),
      tag("link", { rel: "stylesheet", href: "/src/style.css" }),
      tag("link", { rel: "stylesheet", href: "/src/layout/stage.css" }),
    ],
  },
};

/** The texts that pages name, in their language. */
const pageTexts: Plugin = {
  name: "page-texts",
  transformIndexHtml: { order: "pre", handler: filled },
};

export default defineConfig({
  plugins: [pageTexts, commonHead],
  // What made a report.
  define: { VERSION: JSON.stringify(version) },
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
