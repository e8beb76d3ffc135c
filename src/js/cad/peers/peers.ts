import { HausdorffError } from "../../error.js";

/**
 * Loads a library: resolves to its started module, to the function that starts
 * it, or to the ES module whose default export is one of these.
 */
export type PeerLoader = () => unknown;

/** A library that is loaded when a file needs it. */
export interface Peer {
  /** Its package. */
  name: string;
  /** What it is needed for. */
  purpose: string;
  /** The option of `readCad` that loads it otherwise. */
  option: string;
  /** The file imported in Node. */
  node: string;
  /** Imports it where a bundler resolves it. */
  bundled: PeerLoader;
}

/** Keeps a library's chatter off the standard output. */
const QUIET = { print: () => {}, printErr: () => {} };

const started = new Map<PeerLoader | Peer, Promise<object>>();

/**
 * The started module, started once; after a failure it can be started again.
 *
 * @throws {HausdorffError} `PEER_MISSING` with the command that installs it.
 */
export function start(peer: Peer, loader: PeerLoader | undefined): Promise<object> {
  const key = loader ?? peer;
  let module = started.get(key);
  if (module === undefined) {
    module = load(peer, loader);
    started.set(key, module);
    module.catch(() => started.delete(key));
  }
  return module;
}

/** Forgets a module that may be in an undefined state after an exception. */
export function restart(peer: Peer, loader: PeerLoader | undefined): void {
  started.delete(loader ?? peer);
}

async function load(peer: Peer, loader: PeerLoader | undefined): Promise<object> {
  const imported = loader ? await loader() : await importPeer(peer);
  let module = unwrapped(imported);
  // `module` is bitbybit's name for what others take themselves.
  if (typeof module === "function") {
    const factory = module;
    module = unwrapped(await withoutListeners(() => factory({ ...QUIET, module: QUIET })));
  }
  if (typeof module !== "object" || module === null) {
    throw new HausdorffError(
      "OPTION_INVALID",
      `${peer.option} loads ${typeof module}, expected the module or the function that starts it`,
    );
  }
  return module;
}

type Factory = (options: object) => unknown;

function unwrapped(value: unknown): object | Factory | null | undefined {
  const { default: inner } = (value ?? {}) as { default?: unknown };
  return (typeof value === "object" && inner !== undefined ? inner : value) as object;
}

/** The part of Node's process on which Emscripten's modules listen. */
interface Listened {
  listeners(event: string): readonly unknown[];
  removeListener(event: string, listener: unknown): void;
}

const LISTENED_EVENTS = ["uncaughtException", "unhandledRejection"];

/**
 * Calls `run` and takes the listeners that it adds to Node's process off again. Emscripten's throw
 * what they are given, as Node does without them, and keep every module that was started alive.
 */
function withoutListeners<T>(run: () => T): T {
  const { process } = globalThis as { process?: Partial<Listened> };
  if (process?.listeners === undefined || process.removeListener === undefined) return run();
  const listened = process as Listened;
  const before = LISTENED_EVENTS.map((event) => new Set(listened.listeners(event)));
  try {
    return run();
  } finally {
    for (const [index, event] of LISTENED_EVENTS.entries()) {
      for (const listener of listened.listeners(event)) {
        if (!before[index]?.has(listener)) listened.removeListener(event, listener);
      }
    }
  }
}

async function importPeer(peer: Peer): Promise<unknown> {
  try {
    return await (isNode()
      ? import(/* @vite-ignore */ /* webpackIgnore: true */ peer.node)
      : peer.bundled());
  } catch (cause) {
    throw new HausdorffError(
      "PEER_MISSING",
      `${peer.purpose} needs ${peer.name}: npm install ${peer.name}, or pass the option ${peer.option}`,
      { cause },
    );
  }
}

/** Whether this runs in Node, where packages are imported without a bundler. */
function isNode(): boolean {
  const { process } = globalThis as { process?: { versions?: { node?: string } } };
  return process?.versions?.node !== undefined;
}
