// The package's TypeScript API and its command, compiled with their types from src/js into dist.
import { chmodSync, existsSync, readdirSync, rmSync } from "node:fs";
import { inRoot } from "../paths.mjs";
import { must } from "../process.mjs";
import { digest, stamp, stamped } from "../stamp.mjs";

const made = ".setup/api-made-from";

export async function buildApi() {
  const sources = digest([
    "src/js",
    "tsconfig.json",
    "tsconfig.command.json",
    "tsconfig.base.json",
    "package-lock.json",
    "dist/wasm/nurbs_hausdorff.d.ts",
  ]);
  if (stamped(made, sources) && existsSync(inRoot("dist/index.js"))) return "unchanged";
  for (const name of readdirSync(inRoot("dist"))) {
    if (name !== "wasm") rmSync(inRoot("dist", name), { recursive: true });
  }
  await must("tsc", ["--project", "tsconfig.json"]);
  await must("tsc", ["--project", "tsconfig.command.json"]);
  // npm makes the command executable when it installs the package.
  chmodSync(inRoot("dist/command/main.js"), 0o755);
  stamp(made, sources);
  return "built";
}
