// The package's wasm modules, and what every way of building them shares.
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { inRoot } from "../../paths.mjs";
import { must } from "../../process.mjs";
import { toolsEnvironment, toolsFolder } from "../../setup/tools.mjs";
import { digest } from "../../stamp.mjs";

const [core, cad, meshes] = ["nurbs-hausdorff", "nurbs-hausdorff-cad", "nurbs-hausdorff-meshes"];

/**
 * The modules: the core, and the readers of CAD files, of meshes and of scans, which are fetched
 * when a file comes. Each is a crate with the exports of one feature.
 */
export const modules = [
  { name: "nurbs_hausdorff", crate: core, feature: "wasm", inlined: "inlined" },
  { name: "nurbs_hausdorff_readers", crate: cad, feature: "wasm", inlined: "inlined-readers" },
  {
    name: "nurbs_hausdorff_meshes",
    crate: meshes,
    feature: "wasm-meshes",
    inlined: "inlined-meshes",
  },
  { name: "nurbs_hausdorff_scans", crate: meshes, feature: "wasm-scans", inlined: "inlined-scans" },
];

export const wasm32 = ["--target", "wasm32-unknown-unknown", "--no-default-features"];

/**
 * The choice of the crates of some modules, with their exports, for cargo. Features are named alone: `crate/feature`
 * would be one of the crate's dependency on itself, by which its tests see more of it.
 */
export const chosen = (some) => [
  ...new Set(some.map(({ crate }) => `--package=${crate}`)),
  `--features=${[...new Set(some.map(({ feature }) => feature))].join()}`,
];

/** The file that cargo makes of a module's crate in a profile. */
export const compiled = (profile, { crate }) =>
  inRoot("target", "wasm32-unknown-unknown", profile, `${crate.replaceAll("-", "_")}.wasm`);

/** A digest of all that the modules are made of. The TypeScript in src/js is no part of them. */
export function sources() {
  const rust = readdirSync(inRoot("src")).filter((name) => name !== "js");
  return digest(
    [
      ...["Cargo.toml", "Cargo.lock", ".cargo", "shaders", ...rust.map((name) => `src/${name}`)],
      ...["crates/cad", "crates/meshes"].flatMap((name) => [`${name}/Cargo.toml`, `${name}/src`]),
      ...["package-lock.json", "scripts/build/wasm"],
    ],
    [toolsFolder()],
  );
}

/** Writes the JavaScript glue of a compiled crate, and the module, by this name into a folder. */
export const bind = (file, folder, name) =>
  must("bindgen", [file, folder, name], { env: toolsEnvironment() });

/** Writes a module as a JavaScript string: gzipped, in base64. */
export function inline(bytes, folder, name, level) {
  embed(gzipSync(bytes, { level }), folder, name);
}

/** Writes bytes as a JavaScript string in base64. */
export function embed(bytes, folder, name) {
  writeFileSync(`${folder}/${name}.js`, `export default "${bytes.toString("base64")}";\n`);
  const declaration = "declare const base64: string;\nexport default base64;\n";
  writeFileSync(`${folder}/${name}.d.ts`, declaration);
}

/** The bytes of a module in a folder. */
export const moduleIn = (folder, { name }) => readFileSync(`${folder}/${name}_bg.wasm`);
