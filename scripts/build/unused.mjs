// The data that the optimised module no longer uses, blanked: above all messages
// and places of panics, which are traps. Zeros need not be sent.
import { readFileSync, writeFileSync } from "node:fs";
import { segments } from "./binary.mjs";

/** Numbers of the module's text that may be addresses. */
const number = /i32\.const (-?\d+)|i64\.const (-?\d+)|offset=(\d+)/g;

/** All addresses that the code may mean. */
async function addresses(wasmFile) {
  // Not there before the set-up, which imports this file.
  const { default: binaryen } = await import("binaryen");
  const module = binaryen.readBinary(readFileSync(wasmFile));
  const lines = module.emitText().split("\n");
  module.dispose();
  const found = new Set();
  for (const line of lines) {
    if (line.startsWith(" (data")) continue;
    for (const [, word, long, offset] of line.matchAll(number)) {
      const bits = BigInt(word ?? long ?? offset);
      // One may be subtracted; two may be stored together.
      for (const half of [bits, -bits, bits >> 32n]) found.add(Number(BigInt.asUintN(32, half)));
    }
  }
  return found;
}

/** Blanks what no address in the code leads to, directly or through pointers. */
export async function blankUnused(wasmFile, { objects, meant }) {
  const waiting = objects.filter(({ isOpen }) => isOpen);
  for (const address of await addresses(wasmFile)) {
    const within = ({ first, end }) => address >= first && address < end;
    // An address the code began with may also be the end of the object before.
    waiting.push(...(meant.get(address) ?? objects.filter(within)));
  }
  const used = new Set();
  while (waiting.length > 0) {
    const object = waiting.pop();
    if (used.has(object)) continue;
    used.add(object);
    waiting.push(...object.pointers);
  }

  const wasm = readFileSync(wasmFile);
  for (const { address, bytes } of segments(wasm)) {
    const before = Buffer.from(bytes);
    const place = (at) => Math.min(Math.max(at - address, 0), bytes.length);
    for (const object of objects) {
      if (!used.has(object)) bytes.fill(0, place(object.first), place(object.end));
    }
    // Objects may overlap, as texts that contain one another.
    for (const { first, end } of used) {
      bytes.set(before.subarray(place(first), place(end)), place(first));
    }
  }
  writeFileSync(wasmFile, wasm);
}
