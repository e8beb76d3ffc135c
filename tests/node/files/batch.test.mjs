// The command `batch` of both command lines.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { buildCommand, command as native } from "../../../scripts/build/command.mjs";
import { environment } from "../../../scripts/process.mjs";
import { interchangeSquare } from "../support.mjs";

const root = fileURLToPath(new URL("../../..", import.meta.url));
const COMMANDS = {
  node: [process.execPath, join(root, "dist/cli/main.js")],
  native: [native],
};
const folder = mkdtempSync(join(tmpdir(), "nurbs-hausdorff-"));
after(() => rmSync(folder, { recursive: true }));

before(async () => {
  await buildCommand();
  for (let z = 0; z < 6; z++) {
    writeFileSync(join(folder, `${z}.json`), JSON.stringify(interchangeSquare(z)));
  }
});

const lines = (values) => values.map((value) => `${JSON.stringify(value)}\n`).join("");
const answers = (text) => text.trimEnd().split("\n").map(JSON.parse);
const pairs = (count) =>
  Array.from({ length: count }, (_, id) => ({ id, a: "0.json", b: `${id}.json` }));

function batch([program, ...before], values, ...more) {
  const options = { cwd: folder, encoding: "utf8", env: environment(), input: lines(values) };
  return spawnSync(program, [...before, "batch", "-", ...more], options);
}

test("both answer in the order of the pairs, and a failed pair by a line", () => {
  const values = [
    ...pairs(6),
    { id: "lost", a: "nowhere.step", b: "0.json" },
    { id: "grid", a: "0.json", b: "1.json", grid: 8 },
    { id: "face by face", a: "0.json", b: "1.json", command: "diff" },
    { id: "near", a: "0.json", b: "1.json", command: "clearance", limit: 0.5 },
    { id: "moved", a: "0.json", b: "1.json", transform: { translation: [0, 0, 1] } },
    { id: "no file", a: "0.json" },
  ];
  const found = Object.values(COMMANDS).map((command) => {
    const { status, stdout, stderr } = batch(command, values, "--jobs", "2", "--max-seconds", "60");
    assert.equal(status, 1, stderr);
    return answers(stdout).map(({ id, lower, upper, state, atLeast, error, files }) => {
      if (typeof id === "number") assert.ok(lower <= id && id <= upper && upper - lower < 1e-5);
      if (id === "moved") assert.ok(upper < 1e-5);
      return { id, state, atLeast, code: error?.code, files };
    });
  });
  assert.deepEqual(
    found[0].map(({ id }) => id),
    values.map(({ id }) => id),
  );
  assert.deepEqual(found[0], found[1]);
  assert.deepEqual(found[0].map(({ code }) => code).filter(Boolean), [
    "FILE_UNREADABLE",
    "OPTION_INVALID",
    "OPTION_INVALID",
  ]);
});

test("an output that was cut off is gone on with", () => {
  for (const [name, command] of Object.entries(COMMANDS)) {
    const output = join(folder, `${name}.jsonl`);
    assert.equal(batch(command, pairs(3), "--output", output).status, 0);
    writeFileSync(output, readFileSync(output).subarray(0, -30));
    assert.equal(batch(command, pairs(5), "--output", output, "--resume").status, 0);
    const ids = answers(readFileSync(output, "utf8")).map(({ id }) => id);
    assert.deepEqual(ids, [0, 1, 2, 3, 4], name);
    assert.match(batch(command, [], "--output", output).stderr, /^error\[OUTPUT_EXISTS\]/);
    writeFileSync(output, "a list\nof words");
    const other = batch(command, pairs(5), "--output", output, "--resume");
    assert.match(other.stderr, /^error\[OUTPUT_FAILED\].*no output of `batch`/s);
    assert.equal(readFileSync(output, "utf8"), "a list\nof words");
    assert.match(batch(command, [], "--resume").stderr, /^error\[OPTION_INVALID\].*--output/s);
  }
});

test("an interrupt ends a batch that waits for lines", async () => {
  for (const [program, ...before] of Object.values(COMMANDS)) {
    const options = { cwd: folder, env: environment(), stdio: ["pipe", "pipe", "inherit"] };
    const child = spawn(program, [...before, "batch", "-", "--jobs", "1"], options);
    const exit = once(child, "exit");
    // The input stays open.
    child.stdin.write(lines([{ id: 0, a: "0.json", b: "1.json" }]));
    const [line] = await once(createInterface({ input: child.stdout }), "line");
    assert.equal(JSON.parse(line).id, 0);
    child.kill("SIGINT");
    assert.deepEqual(await exit, [130, null], program);
  }
});

test("an interrupted batch and one that nobody reads end between lines", async () => {
  for (const [program, ...before] of Object.values(COMMANDS)) {
    for (const end of ["SIGINT", "close"]) {
      // More pairs than are answered before the end.
      const many = Array.from({ length: 5000 }, (_, id) => ({ id, a: "0.json", b: "1.json" }));
      writeFileSync(join(folder, "many.jsonl"), lines(many));
      const args = [...before, "batch", "many.jsonl", "--jobs", "1"];
      const options = { cwd: folder, env: environment(), stdio: ["ignore", "pipe", "inherit"] };
      const child = spawn(program, args, options);
      const exit = once(child, "exit");
      const read = [];
      for await (const line of createInterface({ input: child.stdout })) {
        read.push(JSON.parse(line).id);
        if (read.length > 1) continue;
        if (end === "SIGINT") child.kill("SIGINT");
        else break;
      }
      if (end === "close") child.stdout.destroy();
      const [status] = await exit;
      assert.equal(status, end === "SIGINT" ? 130 : 0, `${program} ${end}`);
      assert.ok(read.length < 5000);
      assert.deepEqual(read, [...read.keys()]);
    }
  }
});
