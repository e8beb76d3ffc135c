import { statSync } from "node:fs";
import { HausdorffError } from "../../error.js";
import type { Invocation } from "../arguments/arguments.js";
import { type Input, ModelFile } from "../files.js";
import { printJson } from "../output/json.js";
import { print } from "../output/output.js";
import { type Answer, STATUSES } from "../reports/answer.js";
import { figures, type Shown } from "../reports/figures.js";
import { type Format, isReport, printReport } from "../reports/report.js";
import type { Outcome } from "../reports/rows.js";
import { Earlier } from "./earlier.js";
import { type TreePair, treePairs } from "./tree.js";

/** What a command does with a pair. */
export interface Comparison {
  command: string;
  /** Everything but the files on which the answer depends. */
  options: object;
  compare(a: Input, b: Input): Promise<{ answer: Omit<Answer, "figures">; shown: Shown }>;
}

/** The pairs of a report that have pictures: those with a section of their own. */
type Drawn = "none" | "not-passed" | "all";

/** The largest number of pairs with pictures in one report, which a pair makes some 500 KB longer. */
const MAX_DRAWN = 20;

/** The terms of what the caller states of the comparison, and the options that state it. */
const FIELDS = [
  ["Part", "part"],
  ["Operator", "operator"],
] as const;

/** Compares two files, or those of two directories, prints and returns the exit status. */
export async function comparePairs(
  values: Invocation["values"],
  comparison: Comparison,
): Promise<number> {
  const [a, b] = [String(values.get("a")), String(values.get("b"))];
  const format = formatOf(values);
  const directories = [a, b].filter(isDirectory).length;
  const draws = format !== "html" ? "none" : directories === 0 ? "all" : "not-passed";
  const comparer = new Comparer(comparison, draws, values.get("reuse") as string | undefined);
  if (directories === 1) {
    throw new HausdorffError("OPTION_INVALID", `${a} and ${b} are a directory and a file`);
  }
  if (directories === 0 && !isReport(format)) {
    const answer = await comparer.answer(a, b);
    if (format === "json") printJson(answer.json);
    else print(answer.text);
    return STATUSES[answer.verdict];
  }
  const pattern = values.get("include") as string | undefined;
  const pairs = directories === 0 ? [{ path: b, a, b }] : await treePairs(a, b, pattern);
  const rows = [];
  for (const pair of pairs) rows.push({ path: pair.path, outcome: await comparer.outcome(pair) });
  const fields = FIELDS.flatMap(([term, name]): [string, string][] =>
    values.has(name) ? [[term, String(values.get(name))]] : [],
  );
  return printReport({ command: comparison.command, a, b, rows, fields }, format);
}

function formatOf(values: Invocation["values"]): Format {
  if (values.has("json") && values.has("format")) {
    throw new HausdorffError("OPTION_INVALID", "--json cannot be used with --format");
  }
  return values.has("json") ? "json" : ((values.get("format") ?? "text") as Format);
}

const isDirectory = (path: string): boolean =>
  statSync(path, { throwIfNoEntry: false })?.isDirectory() === true;

class Comparer {
  readonly #comparison: Comparison;
  readonly #earlier: Earlier | undefined;
  readonly #draws: Drawn;
  /** The number of pairs with pictures so far. */
  #drawn = 0;

  constructor(comparison: Comparison, draws: Drawn, folder: string | undefined) {
    this.#comparison = comparison;
    this.#draws = draws;
    this.#earlier = folder === undefined ? undefined : new Earlier(folder);
  }

  async outcome({ a, b }: TreePair): Promise<Outcome> {
    if (a === undefined || b === undefined) return { only: a === undefined ? "added" : "removed" };
    try {
      return { answer: await this.answer(a, b) };
    } catch (error) {
      const { code, message } = error as { code?: unknown; message: string };
      if (typeof code !== "string") throw error;
      return { error: { code, message } };
    }
  }

  async answer(pathA: string, pathB: string): Promise<Answer> {
    const [fileA, fileB] = [await ModelFile.open(pathA), await ModelFile.open(pathB)];
    const { command, options } = this.#comparison;
    const draws = this.#drawn < MAX_DRAWN ? this.#draws : "none";
    const key = Earlier.key(command, { ...options, draws }, [fileA.source, fileB.source]);
    const earlier = this.#earlier?.find(key);
    const answer = earlier ?? (await this.#computed(fileA, fileB, draws));
    if (earlier === undefined) this.#earlier?.keep(key, answer);
    if (answer.figures !== "") this.#drawn += 1;
    return answer;
  }

  async #computed(fileA: ModelFile, fileB: ModelFile, draws: Drawn): Promise<Answer> {
    using a = await fileA.read();
    using b = await fileB.read();
    const { answer, shown } = await this.#comparison.compare(a, b);
    const isDrawn = draws === "all" || (draws === "not-passed" && answer.verdict !== "passed");
    return { ...answer, figures: isDrawn ? await figures(a, b, shown) : "" };
  }
}
