// The bundlers, each with the settings that its users start with. Every function
// builds the named programs of the folder `source` into `out`.
import { copyFileSync, cpSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import nodeResolve from "@rollup/plugin-node-resolve";
import * as esbuild from "esbuild";
import { rollup } from "rollup";
import { build } from "vite";
import webpack from "webpack";
import { page } from "./install.mjs";

const script = (name) => `./${name}.js`;

function pages(out, names) {
  for (const name of names) page(join(out, `${name}.html`), script(name));
}

/** Vite, from pages, as its applications begin. */
export async function viteBundle({ source, out, names }) {
  pages(source, names);
  await build({
    root: source,
    base: "./",
    logLevel: "error",
    configFile: false,
    build: {
      outDir: out,
      emptyOutDir: true,
      minify: false,
      target: "es2022",
      rolldownOptions: { input: names.map((name) => join(source, `${name}.html`)) },
    },
  });
}

/** webpack in its production mode, without a loader or a plugin. */
export async function webpackBundle({ source, out, names }) {
  const entry = Object.fromEntries(names.map((name) => [name, join(source, script(name))]));
  const compiler = webpack({
    mode: "production",
    context: source,
    entry,
    output: { path: out, filename: "[name].js" },
    optimization: { minimize: false },
    performance: false,
  });
  const stats = await new Promise((resolve, reject) => {
    compiler.run((error, done) => (error ? reject(error) : resolve(done)));
  });
  if (stats.hasErrors() || stats.hasWarnings()) throw new Error(stats.toString("errors-warnings"));
  pages(out, names);
}

/** Rollup with its plugin that finds packages. */
export async function rollupBundle({ source, out, names }) {
  const input = names.map((name) => join(source, script(name)));
  const onLog = (_level, { message }) => {
    throw new Error(message);
  };
  const bundle = await rollup({ input, plugins: [nodeResolve({ browser: true })], onLog });
  await bundle.write({ dir: out, format: "es", chunkFileNames: "[name].js" });
  pages(out, names);
}

/** esbuild for browsers, as ES modules. */
export async function esbuildBundle({ source, out, names }) {
  await esbuild.build({
    entryPoints: names.map((name) => join(source, script(name))),
    outdir: out,
    bundle: true,
    format: "esm",
    logLevel: "error",
  });
  pages(out, names);
}

/** Copies the wasm modules beside a bundle, as the README says. */
export function copyModules(installed, out) {
  for (const name of ["", "_readers", "_meshes", "_scans"]) {
    const file = `nurbs_hausdorff${name}_bg.wasm`;
    copyFileSync(join(installed, "dist", "wasm", file), join(out, file));
  }
}

/** No bundler: the files as they are, found by an import map. */
export function importMap({ source, out, names, installed }) {
  mkdirSync(out, { recursive: true });
  cpSync(source, out, { recursive: true });
  cpSync(join(installed, "dist"), join(out, "package"), { recursive: true });
  const imports = {
    "nurbs-hausdorff": "./package/index.js",
    "nurbs-hausdorff/worker": "./package/worker/index.js",
    "nurbs-hausdorff/cad": "./package/cad/index.js",
  };
  const head = `<script type="importmap">${JSON.stringify({ imports })}</script>`;
  for (const name of names) page(join(out, `${name}.html`), script(name), head);
}
