// Directories against directories, by both command lines, and the action for CI.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, dirname, join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { buildCommand, command as native } from "../../../scripts/build/command.mjs";
import { environment } from "../../../scripts/process.mjs";
import { interchangeSquare } from "../support.mjs";

const root = fileURLToPath(new URL("../../..", import.meta.url));
const main = join(root, "dist/cli/main.js");
const COMMANDS = [[process.execPath, main], [native]];
const folder = mkdtempSync(join(tmpdir(), "nurbs-hausdorff-"));
after(() => rmSync(folder, { recursive: true }));

function write(path, content) {
  mkdirSync(dirname(join(folder, path)), { recursive: true });
  writeFileSync(join(folder, path), content);
}

before(async () => {
  await buildCommand();
  const square = (z) => JSON.stringify(interchangeSquare(z));
  for (const side of ["old", "new"]) {
    write(`${side}/same.json`, square(0));
    write(`${side}/sub/moved <&>_*|.json`, square(side === "old" ? 0 : 3));
    write(`${side}/broken.json`, "{");
    write(`${side}/notes.md`, "no model");
  }
  write("old/gone.json", square(0));
  write("new/Ünew.JSON", square(0));
});

/** The outcomes of both command lines, which must end with the same status. */
function both(...args) {
  const options = { cwd: folder, encoding: "utf8", env: environment() };
  const outcomes = COMMANDS.map(([program, ...rest]) =>
    spawnSync(program, [...rest, ...args], options),
  );
  assert.equal(outcomes[0].status, outcomes[1].status, outcomes[0].stderr + outcomes[1].stderr);
  return outcomes;
}

/** Without what rounding and the machine decide. */
const plain = (text) =>
  text
    // Other programs compress: pictures.test.mjs compares the pixels.
    .replace(/ src="data:image\/png;base64,[^"]*"/g, "")
    .replace(/-?\d+(\.\d+)?(e-?\d+)?/g, (number) => Number(Number(number).toFixed(6)))
    .replace(/ at -?\d+ -?\d+ (-?\d+)/g, " at $1")
    .replace(/\btime="[^"]*"/g, "")
    .replace(/JSON_SHAPE: .*?(?=[|<"\n])/g, "JSON_SHAPE");

for (const format of ["text", "junit", "markdown", "html"]) {
  for (const command of ["diff", "distance"]) {
    test(`both print the same ${format} of directories by ${command}`, () => {
      const [ours, theirs] = both(command, "old", "new", "--format", format);
      assert.equal(ours.status, 2);
      assert.equal(plain(ours.stdout), plain(theirs.stdout));
      assert.match(ours.stdout, /moved/);
    });
  }
}

test("both make the same page of one pair: verdict, what is allowed, hashes and faces", () => {
  const pair = ["old", "new"].map((side) => `${side}/sub/moved <&>_*|.json`);
  const [ours, theirs] = both("diff", ...pair, "--format", "html", "--limit", "2");
  assert.equal(ours.status, 1);
  assert.equal(plain(ours.stdout), plain(theirs.stdout));
  for (const path of pair) {
    const hash = createHash("sha256").update(readFileSync(join(folder, path)));
    assert.ok(ours.stdout.includes(`<td>${hash.digest("hex")}</td><td>0</td>`), path);
  }
  assert.match(ours.stdout, /<b class="badge">FAIL<\/b>/);
  assert.match(ours.stdout, /<dt>Allowed deviation<\/dt><dd>2\.0<\/dd>/);
  // The squares are 3 apart.
  const face = /<td>A face 0<\/td><td>changed<\/td><td>(.*?)<\/td><td>(.*?)<\/td>/;
  const [, lower, upper] = face.exec(ours.stdout) ?? [];
  assert.ok(Number(lower) <= 3 && 3 <= Number(upper), `${lower} ${upper}`);
  // Every face is 3 apart, in the last of the bins up to 3, and 2 is allowed: at two thirds of them.
  const svg = /<svg class="histogram".*?<\/svg>/s.exec(ours.stdout)?.[0] ?? "";
  assert.deepEqual(
    [...svg.matchAll(/<rect x="(\d+)" y="0"[^>]*\/><text[^>]*>(\d+)</g)].map(([, ...bar]) => bar),
    [["571", "2"]],
  );
  const [, at] = /class="limit" d="M(\d+),/.exec(svg) ?? [];
  assert.ok(Math.abs(Number(at) - 400) <= 1, at);
  assert.match(svg, /allowed 2\.0</);
  // Without a limit nothing is judged.
  const named = ["--part", "Bracket <7>", "--operator", "N. N."];
  const [plainly, theirsPlainly] = both("distance", ...pair, "--format", "html", ...named);
  assert.equal(plain(plainly.stdout), plain(theirsPlainly.stdout));
  assert.match(plainly.stdout, /NO VERDICT/);
  assert.match(plainly.stdout, /<dt>Part<\/dt><dd>Bracket &lt;7&gt;<\/dd>\n<dt>Operator/);
});

test("both print the same JSON of directories", () => {
  const [ours, theirs] = both("diff", "old", "new", "--json").map(({ stdout }) =>
    JSON.parse(stdout),
  );
  assert.deepEqual(Object.keys(ours), Object.keys(theirs));
  const rows = ({ pairs }) =>
    pairs.map(({ path, state, result, error }) => {
      return {
        path,
        state,
        code: error?.code,
        faces: result?.facesOfA.length,
        files: result?.files,
      };
    });
  assert.deepEqual(rows(ours), rows(theirs));
  assert.deepEqual(
    rows(ours).map(({ path, state }) => `${path} ${state}`),
    [
      "broken.json error",
      "gone.json removed",
      "same.json unchanged",
      "sub/moved <&>_*|.json changed",
      "Ünew.JSON added",
    ],
  );
});

for (const [include, status] of [
  ["*.json", 2],
  ["same.*", 0],
  ["*/same.json", 2],
  ["moved*", 1],
  ["**/{same,moved*}.json", 1],
  ["nothing.*", 2],
]) {
  test(`both include ${include}`, () => {
    const [ours, theirs] = both("diff", "old", "new", "--include", include);
    assert.equal(ours.status, status, ours.stdout);
    assert.equal(plain(ours.stdout), plain(theirs.stdout));
  });
}

test("answers are used again for the same content and options alone", () => {
  for (const [index, [program, ...rest]] of COMMANDS.entries()) {
    const kept = join(folder, `kept-${index}`);
    const run = (...more) => {
      const args = [...rest, "diff", "old", "new", "--json", "--reuse", kept, ...more];
      return spawnSync(program, args, { cwd: folder, encoding: "utf8", env: environment() }).stdout;
    };
    const first = run();
    assert.equal(readdirSync(kept).length, 2);
    // The times too: nothing was computed.
    assert.equal(run(), first);
    run("--limit", "5");
    assert.equal(readdirSync(kept).length, 4);
  }
});

test("a directory beside a file, and two formats, are refused", () => {
  for (const args of [
    ["diff", "old", "new/same.json"],
    ["diff", "old", "new", "--json", "--format", "text"],
    ["diff", "old", "new", "--format", "yaml"],
  ]) {
    for (const { status, stdout, stderr } of both(...args)) {
      assert.deepEqual([status, stdout], [2, ""]);
      assert.match(stderr, /^error/);
    }
  }
});

test("the action writes a summary and JUnit's XML", () => {
  // npx finds the built package instead of a published one.
  write("bin/npx", `#!/bin/sh\nshift 2\nexec "${process.execPath}" "${main}" "$@"\n`);
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
