// The crate as wasm modules with their JavaScript glue, in dist/wasm.
import { existsSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { inRoot } from "../paths.mjs";
import { must } from "../process.mjs";
import { toolsEnvironment, toolsFolder } from "../setup/tools.mjs";
import { digest, stamp, stamped } from "../stamp.mjs";

const out = "dist/wasm";
const made = ".setup/wasm-made-from";

// Panic messages name source files without the folders of this machine. Cargo
// adds these flags to those of .cargo/config.toml.
const remapped = `--remap-path-prefix=${process.env.CARGO_HOME || join(homedir(), ".cargo")}=cargo`;

// LLVM inlines functions up to a size of 225. Up to 150 the core was 25 KiB smaller, gzipped, and the
// reference pairs took 1.01 to 1.03 times as long in Node. A little code more may make it inline much more:
// a field of a face made the core 24 KiB larger. Up to 75 it is 10 KiB smaller than up to 100, 691 KiB, and
// the reference pairs with four pairs in other parameters take 1.00 times as long.
const rustFlags = `${remapped} -Cllvm-args=--inline-threshold=75`;

/**
 * The modules: the core, the readers of CAD files, those of meshes and those of scans, which are
 * fetched when a file comes, and the pictures of the command line's reports, which nothing else loads.
 * Each is the crate with the exports of one feature.
 */
export const modules = [
  { name: "nurbs_hausdorff", feature: "wasm", inlined: "inlined" },
  { name: "nurbs_hausdorff_readers", feature: "wasm-readers", inlined: "inlined-readers" },
  { name: "nurbs_hausdorff_meshes", feature: "wasm-meshes", inlined: "inlined-meshes" },
  { name: "nurbs_hausdorff_scans", feature: "wasm-scans", inlined: "inlined-scans" },
  { name: "nurbs_hausdorff_pictures", feature: "wasm-pictures" },
];

/** The file of a module. */
export const wasmFile = ({ name }) => `${out}/${name}_bg.wasm`;

export async function buildWasm() {
  // The TypeScript in src/js is no part of the modules.
  const rust = readdirSync(inRoot("src")).filter((name) => name !== "js");
  const sources = digest(
    [
      ...["Cargo.toml", "Cargo.lock", ".cargo", "shaders", ...rust.map((name) => `src/${name}`)],
      ...["package-lock.json", "scripts/build"],
    ],
    [toolsFolder()],
  );
  const present = modules.every((module) => existsSync(inRoot(wasmFile(module))));
  if (stamped(made, sources) && present) return "unchanged";
  rmSync(inRoot(out), { recursive: true, force: true });
  for (const module of modules) {
    await compile(module);
    if (module.inlined) inline(module);
  }
  // This file would make npm exclude the folder from the package.
  rmSync(inRoot(out, ".gitignore"), { force: true });
  stamp(made, sources);
  return "built";
}

/** Compiles a module, and writes its JavaScript glue beside it. */
async function compile({ name, feature }) {
  await must(
    "wasm-pack",
    // All tools are on PATH, so wasm-pack downloads none. It writes no
    // package.json, because the package has its own.
    [
      ...["build", "--mode", "no-install", "--no-pack", "--profile", "wasm", "--target", "web"],
      ...[
        "--out-dir",
        out,
        "--out-name",
        name,
        "--",
        "--no-default-features",
        "--features",
        feature,
      ],
    ],
    { env: toolsEnvironment({ CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS: rustFlags }) },
  );
}

/** Writes a module as a JavaScript string: gzipped, in base64. */
function inline(module) {
  const bytes = readFileSync(inRoot(wasmFile(module)));
  const text = gzipSync(bytes, { level: 9 }).toString("base64");
  writeFileSync(inRoot(out, `${module.inlined}.js`), `export default "${text}";\n`);
  writeFileSync(
    inRoot(out, `${module.inlined}.d.ts`),
    "declare const base64: string;\nexport default base64;\n",
  );
}
