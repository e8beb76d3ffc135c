// The command of the packed package: the native program of this platform, installed beside it.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { readFileSync, renameSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { after, before, test } from "node:test";
import { missing, sharedFile } from "../node/files/files.mjs";
import { install } from "./install.mjs";

let packed;
before(async () => {
  packed = await install();
  for (const z of [0, 3]) {
    const corner = (x, y) => [x, y, z, 1];
    const ctrl = [0, 1].map((x) => [corner(x, 0), corner(x, 1)]);
    const surface = { degree: [1, 1], knots_u: [0, 0, 1, 1], knots_v: [0, 0, 1, 1], ctrl };
    writeFileSync(join(packed.folder, `${z}.json`), JSON.stringify({ surfaces: [surface] }));
  }
});
after(() => packed?.remove());

const launcher = () => join(packed.folder, "node_modules", ".bin", "nurbs-hausdorff");

function run(args, options = {}) {
  return spawnSync(launcher(), args, { cwd: packed.folder, encoding: "utf8", ...options });
}

test("it prints what the program prints, and ends with its status", () => {
  const { version } = JSON.parse(readFileSync(join(packed.installed, "package.json"), "utf8"));
  assert.equal(run(["--version"]).stdout, `nurbs-hausdorff ${version}\n`);
  const beyond = run(["distance", "0.json", "3.json", "--limit", "1"]);
  assert.equal(beyond.status, 1, beyond.stderr);
  assert.match(beyond.stdout, /^BEYOND 1: 3 \(/);
  assert.equal(run(["distance", "0.json", "3.json", "--limit", "4"]).status, 0);
  const refused = run(["distance", "0.json", "nowhere.step"]);
  assert.deepEqual([refused.status, refused.stdout], [2, ""]);
  assert.match(refused.stderr, /^error\[FILE_UNREADABLE\]/);
});

test("standard input and output are the program's", () => {
  const input = readFileSync(join(packed.folder, "0.json"));
  const { status, stdout, stderr } = run(["convert", "-", "-"], { input });
  assert.equal(status, 0, stderr);
  assert.equal(JSON.parse(stdout).surfaces.length, 1);
});

test("an interrupt is the program's: a batch ends by its own status", async () => {
  const options = { cwd: packed.folder, stdio: ["pipe", "pipe", "inherit"] };
  const child = spawn(launcher(), ["batch", "-", "--jobs", "1"], options);
  const exit = once(child, "exit");
  child.stdin.write('{"id": 0, "a": "0.json", "b": "3.json"}\n');
  const [line] = await once(createInterface({ input: child.stdout }), "line");
  assert.equal(JSON.parse(line).id, 0);
  child.kill("SIGINT");
  assert.deepEqual(await exit, [130, null]);
});

test("3DM files are read by rhino3dm, which is installed beside the package", {
  skip: missing,
}, () => {
  writeFileSync(join(packed.folder, "part.3dm"), sharedFile("3dm/v4_MechPartB.3dm"));
  const without = run(["info", "part.3dm"]);
  assert.match(without.stderr, /^error\[PEER_MISSING\]: .*npm install rhino3dm/);
  const peers = packed.installPeers();
  try {
    const { status, stdout, stderr } = run(["info", "part.3dm", "--json"]);
    assert.equal(status, 0, stderr);
    assert.ok(JSON.parse(stdout).faces.length > 10);
  } finally {
    peers.remove();
  }
});

test("without the platform's package the way to a program is said", () => {
  const scope = join(packed.folder, "node_modules", "@nurbs-hausdorff");
  renameSync(scope, `${scope}-away`);
  try {
    const { status, stderr } = run(["--version"]);
    assert.equal(status, 2);
    const platform = `${process.platform}-${process.arch}`;
    assert.match(
      stderr,
      new RegExp(`^error\\[PLATFORM_UNSUPPORTED\\]: .*${platform}.*cargo install`),
    );
  } finally {
    renameSync(`${scope}-away`, scope);
  }
});
