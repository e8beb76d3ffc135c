// The crate as a wasm module with its JavaScript glue, in dist/wasm.
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
const rustFlags = `--remap-path-prefix=${process.env.CARGO_HOME || join(homedir(), ".cargo")}=cargo`;

export const wasmFile = `${out}/nurbs_hausdorff_bg.wasm`;

export async function buildWasm() {
  // The TypeScript in src/js is no part of the module.
  const rust = readdirSync(inRoot("src")).filter((name) => name !== "js");
  const sources = digest(
    [
      ...["Cargo.toml", "Cargo.lock", ".cargo", "shaders", ...rust.map((name) => `src/${name}`)],
      ...["package-lock.json", "scripts/build"],
    ],
    [toolsFolder()],
  );
  if (stamped(made, sources) && existsSync(inRoot(wasmFile))) return "unchanged";
  rmSync(inRoot(out), { recursive: true, force: true });
  await must(
    "wasm-pack",
    // All tools are on PATH, so wasm-pack downloads none. It writes no
    // package.json, because the package has its own.
    [
      ...["build", "--mode", "no-install", "--no-pack"],
      ...["--profile", "wasm", "--target", "web", "--out-dir", out],
    ],
    { env: toolsEnvironment({ CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS: rustFlags }) },
  );
  // This file would make npm exclude the folder from the package.
  rmSync(inRoot(out, ".gitignore"), { force: true });
  inline();
  stamp(made, sources);
  return "built";
}

/** Writes the module as a JavaScript string: gzipped, in base64. */
function inline() {
  const text = gzipSync(readFileSync(inRoot(wasmFile)), { level: 9 }).toString("base64");
  writeFileSync(inRoot(out, "inlined.js"), `export default "${text}";\n`);
  writeFileSync(
    inRoot(out, "inlined.d.ts"),
    "declare const base64: string;\nexport default base64;\n",
  );
}
