// The crate as a wasm module with its JavaScript glue, in dist/wasm.
import { existsSync, rmSync } from "node:fs";
import { inRoot } from "../paths.mjs";
import { must } from "../process.mjs";
import { toolsEnvironment, toolsFolder } from "../setup/tools.mjs";
import { digest, stamp, stamped } from "../stamp.mjs";

const out = "dist/wasm";
const made = ".setup/wasm-made-from";

export const wasmFile = `${out}/nurbs_hausdorff_bg.wasm`;

export async function buildWasm() {
  const sources = digest(
    ["Cargo.toml", "Cargo.lock", "build.rs", ".cargo", "src", "shaders", "package-lock.json"],
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
      "--profile",
      "wasm",
      "--target",
      "web",
      "--out-dir",
      out,
    ],
    { env: toolsEnvironment() },
  );
  // It tells npm to leave the folder out of the package.
  rmSync(inRoot(out, ".gitignore"), { force: true });
  stamp(made, sources);
  return "built";
}
