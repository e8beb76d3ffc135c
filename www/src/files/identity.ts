// What names a file wherever it is: its name, and the hash of its content.

import { SIDES, type Side, type Sides } from "../worker/protocol.ts";
import { sha256Of } from "./hash.ts";

/** A file as a link names it; without a hash where the page that made the link could compute none. */
export interface FileName {
  name: string;
  hash: string;
}

/** Digits of a hash that tell files apart where people read it. */
const SHORT = 12;

const hashes = new WeakMap<File, Promise<string>>();

/** Returns the SHA-256 of a file; only pages from a safe origin have it, others get no text. */
export function hashOf(file: File): Promise<string> {
  let hash = hashes.get(file);
  if (hash === undefined) {
    hash = computed(file);
    hashes.set(file, hash);
  }
  return hash;
}

/** The bytes from which on a worker is worth its start: the page would stand still for 10 ms a MB. */
const LARGE = 2 ** 21;

async function computed(file: File): Promise<string> {
  if (globalThis.crypto?.subtle === undefined) return "";
  if (file.size < LARGE) return sha256Of(file);
  const worker = new Worker(new URL("./hashWorker.ts", import.meta.url), { type: "module" });
  try {
    const hash = await new Promise<string | undefined>((resolve, reject) => {
      worker.onmessage = ({ data }: MessageEvent<string | undefined>) => resolve(data);
      worker.onerror = ({ message }) => reject(new Error(message));
      worker.postMessage(file);
    });
    // A file that cannot be read says so here.
    return hash ?? (await sha256Of(file));
  } finally {
    worker.terminate();
  }
}

/** Returns what names a file. */
export const nameOf = async (file: File): Promise<FileName> => ({
  name: file.name,
  hash: await hashOf(file).catch(() => ""),
});

/** Whether a file is the one that is named; without a hash, one of its name is. */
export const isNamed = (file: FileName, wanted: FileName): boolean =>
  wanted.hash === "" || file.hash === "" ? file.name === wanted.name : file.hash === wanted.hash;

/** The first digits of a hash, for people. */
export const shortHash = (hash: string): string => hash.slice(0, SHORT);

const nameKey = (side: Side): string => `file-${side}`;
const hashKey = (side: Side): string => `sha256-${side}`;

/** The names of all parameters of a link that name files. */
export const FILE_PARAMETERS = SIDES.flatMap((side) => [nameKey(side), hashKey(side)]);

/** The parameters of a link that name files. */
export function parametersOf(files: Sides<FileName>): string {
  const parameters = new URLSearchParams();
  for (const side of SIDES) {
    const file = files[side];
    if (file === undefined) continue;
    parameters.set(nameKey(side), file.name);
    if (file.hash !== "") parameters.set(hashKey(side), file.hash);
  }
  return parameters.toString();
}

/** The files that a link names. */
export function filesNamedBy(link: string | undefined): Sides<FileName> {
  const parameters = new URLSearchParams(link);
  const files: Sides<FileName> = {};
  for (const side of SIDES) {
    const name = parameters.get(nameKey(side));
    if (name !== null) files[side] = { name, hash: parameters.get(hashKey(side)) ?? "" };
  }
  return files;
}
