// Many pairs on Ray and on Spark, by the wheel that the step `python` installed.
import { existsSync } from "node:fs";
import { inRoot } from "../paths.mjs";
import { ask, environment, Failure, must } from "../process.mjs";
import { program } from "./python.mjs";

const packages = ["ray[data]>=2.50,<3", "pyspark>=4,<5", "pandas>=2,<3", "pyarrow"];

/** Why the step is skipped, if Python, its packages or Java cannot be had. */
async function missing() {
  if (!existsSync(program("pytest"))) return "there is no Python of the step `python`";
  if (ask(program("python"), ["-c", "import ray.data, pyspark, pandas, pyarrow"]) === undefined) {
    try {
      await must(program("pip"), ["install", "--quiet", ...packages]);
    } catch (error) {
      if (!(error instanceof Failure)) throw error;
      return `its packages cannot be installed: ${error.message.split("\n")[0]}`;
    }
  }
  return undefined;
}

export async function testEngines() {
  const why = await missing();
  if (why !== undefined) {
    const line = `SKIPPED engines: ${why}`;
    console.log(line);
    return line;
  }
  await must("cargo", ["build", "--release", "--locked", "--bin", "nurbs-hausdorff"]);
  const tool = { NURBS_HAUSDORFF: inRoot("target", "release", "nurbs-hausdorff") };
  return must(program("pytest"), ["-v", "-rs", "--import-mode=importlib", "."], {
    cwd: inRoot("examples", "batch"),
    env: environment(tool),
  });
}
