// npm run docs: the pages of the JavaScript API, by typedoc, and of the crate, by
// rustdoc, in docs/site. Needs the built package: npm run build.
import { cpSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { buildSite } from "./build/site.mjs";
import { inRoot } from "./paths.mjs";
import { environment, Failure, must } from "./process.mjs";
import { siteGenerator } from "./setup/packages.mjs";

const site = inRoot("docs", "site");
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
  await siteGenerator.install();
  await buildSite(inRoot("docs", "site", "js"));
  await rust();
  writeFileSync(inRoot("docs", "site", "index.html"), index);
  console.log("docs: docs/site/index.html");
} catch (error) {
  if (!(error instanceof Failure)) throw error;
  console.error(error.message);
  process.exitCode = 1;
}
