import { HausdorffError } from "../../error.js";
import { BinaryReader } from "../archive/binary-reader.js";

/** Type codes of openNURBS' archive chunks. */
const CLASS = 0x00027ffa;
const CLASS_UUID = 0x0002fffb;
const CLASS_DATA = 0x0002fffc;
const ANONYMOUS = 0x40008000;

const UUID_LENGTH = 16;

/** An object of an openNURBS archive: the class's UUID and the reader of its data. */
export interface ArchiveObject {
  uuid: string;
  data: ChunkReader;
}

/** Reads openNURBS' little-endian archive format from one chunk. */
export class ChunkReader extends BinaryReader {
  constructor(view: DataView) {
    super(view, damaged);
  }

  /** The reader of base64 text, as `CommonObject.encode().data` has it. */
  static ofBase64(text: string): ChunkReader {
    const binary = atob(text);
    const bytes = Uint8Array.from(binary, (character) => character.charCodeAt(0));
    return new ChunkReader(new DataView(bytes.buffer));
  }

  /** A number of items that take at least `bytes` each. */
  count(bytes: number): number {
    const count = this.int32();
    if (count < 0 || count * bytes > this.left) {
      throw damaged(`a list of ${count} items does not fit its chunk`);
    }
    return count;
  }

  doubles(count: number): number[] {
    return Array.from({ length: count }, () => this.float64());
  }

  ints(count: number): number[] {
    return Array.from({ length: count }, () => this.int32());
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
    const version = this.uint8();
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
    const code = this.uint32();
    if (code !== expected) {
      throw damaged(`a chunk has the type ${code.toString(16)}, expected ${expected.toString(16)}`);
    }
    return new ChunkReader(this.part(this.int64()));
  }

  /** As text, the first three groups being little-endian numbers. */
  #uuid(): string {
    const bytes = this.bytes(UUID_LENGTH);
    const order = [3, 2, 1, 0, 5, 4, 7, 6, 8, 9, 10, 11, 12, 13, 14, 15];
    const hex = order.map((at) => (bytes[at] ?? 0).toString(16).padStart(2, "0"));
    return hex.join("").toUpperCase();
  }
}

/** The error for an archive that breaks its own format. */
export function damaged(what: string): HausdorffError {
  return new HausdorffError("CAD_UNREADABLE", `the Rhino B-rep is damaged: ${what}`);
}
