// The Rust toolchain, its wasm32 target, and the components the tests use.
import { existsSync } from "node:fs";
import { join } from "node:path";
import { ask, Failure, must, which } from "../process.mjs";

const target = "wasm32-unknown-unknown";

const parts = {
  target: {
    present: (sysroot) => existsSync(join(sysroot, "lib/rustlib", target)),
    add: ["target", "add", target],
  },
  components: {
    present: (sysroot) =>
      ["cargo-clippy", "rustfmt"].every((name) => existsSync(join(sysroot, "bin", name))),
    add: ["component", "add", "clippy", "rustfmt"],
  },
};

const sysrootOfRust = () => ask("rustc", ["--print", "sysroot"])?.trim();

const absent = (names, sysroot) =>
  names.map((name) => parts[name]).filter((part) => !part.present(sysroot));

/** The target and the components that are missing; none where there is no Rust. */
export function missingParts(...names) {
  const sysroot = sysrootOfRust();
  return sysroot ? absent(names, sysroot).flatMap((part) => part.add.slice(2)) : [];
}

export async function rust(...names) {
  const sysroot = sysrootOfRust();
  if (!sysroot || !which("cargo")) {
    throw new Failure("please install Rust with rustup, then start again");
  }
  const missing = absent(names, sysroot);
  if (missing.length === 0) return "present";
  if (!which("rustup")) {
    const parameters = missing.map((part) => part.add.slice(2).join(" ")).join(" ");
    throw new Failure(
      `rustup is missing: please add ${parameters} to your Rust installation, then start again`,
    );
  }
  for (const part of missing) await must("rustup", part.add);
  return `added ${missing.map((part) => part.add.slice(2).join(", ")).join(", ")}`;
}
