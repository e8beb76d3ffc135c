// The native command with the reader of 3DM files that the package's command gives it, and the bytes
// that stand in its report.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { buildCommand, command } from "../../../scripts/build/command.mjs";
import { environment } from "../../../scripts/process.mjs";
import { missing, sharedFile } from "./files.mjs";

const dist = fileURLToPath(new URL("../../../dist", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "nurbs-hausdorff-"));
after(() => rmSync(folder, { recursive: true }));
before(buildCommand);

/** Runs the command with the reader of 3DM files of a built package. */
function run(built, ...args) {
  const rhino = JSON.stringify([process.execPath, join(built, "command", "rhino.js")]);
  const env = environment({ NURBS_HAUSDORFF_3DM: rhino });
  return spawnSync(command, args, { cwd: folder, encoding: "utf8", env });
}

test("3DM files are read, with their unit and their names", { skip: missing }, () => {
  writeFileSync(join(folder, "part.3dm"), sharedFile("3dm/v4_MechPartB.3dm"));
  const { status, stdout, stderr } = run(dist, "info", "part.3dm", "--json");
  assert.equal(status, 0, stderr);
  const info = JSON.parse(stdout);
  assert.equal(info.file.path, "part.3dm");
  assert.ok(info.faces.length > 10 && info.unit > 0);
  const converted = run(dist, "convert", "part.3dm", "part.json");
  assert.match(converted.stdout, /^kind +3dm$/m);
  const compared = run(dist, "diff", "part.3dm", "part.json", "--allow-skipped", "--limit", "1e-6");
  assert.equal(compared.status, 0, compared.stdout + compared.stderr);
  assert.match(compared.stdout, /^UNCHANGED 1e-6: /);
});

test("without rhino3dm the package to install is named", { skip: missing }, () => {
  writeFileSync(join(folder, "other.3dm"), sharedFile("3dm/v4_MechPartB.3dm"));
  cpSync(dist, join(folder, "dist"), { recursive: true });
  writeFileSync(join(folder, "package.json"), '{"type": "module", "version": "0.0.0"}');
  const { status, stderr } = run(join(folder, "dist"), "info", "other.3dm");
  assert.equal(status, 2);
  assert.match(stderr, /^error\[PEER_MISSING\]: other\.3dm: .*npm install rhino3dm/);
});
