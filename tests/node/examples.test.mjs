// The examples of examples/js, run as users run them.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { interchangeSquare } from "./support.mjs";

const folder = fileURLToPath(new URL("../../examples/js", import.meta.url));
const tested = new Set();

let files;
before(() => {
  files = mkdtempSync(join(tmpdir(), "nurbs-hausdorff-examples-"));
  for (const [name, z] of [
    ["ground", 0],
    ["above", 0.5],
  ]) {
    writeFileSync(join(files, `${name}.json`), JSON.stringify(interchangeSquare(z)));
  }
});
after(() => rmSync(files, { recursive: true }));

const file = (name) => join(files, `${name}.json`);

function run(name, ...args) {
  tested.add(name);
  const options = { encoding: "utf8" };
  const { status, stdout, stderr } = spawnSync("node", [join(folder, name), ...args], options);
  return { status, stdout, stderr };
}

test("two surfaces are compared", () => {
  const { status, stdout, stderr } = run("compare.mjs");
  assert.equal(status, 0, stderr);
  const [, lower, upper] = stdout.match(/^between (\S+) and (\S+)$/m).map(Number);
  // The distance from B is largest at the raised corner of A.
  assert.ok(lower <= 0.25 && 0.25 <= upper && upper - lower < 1e-8, stdout);
  assert.match(stdout, /farthest at 1,1,0.25, u 1, v 1/);
});

test("a limit passes, fails or is refused by its exit status", () => {
  const status = (...args) => run("pass-fail.mjs", ...args).status;
  assert.equal(status(file("ground"), file("above"), "0.6"), 0);
  assert.equal(status(file("ground"), file("above"), "0.4"), 1);
  assert.equal(status(file("ground"), file("above"), "-1"), 2);
});

test("a mesh is coloured", () => {
  const { status, stdout, stderr } = run("colours.mjs");
  assert.equal(status, 0, stderr);
  assert.match(stdout, /^2425 vertices, at most \d/);
});

test("a surface deforms", () => {
  const { status, stdout, stderr } = run("deforming.mjs");
  assert.equal(status, 0, stderr);
  const frames = stdout.trim().split("\n");
  assert.equal(frames.length, 10);
  assert.match(frames[0], /between 0.00000 and 0.0000/);
  assert.doesNotMatch(frames[9], /between 0.0000/);
});

test("the faces of files are compared", () => {
  const { status, stdout, stderr } = run("files.mjs", file("ground"), file("above"), "0.001");
  assert.equal(status, 0, stderr);
  assert.match(stdout, /A, face 0: changed, at most 0.5/);
  assert.match(stdout, /the models are changed/);
});

test("every example is run and listed", () => {
  const examples = readdirSync(folder).filter((name) => name.endsWith(".mjs"));
  assert.deepEqual([...tested].sort(), examples.sort());
  const list = readFileSync(join(folder, "README.md"), "utf8");
  for (const name of examples) assert.ok(list.includes(`\`${name}\``), name);
});
