// The crate as a wasm module with its JavaScript glue, in dist/wasm.
import { existsSync, rmSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";
import { inRoot } from "../paths.mjs";
import { must } from "../process.mjs";
import { toolsEnvironment, toolsFolder } from "../setup/tools.mjs";
import { digest, stamp, stamped } from "../stamp.mjs";
import { shortenImports } from "./imports.mjs";
import { takeObjects } from "./objects.mjs";
import { trapPanics } from "./panics.mjs";
import { blankUnused } from "./unused.mjs";

const out = "dist/wasm";
const made = ".setup/wasm-made-from";

// More is inlined than LLVM would for least size: at 25 the search in float64
// takes a tenth longer, and at 50 the module is 1 KiB larger, gzipped, for
// nothing. With its relocations the linker tells where the data's objects lie.
// Panics name their places, which shall not name this machine's folders.
const rustFlags = [
  "-Cllvm-args=-inline-threshold=30",
  "-Clink-arg=--emit-relocs",
  `--remap-path-prefix=${process.env.CARGO_HOME || join(homedir(), ".cargo")}=cargo`,
].join("\u001f");

// Functions inlined into their only caller make few functions with many locals,
// which gzip worse, as do values kept in locals instead of computed again.
// Nothing lies below address 1024: the linker begins with the stack's far end.
const optimizations = [
  "-Oz",
  "--converge",
  "--low-memory-unused",
  "--one-caller-inline-max-function-size=20",
  "--skip-pass=local-cse",
  // Instances of one generic function side by side, where gzip sees them.
  "--reorder-functions-by-name",
  // Hints that engines do without; equal instructions of equal bytes gzip better.
  "--dealign",
];

export const wasmFile = `${out}/nurbs_hausdorff_bg.wasm`;
const glueFile = `${out}/nurbs_hausdorff.js`;

export async function buildWasm() {
  const sources = digest(
    [
      ...["Cargo.toml", "Cargo.lock", "build.rs", ".cargo", "src", "shaders"],
      ...["package-lock.json", "scripts/build"],
    ],
    [toolsFolder()],
  );
  if (stamped(made, sources) && existsSync(inRoot(wasmFile))) return "unchanged";
  rmSync(inRoot(out), { recursive: true, force: true });
  await must(
    "wasm-pack",
    // Nothing is downloaded: the tools are all on PATH. Our package.json
    // describes the package, so wasm-pack shall write none.
    [
      "build",
      "--mode",
      "no-install",
      "--no-pack",
      "--no-opt",
      "--profile",
      "wasm",
      "--target",
      "web",
      "--out-dir",
      out,
    ],
    { env: toolsEnvironment({ CARGO_ENCODED_RUSTFLAGS: rustFlags }) },
  );
  const objects = takeObjects(inRoot(wasmFile));
  await trapPanics(inRoot(wasmFile));
  await must("wasm-opt", [inRoot(wasmFile), "-o", inRoot(wasmFile), ...optimizations]);
  await blankUnused(inRoot(wasmFile), objects);
  shortenImports(inRoot(wasmFile), inRoot(glueFile));
  // It tells npm to leave the folder out of the package.
  rmSync(inRoot(out, ".gitignore"), { force: true });
  stamp(made, sources);
  return "built";
}
