// The action for CI.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, dirname, join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { buildCommand, command } from "../../../scripts/build/command.mjs";
import { environment } from "../../../scripts/process.mjs";
import { interchangeSquare } from "../support.mjs";

const root = fileURLToPath(new URL("../../..", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "nurbs-hausdorff-"));
after(() => rmSync(folder, { recursive: true }));
before(buildCommand);

function write(path, content) {
  mkdirSync(dirname(join(folder, path)), { recursive: true });
  writeFileSync(join(folder, path), content);
}

test("the action writes a summary and JUnit's XML", () => {
  for (const side of ["old", "new"]) {
    write(`${side}/same.json`, JSON.stringify(interchangeSquare(0)));
    write(`${side}/moved.json`, JSON.stringify(interchangeSquare(side === "old" ? 0 : 3)));
  }
  // npx finds the native command instead of a published package.
  write("bin/npx", `#!/bin/sh\nshift 2\nexec "${command}" "$@"\n`);
  spawnSync("chmod", ["+x", join(folder, "bin/npx")]);
  const [summary, junit] = ["summary.md", "report.xml"].map((name) => join(folder, name));
  const env = {
    ...environment(),
    PATH: `${join(folder, "bin")}${delimiter}${process.env.PATH}`,
    ...{ A: "old", B: "new", COMMAND: "diff", OPTIONS: "--include *same.json --limit 0.5" },
    ...{ JUNIT: junit, REUSE: join(folder, "kept"), VERSION: "latest" },
    GITHUB_STEP_SUMMARY: summary,
  };
  const script = join(root, "tools/action/compare.sh");
  const run = () => spawnSync(script, { cwd: folder, encoding: "utf8", env }).status;
  assert.equal(run(), 0);
  assert.match(readFileSync(summary, "utf8"), /^### nurbs-hausdorff diff: 1 unchanged\n/);
  assert.match(readFileSync(junit, "utf8"), /<testsuite .* tests="1" failures="0"/);
  env.OPTIONS = "--include moved*";
  assert.equal(run(), 1);
  // The inputs that the script reads are those that the action passes.
  const action = readFileSync(join(root, "action.yml"), "utf8");
  for (const name of ["A", "B", "COMMAND", "OPTIONS", "JUNIT", "REUSE", "VERSION"]) {
    assert.ok(action.includes(`        ${name}: \${{ inputs.${name.toLowerCase()} }}`), name);
  }
});
