// wasm-pack, wasm-bindgen and wasm-bindgen-test-runner, built from tools/ into
// the user's cache. The folder is named after a digest of their sources, so
// other checkouts, and this one after `git clean`, reuse it.
import {
  chmodSync,
  copyFileSync,
  existsSync,
  mkdirSync,
  readFileSync,
  renameSync,
  rmSync,
} from "node:fs";
import { join } from "node:path";
import { cache, inRoot } from "../paths.mjs";
import { environment, Failure, must } from "../process.mjs";
import { digest } from "../stamp.mjs";

const programs = ["wasm-pack", "wasm-bindgen", "wasm-bindgen-test-runner"];

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

export async function tools() {
  const ours = bindgenVersion("Cargo.lock");
  const theirs = readFileSync(inRoot("tools/Cargo.toml"), "utf8").match(
    /wasm-bindgen-cli = .*"=([^"]+)"/,
  )?.[1];
  if (ours !== theirs) {
    throw new Failure(
      `Cargo.lock has wasm-bindgen ${ours} but tools/Cargo.toml builds ${theirs}: they must be equal`,
    );
  }

  const folder = toolsFolder();
  if (existsSync(folder)) return "present";

  await must("cargo", [
    "build",
    "--locked",
    "--manifest-path",
    "tools/Cargo.toml",
    "--target-dir",
    "tools/target",
  ]);
  const making = `${folder}-${process.pid}`;
  mkdirSync(making, { recursive: true });
  for (const name of programs) {
    copyFileSync(inRoot("tools/target/debug", name), join(making, name));
    chmodSync(join(making, name), 0o755);
  }
  // Another checkout may have built the same programs meanwhile.
  if (existsSync(folder)) rmSync(making, { recursive: true });
  else renameSync(making, folder);
  rmSync(inRoot("tools/target"), { recursive: true, force: true });
  return `built ${programs.join(", ")}`;
}
