import { createReadStream } from "node:fs";
import { availableParallelism } from "node:os";
import { createInterface } from "node:readline";
import { HausdorffError } from "../../error.js";
import type { DistanceOptions } from "../../measure/options.js";
import { Hausdorff } from "../../worker/node.js";
import type { Invocation } from "../arguments/arguments.js";
import { STANDARD_STREAM, failed as unreadable } from "../files.js";
import { line, ofFiles } from "../output/json.js";
import { Answers, keyOf } from "./answers.js";
import { Cache } from "./cache.js";

/** Exit statuses: all pairs have a result; a pair has an error; ended by SIGINT, as shells count it. */
const ANSWERED = 0;
const FAILED = 1;
const INTERRUPTED = 130;

/** A line of the input: two files, a command and its options. */
interface Request {
  id: unknown;
  a: string;
  b: string;
  command?: "distance" | "diff" | "clearance";
  [option: string]: unknown;
}

/** Many pairs: lines of JSON in, lines of JSON out in their order. Every job has a worker. */
export async function batch(values: Invocation["values"]): Promise<number> {
  const answers = new Answers(values);
  const interrupt = new AbortController();
  process.once("SIGINT", () => interrupt.abort());
  const lines = numbered(String(values.get("pairs")), interrupt.signal);
  const jobs = Math.max(1, Number(values.get("jobs") ?? availableParallelism()));
  const run = new Run(answers, interrupt, lines, values);
  await Promise.all(Array.from({ length: jobs }, () => run.work()));
  answers.close();
  if (interrupt.signal.aborted && !answers.unread) return INTERRUPTED;
  return run.failures === 0 ? ANSWERED : FAILED;
}

type Numbered = AsyncGenerator<readonly [index: number, text: string]>;

/** The lines of a file, or of standard input, with their indices, until the signal. */
async function* numbered(path: string, signal: AbortSignal): Numbered {
  const input = path === STANDARD_STREAM ? process.stdin : createReadStream(path);
  let index = 0;
  try {
    for await (const text of createInterface({ input, signal })) yield [index++, text];
  } catch (cause) {
    throw unreadable("FILE_UNREADABLE", path, cause);
  } finally {
    // Input that stays open would keep the process.
    input.destroy();
  }
}

class Run {
  readonly #answers: Answers;
  readonly #interrupt: AbortController;
  readonly #lines: Numbered;
  readonly #values: Invocation["values"];
  failures = 0;

  constructor(
    answers: Answers,
    interrupt: AbortController,
    lines: Numbered,
    values: Invocation["values"],
  ) {
    this.#answers = answers;
    this.#interrupt = interrupt;
    this.#lines = lines;
    this.#values = values;
  }

  /** Answers lines, by a worker of its own, until there are no more. */
  async work(): Promise<void> {
    using hd = await Hausdorff.create({ backend: "auto" });
    const cache = new Cache(hd, Number(this.#values.get("cache") ?? 0));
    for (;;) {
      const next = await this.#lines.next();
      if (next.done || this.#interrupt.signal.aborted) return;
      const [index, text] = next.value;
      const answer = text.trim() === "" ? undefined : await this.#answer(hd, cache, text);
      if (this.#interrupt.signal.aborted) return;
      this.#answers.answer(index, answer);
      if (this.#answers.unread) this.#interrupt.abort();
    }
  }

  /** The line that answers a pair; none if it was answered before. */
  async #answer(hd: Hausdorff, cache: Cache, text: string): Promise<string | undefined> {
    let id: unknown = null;
    try {
      const request = parse(text);
      id = request.id ?? null;
      if (this.#answers.answered.has(keyOf(id))) return undefined;
      return line({ id, ...(await this.#compare(hd, cache, required(request))) });
    } catch (error) {
      const { code, message } = error as { code?: unknown; message: string };
      if (typeof code !== "string") throw error;
      this.failures += 1;
      return line({ id, error: { code, message } });
    }
  }

  async #compare(hd: Hausdorff, cache: Cache, request: Request): Promise<object> {
    const { id: _, a: pathA, b: pathB, command = "distance", ...options } = request;
    const given = { ...this.#budget(command, options), ...options, signal: this.#interrupt.signal };
    const [a, b] = [await cache.get(pathA), await cache.get(pathB)];
    switch (command) {
      case "distance":
        return ofFiles(withoutSamples(await hd.distance(a.model, b.model, given)), a, b);
      case "diff":
        return ofFiles(await hd.diff(a.model, b.model, given), a, b);
      case "clearance":
        return ofFiles(await hd.clearance(a.model, b.model, given), a, b);
      default:
        throw invalid(`command is ${command}, expected distance, diff or clearance`);
    }
  }

  /** The budget of a search that may have one. */
  #budget(command: string, { method = "certified" }: Partial<DistanceOptions>): object {
    const maxSeconds = this.#values.get("max-seconds");
    const has = command !== "distance" || method === "certified";
    return has && maxSeconds !== undefined ? { maxSeconds } : {};
  }
}

function parse(text: string): Partial<Request> {
  try {
    const value: unknown = JSON.parse(text);
    if (typeof value === "object" && value !== null) return value;
  } catch {
    // As what is JSON, but no object.
  }
  throw invalid("the line is no pair: expected a JSON object");
}

function required(request: Partial<Request>): Request {
  for (const name of ["id", "a", "b"] as const) {
    if (request[name] === undefined) throw invalid(`the line is no pair: ${name} is missing`);
  }
  return request as Request;
}

/** The result without the samples of its deviations, which no line holds. */
function withoutSamples<R extends { deviations?: unknown; forward?: R; reverse?: R }>(
  result: R,
): object {
  const { deviations: _, forward, reverse, ...rest } = result;
  return {
    ...rest,
    ...(forward ? { forward: withoutSamples(forward) } : {}),
    ...(reverse ? { reverse: withoutSamples(reverse) } : {}),
  };
}

const invalid = (message: string) => new HausdorffError("OPTION_INVALID", `options: ${message}`);
