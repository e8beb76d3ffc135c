// What the package's files promise.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";

const text = (path) => readFileSync(new URL(`../../${path}`, import.meta.url), "utf8");
const own = [
  "PEER_MISSING",
  "ARGUMENT_INVALID",
  "MODULE_NOT_LOADED",
  "MODULE_FAILED",
  "WORKER_FAILED",
  "DISPOSED",
];

test("the error codes are Rust's, then those of JavaScript", () => {
  const files = ["src/error/mod.rs", "src/error/trim_fault.rs"];
  const rust = [
    ...files
      .map(text)
      .join("")
      .matchAll(/=> "([A-Z_]+)"/g),
  ].map(([, code]) => code);
  const union = /export type ErrorCode =([^;]+);/.exec(text("dist/error.d.ts"))[1];
  const typescript = [...union.matchAll(/"([A-Z_]+)"/g)].map(([, code]) => code);
  assert.ok(rust.length > 15);
  assert.deepEqual(typescript, [...rust, ...own]);
});

test("the types show nothing of the module's", () => {
  const files = readdirSync(new URL("../../dist", import.meta.url), { recursive: true }).filter(
    (name) => name.endsWith(".d.ts") && !/^(wasm|command)\//.test(name),
  );
  assert.ok(files.includes("index.d.ts"));
  for (const file of files) {
    const imports = [...text(`dist/${file}`).matchAll(/from "([^"]+)"/g)].map(([, from]) => from);
    assert.ok(
      imports.every((from) => /^(\.|\.\.(\/\.\.)*)\/[a-z-/]+\.js$/.test(from)),
      `${file} imports ${imports}`,
    );
    assert.doesNotMatch(text(`dist/${file}`), /PreparedModel|Surfaces\b|\bEngine\b/, file);
  }
});

test("what the README links is packed", () => {
  const { files } = JSON.parse(text("package.json"));
  const links = [...text("README.md").matchAll(/\]\(([^):#]+)[^)]*\)/g)].map(([, link]) => link);
  const own = links.filter((link) => !link.startsWith("http"));
  assert.ok(own.length > 8);
  const isPacked = (link) =>
    files.some((file) => {
      const [folder, ending] = file.split("/*");
      const matches = ending !== undefined && link.startsWith(folder) && link.endsWith(ending);
      return matches || link === file || link.startsWith(`${file}/`);
    });
  assert.deepEqual(
    own.filter((link) => !isPacked(link)),
    [],
  );
});

test("all that the package exports is packed and exists", () => {
  const { exports, bin, files } = JSON.parse(text("package.json"));
  const entries = Object.values(exports).flatMap((entry) =>
    typeof entry === "string" ? [entry] : Object.values(entry),
  );
  const paths = [...entries, `./${bin["nurbs-hausdorff"]}`];
  assert.ok(paths.length > 4);
  for (const path of paths) {
    assert.ok(readFileSync(new URL(`../../${path}`, import.meta.url)).length > 0);
    assert.ok(files.some((folder) => path.startsWith(`./${folder}/`)));
  }
});
