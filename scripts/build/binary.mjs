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

/** Where a section lies: its head, its content and its end. */
export function findSection(wasm, wanted) {
  const reader = new Reader(wasm, sections);
  while (reader.at < wasm.length) {
    const head = reader.at;
    const id = wasm[reader.at++];
    const size = reader.number();
    if (id === wanted) return { head, start: reader.at, end: reader.at + size };
    reader.at += size;
  }
  throw new Error(`the wasm module has no section ${wanted}`);
}
