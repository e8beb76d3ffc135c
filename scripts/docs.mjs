// npm run docs: the pages of the JavaScript API, by typedoc, and of the crate, by
// rustdoc, in docs/site. Needs the built package: npm run build.
import { cpSync, existsSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { inRoot } from "./paths.mjs";
import { environment, Failure, must } from "./process.mjs";

const site = inRoot("docs", "site");
const generator = inRoot("tools", "site");

/** The entries of the package that have an API. */
const entries = ["index", "worker/index", "cad/index", "worker/cad/index", "adapters/index"];

const index = `<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>nurbs-hausdorff</title>
<style>body { font: 1.1rem/1.6 system-ui; max-width: 40rem; margin: 3rem auto; padding: 0 1rem }</style>
<h1>nurbs-hausdorff</h1>
<p>Certified Hausdorff distance between NURBS models.</p>
<ul>
<li><a href="js/index.html">JavaScript</a>: the package, its worker, files and adapters</li>
<li><a href="rust/nurbs_hausdorff/index.html">Rust</a>: the crate</li>
</ul>
`;

/** Makes the pages of the JavaScript API, from the declarations that are published. */
async function javascript() {
  if (!existsSync(inRoot("dist", "index.d.ts"))) throw new Failure("npm run build first");
  if (!existsSync(inRoot("tools", "site", "node_modules"))) {
    await must("npm", ["ci", "--no-audit", "--no-fund"], { cwd: generator });
  }
  const typedoc = inRoot("tools", "site", "node_modules", "typedoc", "bin", "typedoc");
  const languages = ["javascript", "rust", "sh"].flatMap((name) => ["--highlightLanguages", name]);
  const files = entries.flatMap((name) => ["--entryPoints", inRoot("dist", `${name}.d.ts`)]);
  await must("node", [
    typedoc,
    ...files,
    ...languages,
    ...["--tsconfig", inRoot("tools", "site", "tsconfig.json")],
    ...["--name", "nurbs-hausdorff", "--out", inRoot("docs", "site", "js")],
    ...["--projectDocuments", inRoot("examples", "js", "README.md")],
    ...["--readme", inRoot("README.md"), "--disableSources", "--treatWarningsAsErrors"],
  ]);
}

/** Makes the pages of the crate. */
async function rust() {
  await must("cargo", ["doc", "--release", "--locked", "--no-deps"], {
    env: environment({ RUSTDOCFLAGS: "-D warnings" }),
  });
  cpSync(inRoot("target", "doc"), inRoot("docs", "site", "rust"), { recursive: true });
}

try {
  rmSync(site, { recursive: true, force: true });
  mkdirSync(site, { recursive: true });
  await javascript();
  await rust();
  writeFileSync(inRoot("docs", "site", "index.html"), index);
  console.log("docs: docs/site/index.html");
} catch (error) {
  if (!(error instanceof Failure)) throw error;
  console.error(error.message);
  process.exitCode = 1;
}
