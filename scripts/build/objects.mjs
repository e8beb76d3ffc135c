// The objects that the module's data consists of, one for each constant and
// variable of the program, and what refers to them: the linker says so in
// sections of their own if told to emit relocations.
import { readFileSync, writeFileSync } from "node:fs";
import { dataSection, eachSection, findSection, Reader, segments } from "./binary.mjs";

/** Names and numbers of the object file format, WebAssembly/tool-conventions, Linking.md. */
const format = {
  version: 2,
  symbolTable: 8,
  symbol: { data: 1, section: 3 },
  flag: { undefined: 0x10, explicitName: 0x40 },
  /** Addresses in code and in data; what else is relocated is no address. */
  address: new Set([3, 4, 5]),
  other: new Set([0, 1, 2, 6, 7, 13, 20]),
};

const sectionsOfLinker = /^(linking|reloc\..*)$/;

/** The symbols, of which those of data have the object they stand for. */
function symbols(wasm) {
  const { start, end } = findSection(wasm, "linking");
  const reader = new Reader(wasm, start);
  if (reader.number() !== format.version) throw new Error("another version of the linker's format");
  while (wasm[reader.at++] !== format.symbolTable) {
    reader.at += reader.number();
    if (reader.at >= end) throw new Error("the linker wrote no symbols");
  }
  reader.number();
  const bases = segments(wasm).map(({ address }) => address);
  return Array.from({ length: reader.number() }, () => {
    const kind = wasm[reader.at++];
    const flags = reader.number();
    const isDefined = (flags & format.flag.undefined) === 0;
    if (kind === format.symbol.data) {
      reader.text();
      if (!isDefined) return {};
      const base = bases[reader.number()];
      const first = base + reader.number();
      return { object: { first, end: first + reader.number(), pointers: [], isOpen: false } };
    }
    reader.number();
    const isNamed = isDefined || (flags & format.flag.explicitName) !== 0;
    if (kind !== format.symbol.section && isNamed) reader.text();
    return {};
  });
}

/** The relocations of a section: where an address is written, and which. */
function* relocations(wasm, name, symbols) {
  const reader = new Reader(wasm, findSection(wasm, name).start);
  reader.number();
  for (let count = reader.number(); count > 0; count--) {
    const kind = wasm[reader.at++];
    const offset = reader.number();
    const { object } = symbols[reader.number()] ?? {};
    if (format.address.has(kind)) {
      const addend = reader.signed();
      if (object) yield { offset, object, address: object.first + addend };
    } else if (!format.other.has(kind)) {
      throw new Error(`a relocation of kind ${kind}`);
    }
  }
}

/**
 * The objects, each with those that its `pointers` point to, and the objects
 * that the code means by an address. Takes the linker's sections from the file.
 */
export function takeObjects(wasmFile) {
  const wasm = readFileSync(wasmFile);
  const found = symbols(wasm);
  const objects = found.flatMap(({ object }) => object ?? []);

  const meant = new Map();
  for (const { object, address } of relocations(wasm, "reloc.CODE", found)) {
    meant.set(address, [...(meant.get(address) ?? []), object]);
    // What is folded into an address outside need not lie inside.
    if (address < object.first || address > object.end) object.isOpen = true;
  }

  const data = segments(wasm);
  const { start } = findSection(wasm, dataSection);
  for (const { offset, object, address } of relocations(wasm, "reloc.DATA", found)) {
    const at = start + offset;
    const within = data.find(
      (segment) => at >= segment.start && at < segment.start + segment.bytes.length,
    );
    if (!within || wasm.readUInt32LE(at) !== address)
      throw new Error("a pointer is not where it should be");
    const from = within.address + at - within.start;
    for (const holder of objects) {
      if (from >= holder.first && from < holder.end) holder.pointers.push(object);
    }
  }

  const kept = [...eachSection(wasm)].filter(({ name }) => !sectionsOfLinker.test(name ?? ""));
  const parts = kept.map(({ head, end }) => wasm.subarray(head, end));
  writeFileSync(wasmFile, Buffer.concat([wasm.subarray(0, kept[0].head), ...parts]));
  return { objects, meant };
}
