// npm run bench: the reference pairs of ../shared/models by the built package
// in Node and by the native library, both on the CPU and on one thread, and the
// ratios of their times.
//
// Both sides are one process that stays warm, and read the files before the
// clock starts; they take turns, pair by pair, and of several repetitions the
// fastest counts, so that other work on the machine matters little. Measured
// are
//   models   from the two JSON texts to two models,
//   prepare  cutting patches and building trees, `seconds.prepare` of the result,
//   solve    the search, `seconds.solve` of the result,
//   total    from the texts to the answer, what a caller waits for.
// Further arguments are parts of names: npm run bench -- duck
import { spawn } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { parseArgs } from "node:util";
import { Hausdorff } from "nurbs-hausdorff";
import { modules, wasmFile } from "../../scripts/build/wasm.mjs";
import { inRoot } from "../../scripts/paths.mjs";
import { environment } from "../../scripts/process.mjs";

const folder = inRoot("..", "shared", "models");
const parts = ["models", "prepare", "solve", "total"];

/** Ratios of the times that the package is to keep, as medians over the pairs. */
const targets = { prepare: 2, solve: 2, total: 2 };

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: { repetitions: { type: "string", default: "7" } },
});

function pairs() {
  const file = join(folder, "reference.jsonl");
  for (const needed of [file, inRoot(wasmFile(modules[0])), inRoot("dist/index.js")]) {
    if (!existsSync(needed)) {
      console.error(`npm run bench: there is no ${needed}`);
      process.exit(2);
    }
  }
  const lines = readFileSync(file, "utf8").trim().split("\n");
  const all = lines.map((line) => {
    const { a, b, translate_a: translation = [0, 0, 0] } = JSON.parse(line);
    const path = (name) => join(folder, `${name}.json`);
    return { name: `${a} ${b} ${translation}`, a: path(a), b: path(b), translation };
  });
  return all.filter(({ name }) => positionals.every((part) => name.includes(part)));
}

/** The built package; without WebGPU, as Node has none. */
async function packaged() {
  const hd = await Hausdorff.create({ backend: "cpu" });
  return async ({ a, b, translation }) => {
    const texts = [a, b].map((path) => readFileSync(path, "utf8"));
    const started = performance.now();
    const models = texts.map((text) => hd.model(text));
    const made = performance.now();
    const { seconds, lower, upper } = await hd.distance(...models, { transform: { translation } });
    const total = (performance.now() - started) / 1000;
    for (const model of models) model.dispose();
    return { models: (made - started) / 1000, ...seconds, total, lower, upper };
  };
}

/** The native library, in a process that benches/package/main.rs describes. */
function native() {
  const args = ["bench", "--bench", "package"];
  const env = environment({ RAYON_NUM_THREADS: "1" });
  const child = spawn("cargo", args, { cwd: inRoot(), env, stdio: ["pipe", "pipe", "inherit"] });
  const lines = createInterface({ input: child.stdout })[Symbol.asyncIterator]();
  const measure = async (pair) => {
    child.stdin.write(`${JSON.stringify(pair)}\n`);
    const { value, done } = await lines.next();
    if (done) throw new Error("the native benchmark ended early");
    return JSON.parse(value);
  };
  return { measure, end: () => child.stdin.end() };
}

/** The least of each part's times. */
function fastest(runs) {
  return Object.fromEntries(parts.map((part) => [part, Math.min(...runs.map((run) => run[part]))]));
}

function median(numbers) {
  const sorted = numbers.toSorted((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 === 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

const chosen = pairs();
const inPackage = await packaged();
const natively = native();
const ratios = Object.fromEntries(parts.map((part) => [part, []]));
console.log("milliseconds of the package / natively = ratio");
for (const pair of chosen) {
  const runs = { inPackage: [], natively: [] };
  for (let repetition = 0; repetition < Number(values.repetitions); repetition++) {
    runs.inPackage.push(await inPackage(pair));
    runs.natively.push(await natively.measure(pair));
  }
  const [first, second] = [runs.inPackage[0], runs.natively[0]];
  if (first.upper < second.lower || second.upper < first.lower) {
    throw new Error(`${pair.name}: the two intervals do not overlap`);
  }
  const [ours, theirs] = [fastest(runs.inPackage), fastest(runs.natively)];
  const columns = parts.map((part) => {
    const ratio = ours[part] / theirs[part];
    ratios[part].push(ratio);
    const [one, other] = [ours, theirs].map((times) => (times[part] * 1000).toFixed(2));
    return `${part} ${one} / ${other} = ${ratio.toFixed(2)}`.padEnd(32);
  });
  console.log(`${pair.name.padEnd(44)} ${columns.join(" ")}`.trimEnd());
}
natively.end();

for (const part of parts) {
  const target = targets[part] === undefined ? "" : `, to reach: ${targets[part]}`;
  console.log(`median ratio, ${part}: ${median(ratios[part]).toFixed(2)}${target}`);
}
