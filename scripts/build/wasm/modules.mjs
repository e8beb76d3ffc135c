// The package's wasm modules, and what every way of building them shares.
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { inRoot } from "../../paths.mjs";
import { must } from "../../process.mjs";
import { toolsEnvironment, toolsFolder } from "../../setup/tools.mjs";
import { digest } from "../../stamp.mjs";

/**
 * The modules: the core, and the readers of CAD files, of meshes and of scans, which are fetched
 * when a file comes. Each is the crate with the exports of one feature.
 */
export const modules = [
  { name: "nurbs_hausdorff", feature: "wasm", inlined: "inlined" },
  { name: "nurbs_hausdorff_readers", feature: "wasm-readers", inlined: "inlined-readers" },
  { name: "nurbs_hausdorff_meshes", feature: "wasm-meshes", inlined: "inlined-meshes" },
  { name: "nurbs_hausdorff_scans", feature: "wasm-scans", inlined: "inlined-scans" },
];

export const wasm32 = ["--target", "wasm32-unknown-unknown", "--no-default-features"];

/** The file that cargo makes of the crate in a profile. */
export const compiled = (profile) =>
  inRoot("target", "wasm32-unknown-unknown", profile, "nurbs_hausdorff.wasm");

/** A digest of all that the modules are made of. The TypeScript in src/js is no part of them. */
export function sources() {
  const rust = readdirSync(inRoot("src")).filter((name) => name !== "js" && name !== "bin");
  return digest(
    [
      ...["Cargo.toml", "Cargo.lock", ".cargo", "shaders", ...rust.map((name) => `src/${name}`)],
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
  const text = gzipSync(bytes, { level }).toString("base64");
  writeFileSync(`${folder}/${name}.js`, `export default "${text}";\n`);
  const declaration = "declare const base64: string;\nexport default base64;\n";
  writeFileSync(`${folder}/${name}.d.ts`, declaration);
}

/** The bytes of a module in a folder. */
export const moduleIn = (folder, { name }) => readFileSync(`${folder}/${name}_bg.wasm`);
