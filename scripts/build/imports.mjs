// Short names for what the wasm module imports. wasm-bindgen ends each name
// with a hash, so that they are told apart, and hashes do not compress.
import { readFileSync, writeFileSync } from "node:fs";

const sections = 8;
const importSection = 2;
const functionKind = 0;

/** Reads numbers and texts of the binary format in turn. */
class Reader {
  constructor(bytes, at) {
    this.bytes = bytes;
    this.at = at;
  }

  number() {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = this.bytes[this.at++];
      value += (byte & 0x7f) * 2 ** shift;
      if (byte < 0x80) return value;
    }
  }

  text() {
    const length = this.number();
    this.at += length;
    return this.bytes.toString("utf8", this.at - length, this.at);
  }
}

function number(value) {
  const bytes = [];
  for (let rest = value; ; rest = Math.floor(rest / 0x80)) {
    if (rest < 0x80) return Buffer.from([...bytes, rest]);
    bytes.push((rest % 0x80) + 0x80);
  }
}

function text(value) {
  const bytes = Buffer.from(value);
  return Buffer.concat([number(bytes.length), bytes]);
}

/** Where the section of imports lies: its head, its content and its end. */
function findImports(wasm) {
  const reader = new Reader(wasm, sections);
  while (reader.at < wasm.length) {
    const head = reader.at;
    const id = wasm[reader.at++];
    const size = reader.number();
    if (id === importSection) return { head, start: reader.at, end: reader.at + size };
    reader.at += size;
  }
  throw new Error("the wasm module has no imports");
}

/** Renames the functions that the module imports, in it and in its glue. */
export function shortenImports(wasmFile, glueFile) {
  const wasm = readFileSync(wasmFile);
  const { head, start, end } = findImports(wasm);
  const reader = new Reader(wasm, start);
  const count = reader.number();
  const shortened = [number(count)];
  const names = new Map();
  for (let index = 0; index < count; index++) {
    const module = reader.text();
    const name = reader.text();
    const kind = wasm[reader.at++];
    if (kind !== functionKind) throw new Error(`${name} is imported and no function`);
    names.set(name, `i${index.toString(36)}`);
    shortened.push(
      text(module),
      text(names.get(name)),
      Buffer.from([kind]),
      number(reader.number()),
    );
  }

  // The glue defines each as a property at the beginning of a line.
  const defined = new Set();
  const glue = readFileSync(glueFile, "utf8").replace(
    /^( +)(\w+)(?=: )/gm,
    (line, indent, name) => {
      if (!names.has(name)) return line;
      defined.add(name);
      return indent + names.get(name);
    },
  );
  const missing = [...names.keys()].filter((name) => !defined.has(name));
  if (missing.length > 0) throw new Error(`the glue does not define ${missing.join(", ")}`);

  const content = Buffer.concat(shortened);
  const section = Buffer.concat([Buffer.from([importSection]), number(content.length), content]);
  writeFileSync(wasmFile, Buffer.concat([wasm.subarray(0, head), section, wasm.subarray(end)]));
  writeFileSync(glueFile, glue);
}
