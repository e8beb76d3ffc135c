// The page's own module, in www/wasm: the colours, which its main thread has from the start.
import { existsSync, mkdirSync, rmSync } from "node:fs";
import { inRoot } from "../../paths.mjs";
import { environment, must } from "../../process.mjs";
import { toolsFolder } from "../../setup/tools.mjs";
import { digest, stamp, stamped } from "../../stamp.mjs";
import { bind, compiled, embed, moduleIn, wasm32 } from "./modules.mjs";

const made = ".setup/colors-made-from";
const out = inRoot("www", "wasm");

/** The module's crate. */
export const colors = { name: "nurbs_hausdorff_colors", crate: "nurbs-hausdorff-colors" };

const sources = () =>
  digest(["Cargo.toml", "Cargo.lock", "crates/colors", "scripts/build/wasm"], [toolsFolder()]);

/** Whether the module is of these sources. */
export const areColorsBuilt = () => stamped(made, sources()) && existsSync(out);

/** Builds the module, unless it is of these sources. */
export async function buildColors() {
  if (areColorsBuilt()) return "unchanged";
  const args = ["build", "--release", "--locked", "--lib", `--package=${colors.crate}`];
  await must("cargo", [...args, ...wasm32], { env: environment() });
  rmSync(out, { recursive: true, force: true });
  mkdirSync(out, { recursive: true });
  await bind(compiled("release", colors), out, colors.name);
  embed(moduleIn(out, colors), out, "inlined-colors");
  stamp(made, sources());
  return "built";
}
