// The native command for tests that run it.
import { inRoot } from "../paths.mjs";
import { must } from "../process.mjs";

export const command = inRoot("target", "release", "nurbs-hausdorff");

/**
 * Builds the command as `cargo test` does, with the features of the tests: `cargo build` would
 * compile all dependencies once more, with others.
 */
export const buildCommand = () =>
  must("cargo", ["test", "--release", "--locked", "--no-run", "--test", "cli"]);
