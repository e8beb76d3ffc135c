#!/usr/bin/env node
// The command: the native program of this platform, started with the reader of 3DM files, which is
// JavaScript's.
import { spawn } from "node:child_process";
import { fileURLToPath } from "node:url";
import { advice, program } from "./platform.js";

/** Exit status without an answer, as of the program. */
const FAILED = 2;

const SIGNALS = ["SIGINT", "SIGTERM", "SIGHUP"] as const;

function fail(message: string): void {
  process.stderr.write(`error[PLATFORM_UNSUPPORTED]: ${message}\n`);
  process.exitCode = FAILED;
}

/** Runs the program with the arguments of this process, and ends as it does. */
function run(path: string): void {
  const rhino = fileURLToPath(new URL("rhino.js", import.meta.url));
  const env = {
    ...process.env,
    NURBS_HAUSDORFF_3DM: JSON.stringify([process.execPath, rhino]),
  };
  const child = spawn(path, process.argv.slice(2), { stdio: "inherit", env });
  // The program decides what a signal means: `batch` ends after the line that it writes.
  const forward = (signal: NodeJS.Signals) => child.kill(signal);
  for (const signal of SIGNALS) process.on(signal, forward);
  child.on("error", ({ message }) => fail(`${message}; ${advice}`));
  child.on("exit", (status, signal) => {
    for (const signal of SIGNALS) process.off(signal, forward);
    if (signal === null) process.exitCode = status ?? FAILED;
    else process.kill(process.pid, signal);
  });
}

const path = program();
if (path === undefined) {
  fail(`there is no program for ${process.platform}-${process.arch} here; ${advice}`);
} else {
  run(path);
}
