// Running programs, with their output shown, hidden or returned.
import { AsyncLocalStorage } from "node:async_hooks";
import { spawn, spawnSync } from "node:child_process";
import { accessSync, constants } from "node:fs";
import { homedir } from "node:os";
import { delimiter, join } from "node:path";
import { inRoot, root } from "./paths.mjs";

/** A failure that its message explains completely; no stack trace is printed. */
export class Failure extends Error {
  /** The output of the program that failed. */
  output = "";
}

/** Returns the first program of that name on PATH, or undefined. */
export function which(name, path = searchPath()) {
  for (const folder of path.split(delimiter)) {
    const file = join(folder, name);
    try {
      accessSync(file, constants.X_OK);
      return file;
    } catch {}
  }
  return undefined;
}

// The npm packages' programs come first: wasm-opt must be binaryen's from npm
// (Debian's old one exits 0 and corrupts the module). rustup's folder comes
// last, for shells that have not read its environment file.
function searchPath(first = []) {
  return [
    ...first,
    inRoot("node_modules", ".bin"),
    process.env.PATH ?? "",
    join(process.env.CARGO_HOME || join(homedir(), ".cargo"), "bin"),
  ].join(delimiter);
}

/** Returns the environment for programs run from here: the process's own, changed by `variables`. */
export function environment({ path = [], ...variables } = {}) {
  return { ...process.env, ...variables, PATH: searchPath(path) };
}

/** Variables by which cargo shows how many crates are left, where a person watches; else it prints each. */
export const cargoProgress = () =>
  process.stderr.isTTY
    ? { CARGO_TERM_PROGRESS_WHEN: "always", CARGO_TERM_PROGRESS_WIDTH: "80" }
    : {};

/** Returns the output of a short program, or undefined if it fails or is missing. */
export function ask(program, args, options = {}) {
  const done = spawnSync(program, args, {
    cwd: root,
    env: environment(),
    encoding: "utf8",
    stdio: ["ignore", "pipe", "ignore"],
    ...options,
  });
  return done.status === 0 ? done.stdout : undefined;
}

const beside = new AsyncLocalStorage();

/**
 * Runs `work` with its output held back, so that it does not mix with that of other work, and
 * shows all of it when the work is done.
 */
export async function heldBack(work) {
  const held = [];
  try {
    return await beside.run(held, work);
  } finally {
    for (const text of held) process.stdout.write(text);
  }
}

/** The function by which the work that calls this shows text on a stream, or holds it back. */
function shower() {
  const held = beside.getStore();
  return (text, stream) => (held === undefined ? stream.write(text) : held.push(text));
}

/** Shows a line. */
export const say = (line) => shower()(`${line}\n`, process.stdout);

const running = new Set();

function endAll(signal) {
  for (const child of running) {
    try {
      process.kill(-child.pid, signal);
    } catch {}
  }
}
for (const [signal, status] of [
  ["SIGINT", 130],
  ["SIGTERM", 143],
  ["SIGHUP", 129],
]) {
  process.on(signal, () => {
    endAll("SIGTERM");
    process.exit(status);
  });
}

/**
 * The minutes without any output after which a program is taken to hang: a slow machine is not ended,
 * as compilers and tests print a line for each crate and test.
 */
const SILENT_MINUTES = 30;

/**
 * Runs a program, shows its output, and resolves to `{ ok, output, why }`. Each
 * program has its own process group, so that one that hangs ends together with
 * everything that it started.
 */
export function run(program, args, { env = environment(), cwd = root } = {}) {
  return new Promise((resolve) => {
    const child = spawn(program, args, {
      cwd,
      env,
      detached: true,
      stdio: ["ignore", "pipe", "pipe"],
    });
    running.add(child);
    const show = shower();
    let output = "";
    let why;
    for (const [from, to] of [
      [child.stdout, process.stdout],
      [child.stderr, process.stderr],
    ]) {
      from.setEncoding("utf8");
      from.on("data", (text) => {
        output += text;
        limit.refresh();
        show(text, to);
      });
    }
    const limit = setTimeout(() => {
      why = `stopped after ${SILENT_MINUTES} minutes without output`;
      process.kill(-child.pid, "SIGKILL");
    }, SILENT_MINUTES * 60_000);
    const end = (reason) => {
      clearTimeout(limit);
      running.delete(child);
      resolve({ ok: reason === undefined, output, why: reason });
    };
    child.on("error", (error) => end(`${program}: ${error.message}`));
    child.on("close", (status, signal) =>
      end(why ?? (status === 0 ? undefined : `${program} ended with ${signal ?? status}`)),
    );
  });
}

/** Runs a program, returns its output, and throws a `Failure` if it failed. */
export async function must(program, args, options) {
  const { ok, output, why } = await run(program, args, options);
  if (!ok) throw Object.assign(new Failure(why), { output });
  return output;
}
