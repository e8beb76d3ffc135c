// Checks the size of the wasm module, plain and gzipped, against its budget.
import { readFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { wasmFile } from "../build/wasm.mjs";
import { inRoot } from "../paths.mjs";
import { Failure } from "../process.mjs";

/**
 * The largest sizes, in KiB. Gzipped, reading BREP text takes about 155 KiB and cutting
 * trimmed faces 60 (benches/RESULTS.md): they are in it because `hd.model` takes both at
 * once, without another fetch. Bounding blocks of near copies by splines takes 4; the proof of
 * every cut, the orders of wires on closed surfaces and the areas of faces take 25 together.
 */
const budget = { plain: 1740, gzipped: 715 };

export function checkBudget() {
  const bytes = readFileSync(inRoot(wasmFile));
  const size = { plain: bytes.length / 1024, gzipped: gzipSync(bytes, { level: 9 }).length / 1024 };
  const parts = Object.keys(budget).map(
    (kind) => `${kind} ${size[kind].toFixed(1)} of ${budget[kind]} KiB`,
  );
  console.log(`${wasmFile}: ${parts.join(", ")}`);
  if (Object.keys(budget).some((kind) => size[kind] > budget[kind])) {
    throw new Failure("the wasm module is over its budget");
  }
}
