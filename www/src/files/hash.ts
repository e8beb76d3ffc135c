// The hash of a file's content, here or in a worker.

/** Returns the SHA-256 of a file as hexadecimal digits. */
export async function sha256Of(file: File): Promise<string> {
  const hash = await crypto.subtle.digest("SHA-256", await file.arrayBuffer());
  return [...new Uint8Array(hash)].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}
