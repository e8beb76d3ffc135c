import type { DistanceOptions } from "../../measure/options.js";
import type { DistanceResult } from "../../measure/result.js";
import { Hausdorff } from "../../node.js";
import type { Invocation } from "../arguments/arguments.js";
import { isJudged, readModel } from "../files.js";
import { ofFiles, printJson } from "../output/json.js";
import { print } from "../output/output.js";
import { Progress } from "../output/progress.js";
import { text } from "../output/report.js";
import { libraryOptions } from "./library-options.js";

/** Exit statuses with `--limit`. */
const WITHIN = 0;
const BEYOND = 1;
const UNDECIDED = 3;

type Values = Invocation["values"];

/** Computes and prints the distance, and returns the exit status. */
export async function distance(values: Values): Promise<number> {
  const options: DistanceOptions = libraryOptions(values);
  // Method certified usually ends in float64 before a GPU could be initialised.
  const staged = (options.method ?? "certified") !== "certified" || options.deviations === true;
  const backend = options.backend ?? "auto";
  using hd = await Hausdorff.create({ backend: staged || backend === "gpu" ? backend : "cpu" });
  using a = await readModel(String(values.get("a")));
  using b = await readModel(String(values.get("b")));
  const progress = new Progress();
  const onProgress = progress.report;
  const result = await hd
    .distance(a.model, b.model, { ...options, onProgress })
    .finally(() => progress.end());
  const { limit } = options;
  const judged = limit === undefined || isJudged(a, b, values.has("allow-skipped"));
  if (!judged) forgetVerdict(result);
  if (values.has("json")) printJson(ofFiles(withoutDeviations(result), a, b));
  else print(text(result));
  if (limit === undefined) return WITHIN;
  if (!judged) return UNDECIDED;
  return values.has("strict-gaps") ? strict(result.withGaps.within) : verdict(result, limit);
}

/** The result without its samples, which the native command does not print either. */
function withoutDeviations({ deviations: _, forward, reverse, ...rest }: DistanceResult): object {
  return {
    ...rest,
    ...(forward ? { forward: withoutDeviations(forward) } : {}),
    ...(reverse ? { reverse: withoutDeviations(reverse) } : {}),
  };
}

/** Takes the verdict out of a result, and out of those of both directions. */
function forgetVerdict(result: DistanceResult): void {
  if (result.method === "certified") delete result.within;
  delete result.withGaps.within;
  for (const direction of [result.forward, result.reverse]) {
    if (direction !== undefined) forgetVerdict(direction);
  }
}

/** The exit status of a verdict that holds for every reading of the files. */
function strict(within: boolean | undefined): number {
  if (within === undefined) return UNDECIDED;
  return within ? WITHIN : BEYOND;
}

/** The exit status that follows from the interval and the limit, for all methods. */
function verdict({ lower, upper }: DistanceResult, limit: number): number {
  if (upper <= limit) return WITHIN;
  return lower > limit ? BEYOND : UNDECIDED;
}
