import { HausdorffError } from "../../error.js";

/** Type codes of openNURBS' archive chunks. */
const CLASS = 0x00027ffa;
const CLASS_UUID = 0x0002fffb;
const CLASS_DATA = 0x0002fffc;
const ANONYMOUS = 0x40008000;

/** Bytes of a chunk's head: type code and 64-bit length. */
const HEAD_LENGTH = 12;
const UUID_LENGTH = 16;

/** An object of an openNURBS archive: the class's UUID and the reader of its data. */
export interface ArchiveObject {
  uuid: string;
  data: ChunkReader;
}

/** Reads openNURBS' little-endian archive format from one chunk. */
export class ChunkReader {
  readonly #view: DataView;
  #at: number;
  readonly #end: number;

  constructor(view: DataView, start = 0, end = view.byteLength) {
    this.#view = view;
    this.#at = start;
    this.#end = end;
  }

  /** The reader of base64 text, as `CommonObject.encode().data` has it. */
  static ofBase64(text: string): ChunkReader {
    const binary = atob(text);
    const bytes = Uint8Array.from(binary, (character) => character.charCodeAt(0));
    return new ChunkReader(new DataView(bytes.buffer));
  }

  byte(): number {
    return this.#view.getUint8(this.#take(1));
  }

  int(): number {
    return this.#view.getInt32(this.#take(4), true);
  }

  double(): number {
    return this.#view.getFloat64(this.#take(8), true);
  }

  skip(bytes: number): void {
    this.#take(bytes);
  }

  /** A number of items that take at least `bytes` each. */
  count(bytes: number): number {
    const count = this.int();
    if (count < 0 || count * bytes > this.#end - this.#at) {
      throw damaged(`a list of ${count} items does not fit its chunk`);
    }
    return count;
  }

  doubles(count: number): number[] {
    return Array.from({ length: count }, () => this.double());
  }

  ints(count: number): number[] {
    return Array.from({ length: count }, () => this.int());
  }

  /** A list of numbers with its length before it. */
  doubleList(): number[] {
    return this.doubles(this.count(8));
  }

  intList(): number[] {
    return this.ints(this.count(4));
  }

  /** The reader of an anonymous chunk, behind its version of one byte. */
  anonymous(): ChunkReader {
    const chunk = this.#chunk(ANONYMOUS);
    chunk.version();
    return chunk;
  }

  /**
   * The minor version; the major must be 1.
   *
   * @throws {HausdorffError} `CAD_UNREADABLE`.
   */
  version(major = 1): number {
    const version = this.byte();
    if (version >> 4 !== major) {
      throw damaged(`a chunk has the version ${version >> 4}, expected ${major}`);
    }
    return version & 0xf;
  }

  object(): ArchiveObject {
    const object = this.#chunk(CLASS);
    const uuid = object.#chunk(CLASS_UUID).#uuid();
    return { uuid, data: object.#chunk(CLASS_DATA) };
  }

  #chunk(expected: number): ChunkReader {
    const start = this.#take(HEAD_LENGTH);
    const code = this.#view.getUint32(start, true);
    if (code !== expected) {
      throw damaged(`a chunk has the type ${code.toString(16)}, expected ${expected.toString(16)}`);
    }
    const length = Number(this.#view.getBigInt64(start + 4, true));
    if (!(length >= 0)) throw damaged(`a chunk has the length ${length}`);
    const content = this.#take(length);
    return new ChunkReader(this.#view, content, content + length);
  }

  /** As text, the first three groups being little-endian numbers. */
  #uuid(): string {
    const start = this.#take(UUID_LENGTH);
    const order = [3, 2, 1, 0, 5, 4, 7, 6, 8, 9, 10, 11, 12, 13, 14, 15];
    const hex = order.map((at) =>
      this.#view
        .getUint8(start + at)
        .toString(16)
        .padStart(2, "0"),
    );
    return hex.join("").toUpperCase();
  }

  #take(bytes: number): number {
    const start = this.#at;
    if (start + bytes > this.#end) throw damaged("a chunk ends early");
    this.#at = start + bytes;
    return start;
  }
}

/** The error for an archive that breaks its own format. */
export function damaged(what: string): HausdorffError {
  return new HausdorffError("CAD_UNREADABLE", `the Rhino B-rep is damaged: ${what}`);
}
