import type { CadReport } from "../../cad/report.js";
import type { Invocation } from "../arguments/arguments.js";
import { convertFile, STANDARD_STREAM, writeText } from "../files.js";
import { line, ofFile } from "../output/json.js";
import { full } from "../output/numbers.js";
import { print } from "../output/output.js";

/**
 * Writes a model as interchange JSON, and prints the report on reading it: on standard error
 * where standard output holds the model.
 */
export async function convert(values: Invocation["values"]): Promise<void> {
  const { json, report, source } = await convertFile(String(values.get("input")));
  const output = String(values.get("output"));
  const printed = values.has("json") ? line(ofFile(report, source)) : text(report);
  if (output === STANDARD_STREAM) {
    process.stderr.write(printed);
    print(json);
    return;
  }
  await writeText(output, json, values.has("overwrite"));
  print(printed);
}

function text({ kind, faces, trims, exact, fitted, gap, unit, skipped }: CadReport): string {
  const lines = [
    `kind      ${kind}`,
    `faces     ${faces}, ${skipped.length} left out`,
    `trims     ${trims}, ${exact} exact, ${fitted} fitted`,
    `gap       ${full(gap)}`,
    `unit      ${unit === null ? "unknown" : `${full(unit)} m`}`,
  ];
  return `${lines.join("\n")}\n`;
}
