// Files for the tests of the readers: those of the shared models, and archives made here.
import { existsSync, readFileSync } from "node:fs";
import { crc32, deflateRawSync, gunzipSync } from "node:zlib";

const shared = new URL("../../../../shared/models/", import.meta.url);

/** Whether the shared models are there; the reason for which a test that needs them is skipped. */
export const missing = existsSync(shared) ? false : "SKIPPED: ../shared/models is absent";

/** The bytes of a shared model, unpacked. */
export const sharedFile = (path) => new Uint8Array(gunzipSync(sharedGzip(path)));

/** The same as it is stored. */
export const sharedGzip = (path) => readFileSync(new URL(`${path}.gz`, shared));

/** The bytes of a text of one byte a character. */
export const bytesOf = (text) => Uint8Array.from(text, (character) => character.charCodeAt(0));

/** A zip archive of texts by their names, compressed if `method` is 8. */
export function zip(files, method = 8) {
  const locals = [];
  const directory = [];
  let offset = 0;
  for (const [name, text] of Object.entries(files)) {
    const content = Buffer.from(text);
    const data = method === 8 ? deflateRawSync(content) : content;
    const common = Buffer.alloc(26);
    common.writeUInt16LE(20, 0);
    common.writeUInt16LE(method, 4);
    common.writeUInt32LE(crc32?.(content) ?? 0, 10);
    common.writeUInt32LE(data.length, 14);
    common.writeUInt32LE(content.length, 18);
    common.writeUInt16LE(name.length, 22);
    const local = Buffer.concat([bytesOf("PK\x03\x04"), common, bytesOf(name), data]);
    const entry = Buffer.alloc(14);
    entry.writeUInt32LE(offset, 10);
    directory.push(bytesOf("PK\x01\x02\x14\x00"), common, entry, bytesOf(name));
    locals.push(local);
    offset += local.length;
  }
  const list = Buffer.concat(directory);
  const end = Buffer.alloc(18);
  end.writeUInt16LE(Object.keys(files).length, 4);
  end.writeUInt16LE(Object.keys(files).length, 6);
  end.writeUInt32LE(list.length, 8);
  end.writeUInt32LE(offset, 12);
  return new Uint8Array(Buffer.concat([...locals, list, bytesOf("PK\x05\x06"), end]));
}
