import type { DistanceOptions } from "../../measure/options.js";
import type { DistanceResult } from "../../measure/result.js";
import { Hausdorff } from "../../node.js";
import type { Invocation } from "../arguments/arguments.js";
import { isJudged } from "../files.js";
import { ofFiles } from "../output/json.js";
import { full } from "../output/numbers.js";
import { Progress } from "../output/progress.js";
import { text } from "../output/report.js";
import { comparePairs } from "../pairs/pairs.js";
import type { Answer } from "../reports/answer.js";
import type { Shown, ShownModel } from "../reports/figures.js";
import { libraryOptions } from "./library-options.js";

type Values = Invocation["values"];

/** Computes and prints the distance, and returns the exit status. */
export async function distance(values: Values): Promise<number> {
  const options: DistanceOptions = libraryOptions(values);
  // Method certified usually ends in float64 before a GPU could be initialised.
  const staged = (options.method ?? "certified") !== "certified" || options.deviations === true;
  const backend = options.backend ?? "auto";
  using hd = await Hausdorff.create({ backend: staged || backend === "gpu" ? backend : "cpu" });
  const [allowsSkipped, isStrict] = [values.has("allow-skipped"), values.has("strict-gaps")];
  const { limit } = options;
  return await comparePairs(values, {
    command: "distance",
    options: { ...options, allowsSkipped, isStrict },
    compare: async (a, b) => {
      const progress = new Progress();
      const onProgress = progress.report;
      const result = await hd
        .distance(a.model, b.model, { ...options, onProgress })
        .finally(() => progress.end());
      const judged = limit === undefined || isJudged(a, b, allowsSkipped);
      if (!judged) forgetVerdict(result);
      const within = !judged
        ? undefined
        : isStrict
          ? result.withGaps.within
          : verdict(result, limit);
      const { prepare, compile, solve } = result.seconds;
      const answer = {
        ...(limit === undefined ? COMPUTED : judgement(within)),
        limit,
        summary: summary(result),
        findings: [],
        text: text(result),
        seconds: prepare + compile + solve,
        repeatable: result.converged || (limit !== undefined && within !== undefined),
        json: ofFiles(withoutDeviations(result), a, b),
      };
      return { answer, shown: shown(result, options) };
    },
  });
}

/** The models whose points were measured, with the farthest ones. */
function shown(result: DistanceResult, options: DistanceOptions): Shown {
  const { limit: allowed, transform } = options;
  const { forward = result, reverse } = result;
  const side = (
    { upper, witness }: DistanceResult,
    [from, to]: readonly ["a" | "b", "a" | "b"],
  ): ShownModel => {
    const { face, point } = witness[from];
    return { uppers: [upper], farthest: { face, point, foot: witness[to].point } };
  };
  return {
    ...{ allowed, transform, a: side(forward, ["a", "b"]) },
    ...(reverse === undefined ? {} : { b: side(reverse, ["b", "a"]) }),
  };
}

/** The judgement of a distance without a limit. */
const COMPUTED: Judgement = { verdict: "passed", word: "computed" };

type Judgement = Pick<Answer, "verdict" | "word">;

function judgement(within: boolean | undefined): Judgement {
  if (within === undefined) return { verdict: "undecided", word: "undecided" };
  return within ? { verdict: "passed", word: "within" } : { verdict: "failed", word: "beyond" };
}

function summary({ lower, upper, gap }: DistanceResult): string {
  const gaps = gap > 0 ? `, gap ${full(gap)}` : "";
  return `distance in [${full(lower)}, ${full(upper)}]${gaps}`;
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

/** The verdict that follows from the interval and the limit, for all methods. */
function verdict({ lower, upper }: DistanceResult, limit = Infinity): boolean | undefined {
  if (upper <= limit) return true;
  return lower > limit ? false : undefined;
}
