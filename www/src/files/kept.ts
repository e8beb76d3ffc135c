// The files open, kept in this browser over a reload until the user forgets them.
import { SIDES, type Side, type Sides } from "../worker/protocol.ts";

const DATABASE = "nurbs-hausdorff";
const STORE = "files";
/** The key of the options that belong to the files. */
const STATE = "state";

/** Keeps the file of a side; without one, forgets that side's. */
export function keepFile(side: Side, file: File | undefined): Promise<void> {
  return change((store) => (file === undefined ? store.delete(side) : store.put(file, side)));
}

/** Keeps the options with which the files are compared. */
export const keepState = (state: string): Promise<void> =>
  change((store) => store.put(state, STATE));

/** Forgets all files. */
export const forgetFiles = (): Promise<void> => change((store) => store.clear());

/** Returns the files kept, and their options. */
export async function keptFiles(): Promise<{ files: Sides<File>; state: string }> {
  const files: Sides<File> = {};
  let state = "";
  await change(async (store) => {
    const [a, b, text] = await Promise.all(["a", "b", STATE].map((key) => read(store, key)));
    for (const [index, file] of [a, b].entries()) {
      const side = SIDES[index];
      if (file instanceof File && side !== undefined) files[side] = file;
    }
    if (typeof text === "string") state = text;
  });
  return { files, state };
}

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

function read(store: IDBObjectStore, key: string): Promise<unknown> {
  return new Promise((resolve, reject) => {
    const request = store.get(key);
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}
