// Panics of the wasm module as traps at once. Rust writes a panic's message to
// a standard error that browsers do not have, and then traps: without the
// writing nothing is lost, and messages and places need not be sent.
import { readFileSync, writeFileSync } from "node:fs";

const panic = [
  // Functions of Rust's own libraries, none of which returns, by their last name.
  /^(<?alloc|core|__rustc)\[.*::(panic\w*|rust_panic|rust_begin_unwind)(::<.*>)?$/,
  /^(<?alloc|core|__rustc)\[.*::((assert|unwrap|expect)_failed\w*|\w+_fail(_rt)?)(::<.*>)?$/,
  /^(<?alloc|core|__rustc)\[.*::(capacity_overflow|handle(_alloc)?_error)(::<.*>)?$/,
  // What writes the message, and what only messages of panics write.
  /panicking::panic_handler::/,
  /^<(core\[.*Range<usize>|char|wgpu_types::texture::format::\w+) as core.*::fmt::Debug>::fmt/,
  /StringError as core.*::fmt::Debug>::fmt$/,
  /fmt::builders::PadAdapter as /,
];

/** Makes traps of the functions that panic; the module must have their names. */
export async function trapPanics(wasmFile) {
  // Not there before the set-up, which imports this file.
  const { default: binaryen } = await import("binaryen");
  // Names are for whoever looks at the module before it is optimised.
  binaryen.setDebugInfo(true);
  const module = binaryen.readBinary(readFileSync(wasmFile));
  let trapped = 0;
  for (let index = 0; index < module.getNumFunctions(); index++) {
    const func = module.getFunctionByIndex(index);
    const { name } = binaryen.getFunctionInfo(func);
    if (!panic.some((names) => names.test(name))) continue;
    binaryen.Function.setBody(func, module.unreachable());
    trapped++;
  }
  if (trapped === 0) throw new Error("the wasm module has no function that panics");
  writeFileSync(wasmFile, module.emitBinary());
  module.dispose();
}
