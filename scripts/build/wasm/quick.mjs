// The wasm modules for the page and the tests, in dist/wasm: one compilation of the crates with the
// exports of all modules, without optimisation of the whole program.
import { cpSync, existsSync, mkdirSync, rmSync } from "node:fs";
import { inRoot } from "../../paths.mjs";
import { cargoProgress, environment, must } from "../../process.mjs";
import { stamp, stamped } from "../../stamp.mjs";
import { forTests } from "../command.mjs";
import { bind, chosen, compiled, inline, moduleIn, modules, sources, wasm32 } from "./modules.mjs";

const made = ".setup/wasm-made-from";
const out = inRoot("dist", "wasm");

/** Compression that takes no time to speak of. */
const QUICK_LEVEL = 1;

/** Whether the modules are of these sources; those of `npm run build` serve as well. */
export function areBuilt(digest = sources()) {
  const present = existsSync(inRoot("dist", "wasm", "inlined-scans.js"));
  return present && [`quick ${digest}`, `small ${digest}`].some((value) => stamped(made, value));
}

/** Builds the modules, unless they are of these sources. */
export async function buildQuick() {
  const digest = sources();
  if (areBuilt(digest)) return "unchanged";
  // With the test of wasm: its features are those of all modules, and both are compiled once.
  const args = ["build", ...forTests, ...wasm32, ...chosen(modules)];
  const what = ["--lib", "--test", "wasm"];
  await must("cargo", [...args, ...what], { env: environment(cargoProgress()) });
  rmSync(out, { recursive: true, force: true });
  mkdirSync(out, { recursive: true });
  for (const module of modules) {
    await bind(compiled("release", module), out, module.name);
    inline(moduleIn(out, module), out, module.inlined, QUICK_LEVEL);
  }
  stamp(made, `quick ${digest}`);
  return "built";
}

/** Takes modules that were built for the package in place of quick ones. */
export function useSmall(folder) {
  rmSync(out, { recursive: true, force: true });
  mkdirSync(inRoot("dist"), { recursive: true });
  cpSync(folder, out, { recursive: true });
  stamp(made, `small ${sources()}`);
}
