// Reads every CAD file below a folder, each in a process of its own, and reports what was read:
//
//   node benches/trimmed/torture.mjs FOLDER [--seconds 60] [--jobs 1] [--json OUT.json]
//
// For each file: faces read and skipped with the codes of the reasons, errors by code, panics
// (any exit that is not an error of the package) and hangs (no end within the time). The
// package must be built (`npm run build`), with its optional peers for STEP, IGES and 3DM.
import { spawn } from "node:child_process";
import { readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";
import { fileURLToPath } from "node:url";

const KINDS = /\.(stp|step|igs|iges|3dm|brep|brp|fcstd)(\.gz)?$/i;

/** Reads one file and prints a line of JSON; what the child process does. */
async function read(file) {
  const { Hausdorff } = await import("nurbs-hausdorff");
  const { readCad } = await import("nurbs-hausdorff/cad");
  await Hausdorff.create({ backend: "cpu" });
  const start = performance.now();
  let result;
  try {
    const model = await readCad(readFileSync(file), { name: file });
    const { faces, fitted, trims, gap, skipped } = model.report;
    result = { faces, trims, fitted, gap, skipped: skipped.map(({ code, why }) => code ?? why) };
  } catch (error) {
    if (error.name !== "HausdorffError") throw error;
    result = { error: error.code, why: error.message.slice(0, 200) };
  }
  console.log(`\nRESULT ${JSON.stringify({ ...result, seconds: (performance.now() - start) / 1000 })}`);
  process.exit(0);
}

/** Returns what a process says of a file. */
function attempt(file, seconds) {
  return new Promise((resolve) => {
    const child = spawn(process.execPath, [fileURLToPath(import.meta.url), "--read", file]);
    let [out, failure] = ["", ""];
    child.stdout.on("data", (text) => (out += text));
    child.stderr.on("data", (text) => (failure = (failure + text).slice(-2000)));
    let hangs = false;
    const timer = setTimeout(() => {
      hangs = true;
      child.kill("SIGKILL");
    }, 1000 * seconds);
    child.on("close", (status) => {
      clearTimeout(timer);
      const found = out.match(/^RESULT (.*)$/m);
      if (found) resolve(JSON.parse(found[1]));
      else resolve(hangs ? { hang: seconds } : { panic: status, why: failure.trim().slice(-500) });
    });
  });
}

function files(folder) {
  return readdirSync(folder)
    .map((name) => join(folder, name))
    .flatMap((path) => (statSync(path).isDirectory() ? files(path) : KINDS.test(path) ? [path] : []));
}

/** Counts equal keys, the most frequent first. */
function counts(keys) {
  const found = new Map();
  for (const key of keys) found.set(key, (found.get(key) ?? 0) + 1);
  return [...found].sort((a, b) => b[1] - a[1]).map(([key, count]) => `${count} x ${key}`);
}

async function main() {
  const [folder, ...options] = process.argv.slice(2);
  if (!folder) throw new Error("usage: torture.mjs FOLDER [--seconds 60] [--jobs 1] [--json OUT.json]");
  const option = (name) => options[options.indexOf(name) + 1 || options.length];
  const results = [];
  const pending = files(folder).reverse();
  const take = async () => {
    for (let file = pending.pop(); file; file = pending.pop()) {
      report({ file: relative(folder, file), ...(await attempt(file, Number(option("--seconds") ?? 60))) });
    }
  };
  const report = (result) => {
    results.push(result);
    const { faces, skipped, error, panic, hang } = result;
    console.log(
      result.file,
      faces === undefined
        ? (error ?? (hang ? "HANG" : `PANIC ${panic} ${result.why}`))
        : `${faces} faces, skipped: ${counts(skipped).join(", ") || 0}`,
    );
  };
  await Promise.all(Array.from({ length: Number(option("--jobs") ?? 1) }, take));
  const read = results.filter(({ faces }) => faces !== undefined);
  const sum = (value) => read.reduce((total, result) => total + value(result), 0);
  console.log(`\n${results.length} files, ${read.length} read`);
  console.log(`faces: ${sum((r) => r.faces)} read, ${sum((r) => r.skipped.length)} skipped`);
  for (const line of counts(read.flatMap((r) => r.skipped))) console.log(`  skipped ${line}`);
  for (const line of counts(results.filter((r) => r.error).map((r) => r.error))) console.log(`  error ${line}`);
  console.log(`panics: ${results.filter((r) => r.panic !== undefined).length}`);
  console.log(`hangs: ${results.filter((r) => r.hang).length}`);
  const slowest = read.toSorted((a, b) => b.seconds - a.seconds)[0];
  if (slowest) console.log(`slowest: ${slowest.file}, ${slowest.seconds.toFixed(1)} s`);
  const json = option("--json");
  if (json) writeFileSync(json, JSON.stringify(results, undefined, 1));
}

if (process.argv[2] === "--read") await read(process.argv[3]);
else await main();
