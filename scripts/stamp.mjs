// Stamps, which record the inputs from which something was made.
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { inRoot } from "./paths.mjs";

function* filesUnder(path) {
  if (!existsSync(path)) return;
  if (!statSync(path).isDirectory()) {
    yield path;
    return;
  }
  for (const name of readdirSync(path).sort()) yield* filesUnder(join(path, name));
}

/** Returns a digest of files and folders of the checkout, and of other strings. */
export function digest(paths, strings = []) {
  const hash = createHash("sha256");
  for (const path of paths) {
    for (const file of filesUnder(inRoot(path))) {
      hash
        .update(`${file.slice(inRoot().length)}\0`)
        .update(readFileSync(file))
        .update("\0");
    }
  }
  for (const string of strings) hash.update(`${string}\0`);
  return hash.digest("hex").slice(0, 16);
}

/** Returns whether the stamp at this path of the checkout holds this digest. */
export function stamped(path, value) {
  const file = inRoot(path);
  return existsSync(file) && readFileSync(file, "utf8") === value;
}

/** Writes a digest as the stamp at this path of the checkout. */
export function stamp(path, value) {
  mkdirSync(dirname(inRoot(path)), { recursive: true });
  writeFileSync(inRoot(path), value);
}
