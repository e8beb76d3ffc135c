import type { CadReport } from "../../cad/report.js";
import type { Invocation } from "../arguments/arguments.js";
import { convertFile, writeText } from "../files.js";
import { full } from "../output/numbers.js";
import { print, printJson } from "../output/output.js";

/** Writes a model as interchange JSON, and prints the report on reading it. */
export async function convert(values: Invocation["values"]): Promise<void> {
  const { json, report } = await convertFile(String(values.get("input")));
  await writeText(String(values.get("output")), json);
  if (values.has("json")) printJson(report);
  else print(text(report));
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
