// The package's command line against the native one, and on CAD files.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { buildCommand, command as native } from "../../../scripts/build/command.mjs";
import { environment } from "../../../scripts/process.mjs";
import { stepAssembly } from "../../page/support/models.mjs";
import { interchangeSquare } from "../support.mjs";
import { missing, sharedFile, zip } from "./files.mjs";

const root = fileURLToPath(new URL("../../..", import.meta.url));
const main = join(root, "dist/cli/main.js");
const folder = mkdtempSync(join(tmpdir(), "nurbs-hausdorff-"));
after(() => rmSync(folder, { recursive: true }));

const path = (name) => join(folder, name);
const file = (name, content) => {
  writeFileSync(path(name), content);
  return path(name);
};

function outcome(command, args, input = "") {
  const options = { cwd: folder, encoding: "utf8", env: environment(), input };
  const { status, stdout, stderr } = spawnSync(command, args, options);
  return { status, stdout, stderr };
}

const node = (...args) => outcome(process.execPath, [main, ...args]);

/** Runs both command lines, which must end with the same status. */
const both = (...args) => bothWith("", ...args);

/** As `both`, with this standard input. */
function bothWith(input, ...args) {
  const ours = outcome(process.execPath, [main, ...args], input);
  const theirs = outcome(native, args, input);
  assert.equal(ours.status, theirs.status, `${args}\n${ours.stderr}\n${theirs.stderr}`);
  return [ours, theirs];
}

const table = JSON.parse(readFileSync(join(root, "src/js/cli/options.json"), "utf8"));
const squares = {};

before(async () => {
  await buildCommand();
  for (const z of [0, 3]) {
    squares[z] = file(`square-${z}.json`, JSON.stringify(interchangeSquare(z)));
  }
});

/** Keys whose values depend on the machine or on the order of parallel work. */
const FREE = new Set([
  ...["seconds", "notice", "cells", "cpuCells", "levels"],
  ...["witness", "u", "v"],
]);

/** Fails unless the two JSON values have the same keys in order and the same values, numbers up to `tolerance`. */
function alike(ours, theirs, tolerance, where = "") {
  if (typeof ours === "number" && typeof theirs === "number") {
    const size = Math.max(1, Math.abs(theirs));
    assert.ok(Math.abs(ours - theirs) <= tolerance * size, `${where}: ${ours} and ${theirs}`);
  } else if (typeof ours === "object" && ours !== null && theirs !== null) {
    const keys = (value) => Object.keys(value).filter((key) => key !== "notice");
    assert.deepEqual(keys(ours), keys(theirs), where);
    for (const key of keys(ours)) {
      if (!FREE.has(key)) alike(ours[key], theirs[key], tolerance, `${where}.${key}`);
    }
  } else {
    assert.deepEqual(ours, theirs, where);
  }
}

/** A value of every option of `distance`, other than the default, and what it needs beside it. */
const VALUES = {
  method: ["hierarchy"],
  tolerance: ["1e-3"],
  "relative-tolerance": ["1e-3"],
  limit: ["2.5"],
  "allow-skipped": ["--limit", "2.5"],
  "strict-gaps": ["--limit", "2.5"],
  "max-seconds": ["60"],
  "max-cells": ["5"],
  samples: ["8", "--method", "iteration"],
  sampling: ["arc-length", "--method", "iteration"],
  flatness: ["curvature", "--method", "iteration"],
  projection: ["tangent-plane", "--method", "iteration"],
  culling: ["none", "--method", "iteration"],
  iterations: ["9", "--method", "iteration"],
  "step-tolerance": ["0.5", "--method", "iteration"],
  grid: ["16", "--method", "hierarchy"],
  "memory-budget": ["64", "--method", "hierarchy"],
  symmetric: [],
  "scale-units": [],
  translate: ["-0.25,0.5,1"],
  rotate: ["1,0,0,90"],
  deviations: [],
  backend: ["cpu", "--method", "iteration"],
  json: [],
  format: ["json"],
  include: ["*.step"],
  reuse: ["answers"],
  part: ["bracket"],
  operator: ["N. N."],
};

const command = (name) => table.commands.find((command) => command.name === name);

test("every option of distance has a value to try", () => {
  const names = command("distance").options.map(({ name }) => name);
  assert.deepEqual(Object.keys(VALUES).sort(), names.sort());
});

for (const [name, value] of Object.entries(VALUES)) {
  test(`distance --${name}: both print the same JSON`, () => {
    const rest =
      value.some((one) => one === "--method") || name === "method" ? ["--backend", "cpu"] : [];
    const backend = name === "backend" ? [] : rest;
    const json = name === "json" || name === "format" ? [] : ["--json"];
    const args = ["distance", squares[0], squares[3], `--${name}`, ...value, ...json, ...backend];
    const [ours, theirs] = both(...args);
    const results = [ours, theirs].map(({ stdout }) => JSON.parse(stdout));
    // Intervals of two searches that end at the same width need not be equal.
    const width = results[1].upper - results[1].lower;
    alike(...results, 1e-9 + width);
    assert.ok(results[0].lower <= results[1].upper && results[1].lower <= results[0].upper);
  });
}

test("both print the same lines for people", () => {
  // Without times, the count of cells and the place of the witness on parallel squares.
  const lines = ({ stdout }) =>
    stdout.split("\n").filter((line) => !/^(seconds|search|notice|on [AB])/.test(line));
  for (const options of [
    ["--symmetric"],
    ["--method", "iteration", "--backend", "cpu", "--deviations"],
    ["--method", "hierarchy", "--backend", "cpu", "--grid", "8"],
    ["--limit", "5"],
  ]) {
    const [ours, theirs] = both("distance", squares[0], squares[3], ...options);
    assert.deepEqual(lines(ours), lines(theirs));
    assert.match(ours.stdout, /^seconds {4}\d+\.\d{3} prepare, /m);
  }
});

test("both describe models with the same numbers", () => {
  for (const name of ["sphere", "wavy-sheet"]) {
    const model = file(`${name}.json`, shape(name));
    const [ours, theirs] = both("info", model);
    assert.equal(ours.stdout, theirs.stdout);
    const [json, expected] = both("info", model, "--json").map(({ stdout }) => JSON.parse(stdout));
    const areas = [json, expected].map(withoutAreas);
    assert.deepEqual(json, expected);
    // Cosines, which the nodes are made of, differ in their last digits.
    areas[0].forEach((end, index) => {
      assert.ok(Math.abs(end - areas[1][index]) <= 1e-12 * end, `${end}, ${areas[1][index]}`);
    });
  }
});

/** Removes the areas of a model and its surfaces, and returns their ends. */
function withoutAreas(info) {
  return [info, ...info.faces].flatMap((described) => {
    const { lower, upper } = described.area;
    delete described.area;
    return [lower, upper];
  });
}

/** A model's JSON by the native command, from a JSON with numbers of every size. */
function shape(name) {
  const surface = {
    degree: [2, 1],
    knots_u: [0, 0, 0, 1e-7, 1e-7, 1e-7],
    knots_v: [-1e17, -1e17, 1e17, 1e17],
    ctrl: [0, 1, 2].map((i) => [
      [i, i === 1 ? 1e-6 : 0, 0, 1],
      [i, 1 / 3, 12345.678, name === "sphere" ? 0.5 + i : 1],
    ]),
  };
  return JSON.stringify({ name, unit: 0.001, surfaces: [surface] });
}

test("both compare faces", () => {
  const lines = ({ stdout }) => stdout.split("\n").filter((line) => !line.startsWith("seconds"));
  for (const options of [[], ["--limit", "4"], ["--max-cells", "2", "--limit", "1e-9"]]) {
    const args = ["diff", squares[0], squares[3], ...options];
    const [ours, theirs] = both(...args);
    assert.deepEqual(lines(ours).length, lines(theirs).length);
    const results = both(...args, "--json").map(({ stdout }) => JSON.parse(stdout));
    alike(...results, 1e-6);
  }
  assert.equal(node("diff", squares[0], squares[3]).status, 1);
  assert.equal(node("diff", squares[0], squares[0]).status, 0);
});

test("both convert, and report", () => {
  const outputs = [path("ours.json"), path("theirs.json")];
  const reports = [
    node("convert", squares[0], outputs[0], "--json"),
    outcome(native, ["convert", squares[0], outputs[1], "--json"]),
  ].map(({ stdout }) => JSON.parse(stdout));
  assert.deepEqual(reports[0], reports[1]);
  const models = outputs.map((output) => JSON.parse(readFileSync(output, "utf8")));
  assert.deepEqual(models[0], models[1]);
  const [ours, theirs] = [
    node("convert", squares[0], outputs[0], "--overwrite"),
    outcome(native, ["convert", squares[0], outputs[1], "--overwrite"]),
  ];
  assert.equal(ours.stdout, theirs.stdout);
  for (const refused of both("convert", squares[0], outputs[0])) {
    assert.equal(refused.status, 2);
    assert.match(refused.stderr, /^error\[OUTPUT_EXISTS\]: .*ours\.json is there already/);
  }
  for (const refused of both("convert", squares[0], path("no-such-folder/out.json"))) {
    assert.equal(refused.status, 2);
    assert.match(refused.stderr, /^error\[OUTPUT_FAILED\]: .*no-such-folder/);
  }
});

test("both state the version, the files and their hashes in JSON", () => {
  const sha256 = (path) => createHash("sha256").update(readFileSync(path)).digest("hex");
  const source = (path) => ({ path, sha256: sha256(path) });
  const { version } = JSON.parse(readFileSync(new URL("../../../package.json", import.meta.url)));
  const [a, b] = [squares[0], squares[3]];
  for (const command of ["distance", "diff"]) {
    for (const { stdout } of both(command, a, b, "--json")) {
      const printed = JSON.parse(stdout);
      assert.deepEqual([printed.schemaVersion, printed.version], [1, version]);
      assert.deepEqual(printed.files, { a: source(a), b: source(b) });
      assert.deepEqual(printed.skipped, { a: [], b: [] });
    }
  }
  for (const { stdout } of both("info", a, "--json")) {
    const printed = JSON.parse(stdout);
    assert.deepEqual([printed.schemaVersion, printed.version], [1, version]);
    assert.deepEqual([printed.file, printed.skipped], [source(a), []]);
  }
});

test("both state the names of all levels of an assembly, and colours", () => {
  const assembly = file("assembly.step", stepAssembly({ color: ["0.25", "0.5", "1."] }));
  const [ours, theirs] = both("info", assembly, "--json").map(({ stdout }) => JSON.parse(stdout));
  const of = ({ faces }) => faces.map(({ faceName, color }) => [faceName, color]);
  assert.deepEqual(of(ours), of(theirs));
  assert.deepEqual(of(ours)[4], ["machine / pump (spare) / in // out / low", [0.25, 0.5, 1]]);
  assert.deepEqual(of(ours)[7], ["machine / pump (spare) / in // out (2) / high", undefined]);
});

test("both read FreeCAD documents and what gzip compressed", () => {
  const brep = readFileSync(join(root, "python/tests/files/square.brep"), "utf8");
  const object = (name, shape) =>
    `<Object name="${name}"><Property name="Shape"><Part file="${shape}"/></Property></Object>`;
  const objects = object("Box", "a.brp") + object("Binary", "b.bin");
  const xml = `<Document><ObjectData>${objects}</ObjectData></Document>`;
  const document = file("part.FCStd", zip({ "Document.xml": xml, "a.brp": brep }));
  const packed = file("part.brep.gz", gzipSync(brep));
  const points = file("points.xyz.gz", gzipSync("0 0 0.5\n1 1 0\n"));
  const found = both("info", document, "--json").map(({ stdout }) => JSON.parse(stdout));
  for (const { unit, faces, skipped } of found) {
    assert.deepEqual([unit, faces.map(({ faceName }) => faceName)], [0.001, ["Box / face 0"]]);
    assert.deepEqual([skipped.length, skipped[0].face], [1, "Binary"]);
    assert.match(skipped[0].why, /stored in binary/);
  }
  assert.equal(both("diff", document, packed, "--allow-skipped")[0].status, 0);
  for (const { stdout } of both("distance", points, packed, "--json")) {
    const { lower, upper } = JSON.parse(stdout);
    assert.ok(lower <= 0.5 && 0.5 <= upper && upper - lower < 1e-5, `${lower} ${upper}`);
  }
});

test("both read standard input and write standard output", () => {
  const input = readFileSync(squares[0]);
  const results = both("info", squares[0]).map(({ stdout }) => stdout);
  assert.deepEqual(
    bothWith(input, "info", "-").map(({ stdout }) => stdout),
    results,
  );
  const model = JSON.parse(readFileSync(path("ours.json"), "utf8"));
  for (const { status, stdout, stderr } of bothWith(input, "convert", "-", "-")) {
    assert.equal(status, 0, stderr);
    assert.deepEqual(JSON.parse(stdout), model);
    assert.match(stderr, /^kind +json\nfaces +1, 0 left out\n/);
  }
  for (const { status, stdout } of bothWith(input, "distance", "-", squares[3], "--json")) {
    assert.equal(status, 0);
    assert.equal(JSON.parse(stdout).files.a.path, "-");
  }
});

/** Arguments that both refuse with status 2, and the code of the error. */
const refusals = [
  [[], "OPTION_INVALID"],
  [["measure"], "OPTION_INVALID"],
  [["distance"], "OPTION_INVALID"],
  [["distance", "A"], "OPTION_INVALID"],
  [["distance", "A", "B", "C"], "OPTION_INVALID"],
  [["distance", "A", "B", "--sample", "3"], "OPTION_INVALID"],
  [["distance", "A", "B", "--samples"], "OPTION_INVALID"],
  [["distance", "A", "B", "--samples", "1.5"], "OPTION_INVALID"],
  [["distance", "A", "B", "--samples", "-4"], "OPTION_INVALID"],
  [["distance", "A", "B", "--samples", "8", "--samples", "9"], "OPTION_INVALID"],
  [["distance", "A", "B", "--method", "guess"], "OPTION_INVALID"],
  [["distance", "A", "B", "--tolerance", "0x10"], "OPTION_INVALID"],
  [["distance", "A", "B", "--tolerance", "many"], "OPTION_INVALID"],
  [["distance", "A", "B", "--symmetric=yes"], "OPTION_INVALID"],
  [["distance", "A", "B", "--translate", "1,2"], "OPTION_INVALID"],
  [["distance", "A", "B", "--translate", "1,2,inf"], "OPTION_INVALID"],
  [["distance", "A", "B", "--rotate", "0,0,0,5"], "OPTION_INVALID"],
  [["distance", "A", "B", "--deviations", "--samples", "1"], "OPTION_OUT_OF_RANGE"],
  [["distance", "A", "B", "--tolerance", "0"], "OPTION_OUT_OF_RANGE"],
  [["distance", "A", "B", "--tolerance", "nan"], "OPTION_OUT_OF_RANGE"],
  [["distance", "A", "B", "--limit=-1"], "OPTION_OUT_OF_RANGE"],
  [["distance", "A", "no-such-file.json"], "FILE_UNREADABLE"],
  [["info", "."], "FILE_UNREADABLE"],
  [["info", "broken.json"], "JSON_SHAPE"],
  [["info", "empty.json"], "EMPTY_MODEL"],
];

for (const [args, code] of refusals) {
  test(`both refuse ${JSON.stringify(args)}: ${code}`, () => {
    file("broken.json", '{"surfaces": 3');
    file("empty.json", '{"surfaces": []}');
    const real = args.map((arg) => ({ A: squares[0], B: squares[3] })[arg] ?? arg);
    const outcomes = both(...real);
    for (const { status, stdout, stderr } of outcomes) {
      assert.deepEqual([status, stdout], [2, ""]);
      // The native command prints its help if there is no command at all.
      if (args.length > 0) assert.match(stderr, new RegExp(`^error\\[${code}\\]: `));
    }
  });
}

test("values with an equals sign, a sign, or behind two hyphens", () => {
  for (const args of [
    ["distance", squares[0], squares[3], "--tolerance=1e-3", "--translate=-1,-2,+3"],
    ["distance", "--translate", "-1,-2,3", "--json", "--", squares[0], squares[3]],
    ["distance", squares[0], squares[3], "--tolerance", "+.5", "--max-cells", "+8"],
  ]) {
    assert.equal(both(...args)[0].status, 0);
  }
});

test("help and version", () => {
  for (const args of [["--help"], ["help", "distance"], ["distance", "--help"], ["-V"], ["help"]]) {
    const [ours] = both(...args);
    assert.equal(ours.stderr, "");
    assert.ok(ours.stdout.length > 0);
  }
  const [ours, theirs] = both("--version");
  assert.equal(ours.stdout, theirs.stdout);
  for (const { name } of command("distance").options) {
    assert.ok(node("distance", "--help").stdout.includes(`--${name}`));
  }
});

test("completions are the native command's", () => {
  const { status, stderr } = node("completions", "bash");
  assert.equal(status, 2);
  assert.match(stderr, /native command/);
});

for (const [name, from, faces] of [
  ["screw.step", "step/screw.step", 10],
  ["bearing.iges", "iges/bearing.iges", 213],
]) {
  test(`both commands read ${name} to the same model`, { skip: missing }, () => {
    const part = file(name, sharedFile(from));
    const infos = both("info", part, "--json").map(({ stdout }) => JSON.parse(stdout));
    // The native command names no model by its file.
    for (const info of infos) info.name = null;
    // Pieces of trimmed faces follow sines and cosines, whose last bits are the platform's.
    alike(...infos, 1e-9);
    assert.deepEqual([infos[0].faces.length, infos[0].unit], [faces, 0.001]);
    const outputs = [path(`ours-${name}.json`), path(`theirs-${name}.json`)];
    const reports = [
      node("convert", part, outputs[0], "--json"),
      outcome(native, ["convert", part, outputs[1], "--json"]),
    ].map(({ stdout }) => Object.fromEntries(Object.entries(JSON.parse(stdout)).sort()));
    alike(...reports, 1e-9);
    assert.equal(reports[0].reader, "built-in");
  });
}

test("a STEP file is measured in Node", { skip: missing }, () => {
  const part = file("screw.step", sharedFile("step/screw.step"));
  const distance = node("distance", part, part, "--tolerance", "1e-3", "--json");
  assert.equal(distance.status, 0, distance.stderr);
  assert.ok(JSON.parse(distance.stdout).upper < 0.1);
});

test("the native command recognises the files that it does not read", { skip: missing }, () => {
  for (const [name, from, found] of [["part.3dm", "3dm/v4_MechPartB.3dm", /a Rhino 3DM file/]]) {
    const { status, stderr } = outcome(native, ["info", file(name, sharedFile(from))]);
    assert.equal(status, 2);
    assert.match(stderr, found);
    assert.match(stderr, /error\[FORMAT_UNSUPPORTED\].*npx nurbs-hausdorff convert .* model\.json/);
  }
});
