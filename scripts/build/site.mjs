// The pages of the JavaScript API, by typedoc, from the declarations that are published.
import { existsSync } from "node:fs";
import { inRoot } from "../paths.mjs";
import { Failure, must } from "../process.mjs";

/** The entries of the package that have an API. */
const entries = ["index", "worker/index", "cad/index", "adapters/index"];

/**
 * Makes the pages in this folder. Broken links and references in the comments, the README or
 * the list of examples are errors. Needs the built package and the set-up of typedoc.
 */
export async function buildSite(folder) {
  if (!existsSync(inRoot("dist", "index.d.ts"))) throw new Failure("npm run build first");
  const highlighted = ["javascript", "python", "rust", "sh"];
  const languages = highlighted.flatMap((name) => ["--highlightLanguages", name]);
  const files = entries.flatMap((name) => ["--entryPoints", inRoot("dist", `${name}.d.ts`)]);
  await must("node", [
    inRoot("tools", "site", "node_modules", "typedoc", "bin", "typedoc"),
    ...files,
    ...languages,
    ...["--tsconfig", inRoot("tools", "site", "tsconfig.json")],
    ...["--name", "nurbs-hausdorff", "--out", folder],
    ...["--projectDocuments", inRoot("examples", "js", "README.md")],
    ...["--readme", inRoot("README.md"), "--disableSources", "--treatWarningsAsErrors"],
  ]);
}
