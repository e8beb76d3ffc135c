// Many pairs on Ray and on Spark, by the wheel that the step `python` installed.
import { buildCommand, command } from "../build/command.mjs";
import { inRoot } from "../paths.mjs";
import { environment, must } from "../process.mjs";
import { program, skipped } from "./python.mjs";

export async function testEngines() {
  const line = skipped("engines");
  if (line !== undefined) return line;
  await buildCommand();
  return must(program("pytest"), ["-v", "-rs", "--import-mode=importlib", "."], {
    cwd: inRoot("examples", "batch"),
    env: environment({ NURBS_HAUSDORFF: command }),
  });
}
