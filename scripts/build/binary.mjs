// The binary format of wasm modules, as far as the build reads it.

/** Where the sections begin: after the magic number and the version. */
const sections = 8;

/** Reads numbers and texts of the binary format in turn. */
export class Reader {
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

  signed() {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = this.bytes[this.at++];
      value += (byte & 0x7f) * 2 ** shift;
      if (byte < 0x80) return byte & 0x40 ? value - 2 ** (shift + 7) : value;
    }
  }

  text() {
    const length = this.number();
    this.at += length;
    return this.bytes.toString("utf8", this.at - length, this.at);
  }
}

const custom = 0;

/** The sections: their numbers, names if custom, heads, contents and ends. */
export function* eachSection(wasm) {
  const reader = new Reader(wasm, sections);
  while (reader.at < wasm.length) {
    const head = reader.at;
    const id = wasm[reader.at++];
    const size = reader.number();
    const end = reader.at + size;
    const name = id === custom ? reader.text() : undefined;
    yield { id, name, head, start: reader.at, end };
    reader.at = end;
  }
}

/** Where the section lies that has the number, or that is custom and has the name. */
export function findSection(wasm, wanted) {
  for (const section of eachSection(wasm)) {
    if (wanted === section.id || wanted === section.name) return section;
  }
  throw new Error(`the wasm module has no section ${wanted}`);
}

export const dataSection = 11;
const constant = 0x41;
const endOfConstant = 0x0b;

/** The module's data: where it lies in the file, and in memory. */
export function segments(wasm) {
  const reader = new Reader(wasm, findSection(wasm, dataSection).start);
  const found = [];
  for (let count = reader.number(); count > 0; count--) {
    const isActive = reader.number() === 0;
    if (!isActive || wasm[reader.at++] !== constant) throw new Error("data at no fixed address");
    const address = reader.signed();
    if (wasm[reader.at++] !== endOfConstant) throw new Error("data at no fixed address");
    const length = reader.number();
    const start = reader.at;
    found.push({ address, start, bytes: wasm.subarray(start, start + length) });
    reader.at += length;
  }
  return found;
}
