import type { Bounded, CertifiedStatistics, StatisticsOptions } from "../../measure/statistics.js";
import { Hausdorff } from "../../node.js";
import type { Invocation } from "../arguments/arguments.js";
import { readModel } from "../files.js";
import { ofFiles, printJson } from "../output/json.js";
import { full } from "../output/numbers.js";
import { print } from "../output/output.js";
import { Progress } from "../output/progress.js";
import { libraryOptions } from "./library-options.js";

/** Computes the statistics and prints them. */
export async function statistics(values: Invocation["values"]): Promise<void> {
  using hd = await Hausdorff.create({ backend: "cpu" });
  using a = await readModel(String(values.get("a")));
  using b = await readModel(String(values.get("b")));
  const progress = new Progress();
  const options: StatisticsOptions = { ...libraryOptions(values), onProgress: progress.report };
  const result = await hd.statistics(a.model, b.model, options).finally(() => progress.end());
  if (values.has("json")) printJson(ofFiles(result, a, b));
  else print(text(result));
}

const between = ({ lower, upper }: Bounded) => `between ${full(lower)} and ${full(upper)}`;

function text(result: CertifiedStatistics): string {
  const { beyond, seconds } = result;
  const total = result.over === "count" ? "points" : "area";
  const lines = [
    `${total.padEnd(10)} ${between(result.total)}`,
    `mean       ${between(result.mean)}`,
    `rms        ${between(result.rms)}`,
    ...result.percentiles.map(
      ({ part, distance }) =>
        `part ${String(part).padEnd(5)} within a distance ${between(distance)}`,
    ),
  ];
  if (beyond !== undefined) {
    lines.push(`beyond     ${full(beyond.limit)}: a part ${between(beyond.part)}`);
  }
  lines.push(
    `search     ${result.converged ? "converged" : "not converged"}, ${result.cells} parts`,
    `seconds    ${seconds.prepare.toFixed(3)} prepare, ${seconds.solve.toFixed(3)} solve`,
  );
  return `${lines.join("\n")}\n`;
}
