import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, renameSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { failed, type Source } from "../files.js";
import { line, version } from "../output/json.js";
import type { Answer } from "../reports/answer.js";

/** Answers of earlier calls, found by the content of both files: a folder with a file each. */
export class Earlier {
  readonly #folder: string;

  constructor(folder: string) {
    this.#folder = folder;
    try {
      mkdirSync(folder, { recursive: true });
    } catch (cause) {
      throw failed("OUTPUT_FAILED", folder, cause);
    }
  }

  /** The name of an answer: a hash of the version, the command, its options, and both files. */
  static key(command: string, options: object, files: readonly Source[]): string {
    const text = JSON.stringify(["node", version(), command, options, files]);
    return createHash("sha256").update(text).digest("hex");
  }

  /** The answer of this name; none if there is none that can be read. */
  find(key: string): Answer | undefined {
    try {
      return JSON.parse(readFileSync(this.#path(key), "utf8")) as Answer;
    } catch {
      return undefined;
    }
  }

  /**
   * Keeps an answer that does not depend on the speed of the machine. A file of another name is
   * renamed, so that no reader sees half of one.
   */
  keep(key: string, answer: Answer): void {
    if (!answer.repeatable) return;
    const unfinished = join(this.#folder, `${key}.${process.pid}`);
    try {
      writeFileSync(unfinished, line(answer));
      renameSync(unfinished, this.#path(key));
    } catch (cause) {
      throw failed("OUTPUT_FAILED", this.#path(key), cause);
    }
  }

  readonly #path = (key: string): string => join(this.#folder, `${key}.json`);
}
