// The files, sections and names that the documents cite exist.
import assert from "node:assert/strict";
import { existsSync, readdirSync, readFileSync, statSync } from "node:fs";
import { dirname, join, normalize } from "node:path";
import { test } from "node:test";
import { inRoot } from "../paths.mjs";

/** Folders whose files are made or fetched. */
const MADE = new Set(["node_modules", "target", "dist", ".git", ".setup", "pkg", "site"]);

function filesBelow(folder) {
  return readdirSync(inRoot(folder), { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return MADE.has(entry.name) ? [] : filesBelow(path);
    return [path];
  });
}

const files = filesBelow(".");
const documents = files.filter((path) => path.endsWith(".md"));
const textOf = (path) => readFileSync(inRoot(path), "utf8");

/** The anchors of a document's headings, as the common renderers name them. */
function anchors(path) {
  const headings = [...textOf(path).matchAll(/^#+ +(.*)$/gm)].map(([, heading]) => heading);
  return headings.map((heading) =>
    heading
      .toLowerCase()
      .replace(/[^\p{Letter}\p{Number}\s_-]/gu, "")
      .replace(/\s/g, "-"),
  );
}

/** Why a link of a document leads nowhere, if it does. */
function broken(document, link) {
  const [path, anchor] = link.split("#");
  const target = path === "" ? document : normalize(join(dirname(document), path));
  if (!existsSync(inRoot(target))) return `${document}: there is no ${target}`;
  const isDocument = target.endsWith(".md") && statSync(inRoot(target)).isFile();
  if (anchor === undefined || !isDocument || anchors(target).includes(anchor)) return undefined;
  return `${document}: ${target} has no section #${anchor}`;
}

test("links of documents lead to files and sections", () => {
  const found = documents.flatMap((document) => {
    const links = [...textOf(document).matchAll(/\]\(([^)\s]+)\)/g)].map(([, link]) => link);
    const own = links.filter((link) => !/^[a-z]+:/.test(link));
    return own.map((link) => broken(document, link)).filter((why) => why !== undefined);
  });
  assert.deepEqual(found, []);
});

/** A file of ours in backticks, by its name or the end of its path. */
const CITED = /`([\w.-]+(?:\/[\w.-]+)*\.(?:rs|ts|mjs|wgsl|md|py))(?::\d+)?`/g;

/** Files that a command writes. */
const WRITTEN = new Set([".work/results/table.md"]);

test("files that documents cite exist", () => {
  const found = documents.flatMap((document) =>
    [...textOf(document).matchAll(CITED)]
      .map(([, cited]) => cited)
      .filter((cited) => !WRITTEN.has(cited))
      .filter((cited) => !files.some((path) => path === cited || path.endsWith(`/${cited}`)))
      .map((cited) => `${document}: ${cited}`),
  );
  assert.deepEqual(found, []);
});

test("error codes that documents cite are those of the package", () => {
  const known = textOf("src/js/error.ts");
  const sources = files
    .filter((path) => /^(src|crates)\/.*\.(rs|ts)$/.test(path))
    .map(textOf)
    .join("\n");
  const found = documents.flatMap((document) =>
    [...textOf(document).matchAll(/`([A-Z]+(?:_[A-Z]+)+)`/g)]
      .map(([, code]) => code)
      .filter((code) => !known.includes(`"${code}"`) && !sources.includes(code))
      // Entities of STEP, and secrets.
      .filter((code) => !/_(REPRESENTATION|TOKEN)$/.test(code))
      .map((code) => `${document}: ${code}`),
  );
  assert.deepEqual([...new Set(found)], []);
});

test("the tables of folders name every folder and file of src, and every crate", () => {
  const table = textOf("ARCHITECTURE.md").split("## The folders of `src`")[1];
  const named = new Set([...table.matchAll(/`([\w.-]+)`/g)].map(([, name]) => name));
  const entries = readdirSync(inRoot("src")).map((name) => name.replace(/\.rs$/, ""));
  assert.deepEqual(
    entries.filter((name) => name !== "lib" && !named.has(name)),
    [],
  );
  assert.deepEqual(
    readdirSync(inRoot("crates")).filter((name) => !named.has(name)),
    [],
  );
});
