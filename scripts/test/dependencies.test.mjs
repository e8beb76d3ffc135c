// What the project depends on: `npm test -- --only dependencies`.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { test } from "node:test";
import { root } from "../paths.mjs";
import { environment } from "../process.mjs";
import { accepted, faults, isAllowed, packages } from "./dependencies.mjs";

test("the crates' licences, versions and sources are accepted", () => {
  const crates = packages();
  assert.ok(crates.length > 100);
  assert.deepEqual(faults(crates, accepted()), []);
});

test("a licence that is not in the list is found", () => {
  const allowed = ["MIT", "Zlib"];
  for (const expression of ["MIT", "GPL-3.0 OR MIT", "GPL-3.0/MIT", "MIT AND (GPL-3.0 OR Zlib)"]) {
    assert.equal(isAllowed(expression, allowed), true, expression);
  }
  for (const expression of [
    "GPL-3.0",
    "MIT AND GPL-3.0",
    "(GPL-3.0 OR MIT) AND GPL-2.0",
    "MIT WITH LLVM-exception",
  ]) {
    assert.equal(isAllowed(expression, allowed), false, expression);
  }
  assert.equal(isAllowed("MIT WITH LLVM-exception", ["MIT WITH LLVM-exception"]), true);
});

test("crates that are not accepted are found", () => {
  const source = "registry+https://registry.example/index";
  const lists = {
    licences: ["MIT"],
    skipped: ["old@1"],
    registries: ["https://registry.example/index"],
  };
  const crate = { name: "one", version: "1.2.3", license: "MIT", source };
  const found = (...crates) => faults(crates, { ...lists, skipped: [] });
  assert.deepEqual(found(crate, { ...crate, source: null }), []);
  assert.deepEqual(found({ ...crate, license: null }), ["one 1.2.3 states no licence"]);
  assert.deepEqual(found({ ...crate, license: "GPL-3.0" }), ["one 1.2.3 has the licence GPL-3.0"]);
  assert.deepEqual(found({ ...crate, source: "git+x" }), ["one 1.2.3 is from git+x"]);
  assert.deepEqual(found(crate, { ...crate, version: "2.0.0" }), [
    "one has the versions 1.2.3, 2.0.0",
  ]);
  const old = { ...crate, name: "old" };
  assert.deepEqual(faults([old, { ...old, version: "2.0.0" }], lists), []);
  assert.deepEqual(faults([crate], lists), ["deny.toml skips old@1, which is not a dependency"]);
});

test("npm knows of no vulnerability in the npm packages", (context) => {
  const options = { cwd: root, env: environment(), encoding: "utf8" };
  const { stdout } = spawnSync("npm", ["audit", "--json"], options);
  const report = JSON.parse(stdout);
  const counts = report.metadata?.vulnerabilities;
  if (counts === undefined) {
    context.skip(`no audit: ${report.message ?? "the registry did not answer"}`);
    return;
  }
  assert.equal(counts.total, 0, stdout);
});
