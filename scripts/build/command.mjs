// The native command for tests that run it.
import { inRoot } from "../paths.mjs";
import { must } from "../process.mjs";

export const command = inRoot("target", "release", "nurbs-hausdorff");

/** The options of Cargo with which all is compiled that is tested and not published. */
export const forTests = [
  "--release",
  "--locked",
  "--config",
  inRoot("scripts", "build", "tests.toml"),
];

/**
 * Builds the command as `cargo test` does, with the features of the tests: `cargo build` would
 * compile all dependencies once more, with others.
 */
export const buildCommand = () => must("cargo", ["test", ...forTests, "--no-run", "--test", "cli"]);
