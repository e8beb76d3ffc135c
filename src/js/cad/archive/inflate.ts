import { HausdorffError } from "../../error.js";

/**
 * The largest size, in bytes, to which compressed content is expanded: the
 * largest model text that is read.
 */
const MAX_EXPANDED = 256 * 2 ** 20;

/**
 * Expands bytes compressed by gzip or by zip's method 8.
 *
 * @throws {HausdorffError} `CAD_UNREADABLE` for damaged bytes, `FILE_TOO_LARGE`.
 */
export async function inflate(
  bytes: Uint8Array,
  format: "gzip" | "deflate-raw",
): Promise<Uint8Array> {
  const stream = new Blob([bytes as BlobPart]).stream();
  const reader = stream.pipeThrough(new DecompressionStream(format)).getReader();
  const chunks: Uint8Array[] = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read().catch((cause: unknown) => {
      throw new HausdorffError("CAD_UNREADABLE", "the compressed content is damaged", { cause });
    });
    if (done) break;
    chunks.push(value);
    length += value.length;
    if (length > MAX_EXPANDED) {
      void reader.cancel();
      throw new HausdorffError(
        "FILE_TOO_LARGE",
        `the compressed content expands beyond ${MAX_EXPANDED} bytes`,
      );
    }
  }
  return joined(chunks, length);
}

function joined(chunks: readonly Uint8Array[], length: number): Uint8Array {
  const all = new Uint8Array(length);
  let offset = 0;
  for (const chunk of chunks) {
    all.set(chunk, offset);
    offset += chunk.length;
  }
  return all;
}
