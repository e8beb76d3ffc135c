// bindgen and wasm-bindgen-test-runner, built from tools/ into the user's cache. The folder
// is named after a digest of their sources, so other checkouts, and this one after `git clean`,
// reuse it.
import { chmodSync, copyFileSync, existsSync, mkdirSync, readFileSync, renameSync } from "node:fs";
import { join } from "node:path";
import { cache, inRoot } from "../paths.mjs";
import { cargoProgress, environment, Failure, must } from "../process.mjs";
import { digest } from "../stamp.mjs";

/** The programs, and the arguments by which cargo builds each. */
const PROGRAMS = {
  bindgen: ["--bin", "bindgen"],
  "wasm-bindgen-test-runner": ["--bin", "wasm-bindgen-test-runner", "--features", "runner"],
};

function bindgenVersion(lockFile) {
  const text = readFileSync(inRoot(lockFile), "utf8");
  return text.match(/name = "wasm-bindgen"\nversion = "([^"]+)"/)?.[1];
}

/** Returns the folder of the programs. */
export function toolsFolder() {
  const made = digest(
    ["tools/Cargo.toml", "tools/Cargo.lock", "tools/src"],
    [process.platform, process.arch],
  );
  return join(cache, `tools-${made}`);
}

/** Returns an environment in which these programs are found first. */
export const toolsEnvironment = (variables = {}) =>
  environment({ path: [toolsFolder()], ...variables });

/** Those of these programs that are missing. */
export const missingTools = (names) =>
  names.filter((name) => !existsSync(join(toolsFolder(), name)));

/** Builds these programs where they are missing. */
export async function tools(names) {
  const ours = bindgenVersion("Cargo.lock");
  const theirs = readFileSync(inRoot("tools/Cargo.toml"), "utf8").match(
    /wasm-bindgen-cli-support = "=([^"]+)"/,
  )?.[1];
  if (ours !== theirs) {
    throw new Failure(
      `Cargo.lock has wasm-bindgen ${ours} but tools/Cargo.toml builds ${theirs}: they must be equal`,
    );
  }
  const missing = missingTools(names);
  for (const name of missing) await build(name);
  return missing.length === 0 ? "present" : `built ${missing.join(", ")}`;
}

async function build(name) {
  const args = ["--manifest-path", "tools/Cargo.toml", "--target-dir", "tools/target"];
  const env = environment(cargoProgress());
  await must("cargo", ["build", "--locked", ...args, ...PROGRAMS[name]], { env });
  mkdirSync(toolsFolder(), { recursive: true });
  // Under another name first: another checkout may look for it, or build the same meanwhile.
  const making = join(toolsFolder(), `${name}-${process.pid}`);
  copyFileSync(inRoot("tools/target/debug", name), making);
  chmodSync(making, 0o755);
  renameSync(making, join(toolsFolder(), name));
}
