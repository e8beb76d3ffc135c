// The crate as a wasm module with its JavaScript glue, in dist/wasm.
import { existsSync, rmSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";
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
  const sources = digest(
    [
      ...["Cargo.toml", "Cargo.lock", ".cargo", "src", "shaders"],
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
  stamp(made, sources);
  return "built";
}
