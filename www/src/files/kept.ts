// The files open, kept in this browser over a reload until the user forgets them: each by its
// content, so that windows with other files do not replace them.
import { SIDES, type Sides } from "../worker/protocol.ts";
import { type FileName, isNamed } from "./identity.ts";

const DATABASE = "nurbs-hausdorff";
const STORE = "files";
/** The key of the files that were compared last, with their options. */
const LAST = "last";
/** What the keys of files begin with. */
const PREFIX = "file ";
/** Files kept: those of a few windows. */
const MAX_FILES = 8;

/** A file, and when it was opened last. */
interface Kept extends FileName {
  file: File;
  opened: number;
}

interface Last {
  files: Sides<FileName>;
  state: string;
}

const keyOf = ({ name, hash }: FileName): string => `${PREFIX}${hash === "" ? name : hash}`;

/** Keeps the files of a comparison, and forgets those that were opened long before. */
export const keepFiles = (files: Sides<FileName & { file: File }>): Promise<void> =>
  change(async (store) => {
    for (const one of Object.values(files)) {
      const { name, hash, file } = one;
      store.put({ name, hash, file, opened: Date.now() } satisfies Kept, keyOf(one));
    }
    const all = await keptIn(store);
    all.sort((one, other) => other.opened - one.opened);
    for (const old of all.slice(MAX_FILES)) store.delete(keyOf(old));
  });

/** Keeps which files are compared, and the options with which they are. */
export const keepLast = (files: Sides<FileName>, state: string): Promise<void> =>
  change((store) => store.put({ files, state } satisfies Last, LAST));

/** Forgets all files. */
export const forgetFiles = (): Promise<void> => change((store) => store.clear());

/** Returns which files were compared last, and their options. */
export async function lastFiles(): Promise<Last> {
  let last: Last = { files: {}, state: "" };
  await change(async (store) => {
    const found = await read(store.get(LAST));
    if (isLast(found)) last = found;
  });
  return last;
}

/** Returns the files that are kept of those named. */
export async function keptFiles(wanted: Sides<FileName>): Promise<Sides<File>> {
  const files: Sides<File> = {};
  await change(async (store) => {
    const all = await keptIn(store);
    for (const side of SIDES) {
      const name = wanted[side];
      const found = name && all.find((one) => isNamed(one, name));
      if (found !== undefined) files[side] = found.file;
    }
  });
  return files;
}

const isLast = (found: unknown): found is Last =>
  typeof found === "object" && found !== null && "files" in found && "state" in found;

const isKept = (found: unknown): found is Kept =>
  typeof found === "object" && found !== null && "file" in found && found.file instanceof File;

const keptIn = async (store: IDBObjectStore): Promise<Kept[]> =>
  (await read(store.getAll())).filter(isKept);

/** Does something with the store. A browser that keeps nothing, as in private windows, is no error. */
async function change(work: (store: IDBObjectStore) => unknown): Promise<void> {
  try {
    const database = await opened();
    const transaction = database.transaction(STORE, "readwrite");
    const ended = new Promise<void>((resolve, reject) => {
      transaction.oncomplete = () => resolve();
      transaction.onabort = () => reject(transaction.error);
    });
    await work(transaction.objectStore(STORE));
    await ended;
    database.close();
  } catch {
    // The page works without.
  }
}

function opened(): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(DATABASE, 1);
    request.onupgradeneeded = () => request.result.createObjectStore(STORE);
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

function read<T>(request: IDBRequest<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}
