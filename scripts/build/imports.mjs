// Short names for what the wasm module imports. wasm-bindgen ends each name
// with a hash, so that they are told apart, and hashes do not compress.
import { readFileSync, writeFileSync } from "node:fs";
import { findSection, Reader } from "./binary.mjs";

const importSection = 2;
const functionKind = 0;

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

/** Renames the functions that the module imports, in it and in its glue. */
export function shortenImports(wasmFile, glueFile) {
  const wasm = readFileSync(wasmFile);
  const { head, start, end } = findSection(wasm, importSection);
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
