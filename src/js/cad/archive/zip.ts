import { HausdorffError } from "../../error.js";
import { inflate } from "./inflate.js";

const END_OF_DIRECTORY = 0x06054b50;
const DIRECTORY_ENTRY = 0x02014b50;
/** Bytes of the end record without its comment, and of the longest comment. */
const END_LENGTH = 22;
const MAX_COMMENT = 0xffff;
const ENTRY_LENGTH = 46;
const LOCAL_LENGTH = 30;
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
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const first = Math.max(0, bytes.length - END_LENGTH - MAX_COMMENT);
  let end = bytes.length - END_LENGTH;
  while (end >= first && view.getUint32(end, true) !== END_OF_DIRECTORY) end -= 1;
  if (end < first) throw damaged("it has no directory");
  const entries: ZipEntry[] = [];
  try {
    let at = view.getUint32(end + 16, true);
    for (let left = view.getUint16(end + 10, true); left > 0; left -= 1) {
      if (view.getUint32(at, true) !== DIRECTORY_ENTRY) throw damaged("an entry has no signature");
      const nameLength = view.getUint16(at + 28, true);
      const name = new TextDecoder().decode(slice(bytes, at + ENTRY_LENGTH, nameLength));
      const local = view.getUint32(at + 42, true);
      const data =
        local + LOCAL_LENGTH + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
      entries.push({
        name,
        method: view.getUint16(at + 10, true),
        data: slice(bytes, data, view.getUint32(at + 20, true)),
      });
      const extraLength = view.getUint16(at + 30, true);
      const commentLength = view.getUint16(at + 32, true);
      at += ENTRY_LENGTH + nameLength + extraLength + commentLength;
    }
  } catch (error) {
    if (error instanceof RangeError) throw damaged("it ends early");
    throw error;
  }
  return entries;
}

function slice(bytes: Uint8Array, start: number, length: number): Uint8Array {
  if (start + length > bytes.length) throw damaged("an entry ends behind the file");
  return bytes.subarray(start, start + length);
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
