import type { ClearanceOptions, ClearanceResult } from "../../measure/clearance.js";
import type { SurfacePoint } from "../../measure/result.js";
import { Hausdorff } from "../../node.js";
import type { Invocation } from "../arguments/arguments.js";
import { isJudged, readModel } from "../files.js";
import { ofFiles, printJson } from "../output/json.js";
import { full } from "../output/numbers.js";
import { print } from "../output/output.js";
import { Progress } from "../output/progress.js";
import { GAPS_DECIDE } from "../output/report.js";
import { libraryOptions } from "./library-options.js";

/** Measures the clearance, prints it and returns the exit status. */
export async function clearance(values: Invocation["values"]): Promise<number> {
  using hd = await Hausdorff.create({ backend: "cpu" });
  using a = await readModel(String(values.get("a")));
  using b = await readModel(String(values.get("b")));
  const progress = new Progress();
  const options: ClearanceOptions = { ...libraryOptions(values), onProgress: progress.report };
  const result = await hd.clearance(a.model, b.model, options).finally(() => progress.end());
  const { limit } = options;
  if (limit !== undefined && !isJudged(a, b, values.has("allow-skipped"))) {
    delete result.atLeast;
    delete result.withGaps.atLeast;
  }
  if (values.has("json")) printJson(ofFiles(result, a, b));
  else print(text(result, limit));
  if (limit === undefined) return 0;
  return status((values.has("strict-gaps") ? result.withGaps : result).atLeast);
}

function status(atLeast: boolean | undefined): number {
  if (atLeast === undefined) return 3;
  return atLeast ? 0 : 1;
}

function text(result: ClearanceResult, limit: number | undefined): string {
  const lines = [`clearance  between ${full(result.lower)} and ${full(result.upper)}`];
  if (limit !== undefined) {
    const verdicts = ["at least", "less than", "", "undecided at"];
    const doubt = result.withGaps.atLeast === result.atLeast ? "" : GAPS_DECIDE;
    lines.push(`verdict    ${verdicts[status(result.atLeast)]} ${full(limit)}${doubt}`);
  }
  const { prepare, solve } = result.seconds;
  lines.push(
    nearest("A", result.witness.a),
    nearest("B", result.witness.b),
    `overlap    ${overlap(result)}`,
    `search     ${result.converged ? "converged" : "not converged"}, ${result.cells} pairs of cells`,
    `seconds    ${prepare.toFixed(3)} prepare, ${solve.toFixed(3)} solve`,
  );
  return `${lines.join("\n")}\n`;
}

function nearest(name: string, { face, u, v, point }: SurfacePoint): string {
  const place = point.map(full).join(" ");
  return `nearest    ${name} face ${face} at u ${full(u)} v ${full(v)}: ${place}`;
}

function overlap({ overlap: found }: ClearanceResult): string {
  if (found === undefined) return "unknown";
  if (!("insideBoth" in found)) return found.kind;
  return `${found.kind}, both have ${found.insideBoth.map(full).join(" ")} inside`;
}
