import { closeSync, ftruncateSync, openSync, readFileSync, writeSync } from "node:fs";
import type { Invocation } from "../arguments/arguments.js";
import { failed, SystemError } from "../files.js";
import { print } from "../output/output.js";

/** Writes lines in the order of their indices. */
export class Answers {
  /** The ids that an output that is gone on with answers already. */
  readonly answered: ReadonlySet<string>;
  readonly #write: (line: string) => boolean;
  readonly #close: () => void;
  readonly #waiting = new Map<number, string | undefined>();
  #next = 0;
  #unread = false;

  constructor(values: Invocation["values"]) {
    const path = values.get("output");
    this.answered = new Set();
    if (path === undefined) {
      if (values.has("resume")) {
        throw new SystemError("OPTION_INVALID", "--resume goes on with a file: --output <FILE>");
      }
      this.#write = print;
      this.#close = () => {};
      return;
    }
    const { file, answered } = opened(`${path}`, values);
    this.answered = answered;
    this.#write = (line) => writeSync(file, line) > 0;
    this.#close = () => closeSync(file);
  }

  /** Whether nobody reads the output any more. */
  get unread(): boolean {
    return this.#unread;
  }

  /** Writes a line, or none for a pair that was answered before, after those with smaller indices. */
  answer(index: number, line: string | undefined): void {
    this.#waiting.set(index, line);
    while (!this.#unread && this.#waiting.has(this.#next)) {
      const next = this.#waiting.get(this.#next);
      this.#waiting.delete(this.#next);
      this.#next += 1;
      if (next !== undefined) this.#unread = !this.#write(next);
    }
  }

  close(): void {
    this.#close();
  }
}

/** The text by which ids are compared. */
export const keyOf = (id: unknown): string => JSON.stringify(id ?? null);

/** Opens a new file, or an earlier output at the end of its last whole line. */
function opened(
  path: string,
  values: Invocation["values"],
): { file: number; answered: Set<string> } {
  const answered = new Set<string>();
  try {
    if (!values.has("resume")) {
      return { file: openSync(path, values.has("overwrite") ? "w" : "wx"), answered };
    }
    const end = wholeLines(path, answered);
    const file = openSync(path, "a");
    ftruncateSync(file, end);
    return { file, answered };
  } catch (cause) {
    if ((cause as NodeJS.ErrnoException).code !== "EEXIST") {
      throw failed("OUTPUT_FAILED", path, cause);
    }
    const why = "is there already; --overwrite replaces it";
    throw new SystemError("OUTPUT_EXISTS", `${path} ${why}`, cause);
  }
}

/** Collects the ids of the whole lines of a file, and returns the length of these in bytes. */
function wholeLines(path: string, answered: Set<string>): number {
  let bytes: Buffer;
  try {
    bytes = readFileSync(path);
  } catch (cause) {
    if ((cause as NodeJS.ErrnoException).code === "ENOENT") return 0;
    throw cause;
  }
  let end = 0;
  for (let next = bytes.indexOf("\n"); next >= 0; next = bytes.indexOf("\n", end)) {
    answered.add(idOf(bytes.toString("utf8", end, next)));
    end = next + 1;
  }
  return end;
}

/** The id that a line answers. A file with other lines is left as it is. */
function idOf(line: string): string {
  try {
    return keyOf((JSON.parse(line) as { id?: unknown } | null)?.id);
  } catch (cause) {
    throw new Error("it is no output of `batch`", { cause });
  }
}
