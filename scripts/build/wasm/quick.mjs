// The wasm modules for the page and the tests, in dist/wasm: one compilation of the crate with the
// exports of all modules, without optimisation of the whole program. Each module is a copy of it.
import {
  copyFileSync,
  cpSync,
  existsSync,
  mkdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { inRoot } from "../../paths.mjs";
import { cargoProgress, environment, must } from "../../process.mjs";
import { stamp, stamped } from "../../stamp.mjs";
import { bind, compiled, inline, moduleIn, modules, sources, wasm32 } from "./modules.mjs";

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
  const args = ["build", "--release", "--locked", ...wasm32, "--lib", "--test", "wasm"];
  await must("cargo", args, { env: environment(cargoProgress()) });
  rmSync(out, { recursive: true, force: true });
  mkdirSync(out, { recursive: true });
  const [first, ...others] = modules;
  await bind(compiled("release"), out, first.name);
  for (const module of others) copy(first.name, module.name);
  for (const module of modules) inline(moduleIn(out, module), out, module.inlined, QUICK_LEVEL);
  stamp(made, `quick ${digest}`);
  return "built";
}

/** Copies a module with its glue to another name. */
function copy(from, name) {
  copyFileSync(`${out}/${from}_bg.wasm`, `${out}/${name}_bg.wasm`);
  for (const ending of [".js", ".d.ts"]) {
    const text = readFileSync(`${out}/${from}${ending}`, "utf8");
    // The glue fetches the module from beside itself.
    writeFileSync(`${out}/${name}${ending}`, text.replaceAll(`${from}_bg.wasm`, `${name}_bg.wasm`));
  }
}

/** Takes modules that were built for the package in place of quick ones. */
export function useSmall(folder) {
  rmSync(out, { recursive: true, force: true });
  mkdirSync(inRoot("dist"), { recursive: true });
  cpSync(folder, out, { recursive: true });
  stamp(made, `small ${sources()}`);
}
