#!/usr/bin/env node
// The command line in Node: as the native one, for CAD files too.
import { HausdorffError } from "../error.js";
// Finds the wasm modules beside the package's own files.
import "../node.js";
import { type Invocation, parseArguments } from "./arguments/arguments.js";
import { help } from "./arguments/help.js";
import { table } from "./arguments/table.js";
import { batch } from "./batch/batch.js";
import { clearance } from "./commands/clearance.js";
import { convert } from "./commands/convert.js";
import { diff } from "./commands/diff.js";
import { distance } from "./commands/distance.js";
import { info } from "./commands/info.js";
import { statistics } from "./commands/statistics.js";
import { version } from "./output/json.js";
import { print } from "./output/output.js";
import { delayTiering } from "./tiering.js";

/** Exit status of bad arguments, bad input or a failed machine. */
const FAILED = 2;

async function run({ command, values }: Invocation): Promise<number> {
  if (command.name === "distance") return distance(values);
  if (command.name === "diff") return diff(values);
  if (command.name === "clearance") return clearance(values);
  if (command.name === "batch") return batch(values);
  if (command.name === "completions") {
    const native = "completions are printed by the native command, cargo install nurbs-hausdorff";
    throw new HausdorffError("OPTION_INVALID", native);
  }
  if (command.name === "statistics") await statistics(values);
  else await (command.name === "convert" ? convert(values) : info(values));
  return 0;
}

async function main(args: readonly string[]): Promise<number> {
  const commands = table();
  const request = parseArguments(commands, args);
  if ("help" in request) print(help(commands, request.help));
  else if ("version" in request) print(`nurbs-hausdorff ${version()}\n`);
  else return run(request);
  return 0;
}

delayTiering();
process.exitCode = await main(process.argv.slice(2)).catch((error: unknown) => {
  const { code } = error as { code?: unknown };
  if (!(error instanceof Error) || typeof code !== "string") throw error;
  process.stderr.write(`error[${code}]: ${error.message}\n`);
  return FAILED;
});
