import { HausdorffError } from "../../error.js";
import { BinaryReader } from "./binary-reader.js";
import { inflate } from "./inflate.js";

/** The signatures of records (APPNOTE.TXT 6.3, section 4.3). */
const END_OF_DIRECTORY = 0x06054b50;
const DIRECTORY_ENTRY = 0x02014b50;
const LOCAL_HEADER = 0x04034b50;
/** Bytes of the end record without its comment, and of the longest comment. */
const END_LENGTH = 22;
const MAX_COMMENT = 0xffff;
const STORED = 0;
const DEFLATED = 8;

/** A file in a zip archive. */
export interface ZipEntry {
  name: string;
  method: number;
  /** Its compressed bytes. */
  data: Uint8Array;
}

function damaged(what: string): HausdorffError {
  return new HausdorffError("CAD_UNREADABLE", `the zip archive is damaged: ${what}`);
}

/**
 * The entries of an archive by its central directory (APPNOTE.TXT 6.3, section 4.3).
 *
 * @throws {HausdorffError} `CAD_UNREADABLE`.
 */
export function zipEntries(bytes: Uint8Array): ZipEntry[] {
  const end = readerAt(bytes, endOfDirectory(bytes));
  // Signature, numbers of disks, entries on this disk.
  end.skip(4 + 2 + 2 + 2);
  const count = end.uint16();
  // The directory's length.
  end.skip(4);
  const directory = readerAt(bytes, end.uint32());
  return Array.from({ length: count }, () => directoryEntry(bytes, directory));
}

function endOfDirectory(bytes: Uint8Array): number {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const first = Math.max(0, bytes.length - END_LENGTH - MAX_COMMENT);
  for (let at = bytes.length - END_LENGTH; at >= first; at -= 1) {
    if (view.getUint32(at, true) === END_OF_DIRECTORY) return at;
  }
  throw damaged("it has no directory");
}

function directoryEntry(bytes: Uint8Array, directory: BinaryReader): ZipEntry {
  if (directory.uint32() !== DIRECTORY_ENTRY) throw damaged("an entry has no signature");
  // Two versions, flags.
  directory.skip(2 + 2 + 2);
  const method = directory.uint16();
  // Time, date, checksum.
  directory.skip(2 + 2 + 4);
  const compressed = directory.uint32();
  // The expanded length.
  directory.skip(4);
  const [nameLength, extraLength, commentLength] = [
    directory.uint16(),
    directory.uint16(),
    directory.uint16(),
  ];
  // Disk, attributes inside and outside.
  directory.skip(2 + 2 + 4);
  const local = readerAt(bytes, directory.uint32());
  const name = new TextDecoder().decode(directory.bytes(nameLength));
  directory.skip(extraLength + commentLength);
  if (local.uint32() !== LOCAL_HEADER) throw damaged(`${name} has no header`);
  // Version, flags, method, time, date, checksum and both lengths, which the directory has too.
  local.skip(2 + 2 + 2 + 2 + 2 + 4 + 4 + 4);
  const [localName, localExtra] = [local.uint16(), local.uint16()];
  local.skip(localName + localExtra);
  return { name, method, data: local.bytes(compressed) };
}

function readerAt(bytes: Uint8Array, start: number): BinaryReader {
  if (start > bytes.length) throw damaged("it ends early");
  return new BinaryReader(
    new DataView(bytes.buffer, bytes.byteOffset + start, bytes.length - start),
    damaged,
  );
}

/**
 * The bytes of an entry.
 *
 * @throws {HausdorffError} `CAD_UNREADABLE`, `FILE_TOO_LARGE`.
 */
export async function entryBytes({ name, method, data }: ZipEntry): Promise<Uint8Array> {
  if (method === STORED) return data;
  if (method === DEFLATED) return inflate(data, "deflate-raw");
  throw damaged(`${name} is compressed by method ${method}, expected 0 or 8`);
}
