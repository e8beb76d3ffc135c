// The Python package: its wheel, installed in an environment of its own, and its tests.
import { existsSync, readdirSync, rmSync } from "node:fs";
import { join } from "node:path";
import { cache, inRoot } from "../paths.mjs";
import { ask, environment, Failure, must } from "../process.mjs";

/** The environment that all checkouts share: the builder, and what the tests import. */
export const home = join(cache, "python-1");
export const program = (name) => join(home, "bin", name);
export const packages = ["maturin>=1.9,<2", "numpy", "pytest", "mypy"];

/** Why the step is skipped, if Python or its packages cannot be had. */
async function missing() {
  const version = ask("python3", ["-c", "import sys; print(sys.version_info >= (3, 10))"]);
  if (version?.trim() !== "True") return "there is no Python 3.10 or newer";
  if (existsSync(program("maturin")) && existsSync(program("mypy"))) return undefined;
  rmSync(home, { recursive: true, force: true });
  try {
    await must("python3", ["-m", "venv", home]);
    await must(program("pip"), ["install", "--quiet", ...packages]);
  } catch (error) {
    if (!(error instanceof Failure)) throw error;
    rmSync(home, { recursive: true, force: true });
    return `its packages cannot be installed: ${error.message.split("\n")[0]}`;
  }
  return undefined;
}

/** Builds and installs the wheel, and tests it as users have it. */
export async function testPython() {
  const why = await missing();
  if (why !== undefined) {
    const line = `SKIPPED python: ${why}`;
    console.log(line);
    return line;
  }
  const wheels = inRoot("target", "python-wheels");
  rmSync(wheels, { recursive: true, force: true });
  // Of the main crate, whose dependencies are compiled with the same profile.
  const target = { CARGO_TARGET_DIR: inRoot("target") };
  const options = ["--release", "--locked", "--out", wheels];
  await must(program("maturin"), ["build", ...options], {
    cwd: inRoot("python"),
    env: environment({ ...target, VIRTUAL_ENV: home }),
  });
  const [wheel] = readdirSync(wheels);
  const install = ["install", "--quiet", "--no-deps", "--force-reinstall", join(wheels, wheel)];
  await must(program("pip"), install);
  await must(program("mypy"), ["--strict", "nurbs_hausdorff"], { cwd: inRoot("python") });
  // Beside the tests, not beside the sources, which are not what users import.
  return must(program("pytest"), ["-v", "-rs", "--import-mode=importlib", "."], {
    cwd: inRoot("python", "tests"),
  });
}
