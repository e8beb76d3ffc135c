import { HausdorffError } from "../../error.js";

/**
 * Loads a library: a function that resolves to its started module, to the function that
 * starts it, or to the ES module whose default export is one of these; or the address
 * of that ES module, which alone can be sent to a worker.
 */
export type PeerLoader = (() => unknown) | string | URL;

/** The loaders of libraries. */
export interface Libraries {
  /**
   * Loads OpenCASCADE, for what `reader` says. Default in Node: the package
   * `@bitbybit-dev/occt`; elsewhere there is none.
   */
  occt?: PeerLoader;
  /** Loads rhino3dm for 3DM. Default in Node: the package `rhino3dm`; elsewhere there is none. */
  rhino?: PeerLoader;
}

/** How libraries are loaded. */
export interface LibraryOptions extends Libraries {
  /** Called before a library is loaded, which can take seconds. */
  onLibrary?: (library: keyof Libraries) => void;
}

/** A library that is loaded when a file needs it. */
export interface Peer {
  /** Its package. */
  name: string;
  /** What it is needed for. */
  purpose: string;
  /** The option of `readCad` that loads it otherwise. */
  option: keyof Libraries;
  /** The file imported in Node. */
  node: string;
}

/** Keeps a library's chatter off the standard output. */
const QUIET = { print: () => {}, printErr: () => {} };

const started = new Map<unknown, Promise<object>>();

/**
 * The started module, started once; after a failure it can be started again.
 *
 * @throws {HausdorffError} `PEER_MISSING` with the command that installs it.
 */
export function start(peer: Peer, options: LibraryOptions): Promise<object> {
  const key = keyOf(peer, options);
  let module = started.get(key);
  if (module === undefined) {
    options.onLibrary?.(peer.option);
    module = load(peer, options[peer.option]);
    started.set(key, module);
    module.catch(() => started.delete(key));
  }
  return module;
}

/** Forgets a module that may be in an undefined state after an exception. */
export function restart(peer: Peer, options: LibraryOptions): void {
  started.delete(keyOf(peer, options));
}

/** What stands for a module that is started once: equal addresses are one. */
function keyOf(peer: Peer, options: LibraryOptions): unknown {
  const loader = options[peer.option];
  return loader instanceof URL ? loader.href : (loader ?? peer);
}

async function load(peer: Peer, loader: PeerLoader | undefined): Promise<object> {
  const imported =
    typeof loader === "function" ? await called(peer, loader) : await importPeer(peer, loader);
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

/** What a function loads; it fails for example without a network. */
async function called(peer: Peer, loader: () => unknown): Promise<unknown> {
  try {
    return await loader();
  } catch (cause) {
    throw missing(peer, `the function of the option ${peer.option} failed: ${cause}`, { cause });
  }
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

/**
 * Imports a library where no bundler looks: an optional package that a bundler resolved would
 * have to be installed, and their ways to find their wasm files differ.
 */
async function importPeer(peer: Peer, address: string | URL | undefined): Promise<unknown> {
  const from = address === undefined ? defaultAddress(peer) : `${address}`;
  try {
    return await import(/* @vite-ignore */ /* webpackIgnore: true */ from);
  } catch (cause) {
    throw missing(peer, `npm install ${peer.name}, or pass the option ${peer.option}`, { cause });
  }
}

function defaultAddress(peer: Peer): string {
  if (isNode()) return peer.node;
  throw missing(
    peer,
    `pass the option ${peer.option}: the function that imports it, or its address`,
  );
}

function missing(peer: Peer, remedy: string, options?: ErrorOptions): HausdorffError {
  const message = `${peer.purpose} needs ${peer.name}: ${remedy}`;
  return new HausdorffError("PEER_MISSING", message, options);
}

/** Whether this runs in Node, where packages are imported without a bundler. */
function isNode(): boolean {
  const { process } = globalThis as { process?: { versions?: { node?: string } } };
  return process?.versions?.node !== undefined;
}
