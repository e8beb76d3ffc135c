// wasm-pack, wasm-bindgen and wasm-bindgen-test-runner, built from tools/ into
// the user's cache under a name made from their sources, so that another
// checkout, or this one after `git clean`, finds them there.
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

/** The folder the programs are, or are to be, in. */
export function toolsFolder() {
  const made = digest(
    ["tools/Cargo.toml", "tools/Cargo.lock", "tools/src"],
    [process.platform, process.arch],
  );
  return join(cache, `tools-${made}`);
}

/** The environment in which those programs are found first. */
export const toolsEnvironment = (more = {}) => environment({ path: [toolsFolder()], ...more });

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
  if (existsSync(folder)) return "there";

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
  // Another checkout may have finished first: one of the two is enough.
  if (existsSync(folder)) rmSync(making, { recursive: true });
  else renameSync(making, folder);
  rmSync(inRoot("tools/target"), { recursive: true, force: true });
  return `built ${programs.join(", ")}`;
}
