// The wasm modules as they are published: each a crate with the exports of one feature, optimised as
// a whole and for its size.
import { existsSync, mkdirSync, rmSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";
import { inRoot } from "../../paths.mjs";
import { environment, must, say } from "../../process.mjs";
import { stamp, stamped } from "../../stamp.mjs";
import { bind, chosen, compiled, inline, moduleIn, modules, sources, wasm32 } from "./modules.mjs";

/** The folder of the modules. */
export const small = inRoot("target", "small-wasm");
const made = ".setup/small-wasm-made-from";

/** The best compression of gzip. */
const SMALLEST_LEVEL = 9;

// Panic messages name source files without the folders of this machine. Cargo
// adds these flags to those of .cargo/config.toml.
const remapped = `--remap-path-prefix=${process.env.CARGO_HOME || join(homedir(), ".cargo")}=cargo`;

// LLVM inlines functions up to a size of 225. Up to 150 the core was 25 KiB smaller, gzipped, and the
// reference pairs took 1.01 to 1.03 times as long in Node. A little code more may make it inline much more:
// a field of a face made the core 24 KiB larger. Up to 75 it is 10 KiB smaller than up to 100, 691 KiB, and
// the reference pairs with four pairs in other parameters take 1.00 times as long.
// A module with a warning is not published: each is checked with its own features here.
const rustFlags = `${remapped} -Cllvm-args=--inline-threshold=75 -Dwarnings`;

/** wasm-opt accepts only the features of WebAssembly that are named. */
const OPTIMISED = [
  ...["-O3", "--enable-bulk-memory", "--enable-multivalue", "--enable-mutable-globals"],
  ...["--enable-nontrapping-float-to-int", "--enable-reference-types", "--enable-sign-ext"],
  "--enable-simd",
];

/** Builds the modules, unless they are of these sources. */
export async function buildSmall() {
  const digest = sources();
  if (stamped(made, digest) && existsSync(small)) return "unchanged";
  rmSync(small, { recursive: true, force: true });
  mkdirSync(small, { recursive: true });
  for (const [index, module] of modules.entries()) {
    say(`module ${index + 1} of ${modules.length}: ${module.name}`);
    await build(module);
  }
  stamp(made, digest);
  return "built";
}

async function build(module) {
  const { name, inlined } = module;
  const env = environment({ CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS: rustFlags });
  const profile = ["--profile", "wasm", "--locked", "--lib"];
  await must("cargo", ["build", ...profile, ...wasm32, ...chosen([module])], { env });
  await bind(compiled("wasm", module), small, name);
  const file = `${small}/${name}_bg.wasm`;
  await must("wasm-opt", [file, "-o", file, ...OPTIMISED]);
  inline(moduleIn(small, module), small, inlined, SMALLEST_LEVEL);
}
