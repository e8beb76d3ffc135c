// The package's TypeScript API, compiled with its types from src/js into dist.
import { chmodSync, copyFileSync, existsSync, readdirSync, rmSync } from "node:fs";
import { inRoot } from "../paths.mjs";
import { must } from "../process.mjs";
import { digest, stamp, stamped } from "../stamp.mjs";

const made = ".setup/api-made-from";

export async function buildApi() {
  const sources = digest([
    "src/js",
    "tsconfig.json",
    "tsconfig.cli.json",
    "tsconfig.base.json",
    "package-lock.json",
    "dist/wasm/nurbs_hausdorff.d.ts",
  ]);
  if (stamped(made, sources) && existsSync(inRoot("dist/index.js"))) return "unchanged";
  for (const name of readdirSync(inRoot("dist"))) {
    if (name !== "wasm") rmSync(inRoot("dist", name), { recursive: true });
  }
  await must("tsc", ["--project", "tsconfig.json"]);
  await must("tsc", ["--project", "tsconfig.cli.json"]);
  for (const file of ["options.json", "reports/report.css"]) {
    copyFileSync(inRoot(`src/js/cli/${file}`), inRoot(`dist/cli/${file}`));
  }
  // npm makes the command executable when it installs the package.
  chmodSync(inRoot("dist/cli/main.js"), 0o755);
  stamp(made, sources);
  return "built";
}
