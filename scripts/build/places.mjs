// The places of panics, blanked in the wasm module. Each is a text, the path of
// a source, and structures that point at it: text, length, line and column.
// Nobody reads them once panics are traps, and zeros need not be sent.
import { readFileSync, writeFileSync } from "node:fs";
import { findSection, Reader } from "./binary.mjs";

const dataSection = 11;
const constant = 0x41;
const end = 0x0b;
/** Bytes of a place, and of each of its four numbers. */
const place = 16;
const word = 4;

/** Paths as the compiler writes them: its own libraries', the crates', ours. */
const path = /(?:\/rustc\/[0-9a-f]{40}\/|cargo\/registry\/src\/|src\/)[\w./-]*?\.rs/g;

/** The module's data: where it lies in the file, and in memory. */
function segments(wasm) {
  const { start } = findSection(wasm, dataSection);
  const reader = new Reader(wasm, start);
  const found = [];
  for (let count = reader.number(); count > 0; count--) {
    const isActive = reader.number() === 0;
    if (!isActive || wasm[reader.at++] !== constant) throw new Error("data at no fixed address");
    const address = reader.signed();
    if (wasm[reader.at++] !== end) throw new Error("data at no fixed address");
    const length = reader.number();
    found.push({ address, bytes: wasm.subarray(reader.at, reader.at + length) });
    reader.at += length;
  }
  return found;
}

/** Blanks all paths of sources and what points at them. */
export function blankPlaces(wasmFile) {
  const wasm = readFileSync(wasmFile);
  const data = segments(wasm);
  /** Lengths of the texts by their address. */
  const paths = new Map();
  for (const { address, bytes } of data) {
    for (const { index, 0: text } of bytes.toString("latin1").matchAll(path)) {
      paths.set(address + index, text.length);
      bytes.fill(0, index, index + text.length);
    }
  }
  let blanked = 0;
  for (const { address, bytes } of data) {
    const first = (word - (address % word)) % word;
    for (let at = first; at + place <= bytes.length; at += word) {
      if (paths.get(bytes.readUInt32LE(at)) !== bytes.readUInt32LE(at + word)) continue;
      bytes.fill(0, at, at + place);
      blanked++;
    }
  }
  if (blanked === 0) throw new Error("the wasm module has no place of a panic");
  writeFileSync(wasmFile, wasm);
}
