import { HausdorffError } from "../../error.js";
import type { Argument, Command, Table } from "./table.js";
import { parseValue, type Value } from "./values.js";

/** A command with the values given to it, by the names of the table. */
export interface Invocation {
  command: Command;
  values: ReadonlyMap<string, Value>;
}

/** Requests that are answered with text: of the help of a command or of all, or of the version. */
export type Request = Invocation | { help: Command | null } | { version: true };

function invalid(message: string): HausdorffError {
  return new HausdorffError("OPTION_INVALID", message);
}

/**
 * Parses the arguments after the program's name, by the table.
 *
 * @throws {HausdorffError} `OPTION_INVALID`.
 */
export function parseArguments(table: Table, [name, ...rest]: readonly string[]): Request {
  if (name === "--version" || name === "-V") return { version: true };
  if (name === "--help" || name === "-h") return { help: null };
  const find = (name: string | undefined) => table.commands.find((one) => one.name === name);
  if (name === "help") return { help: find(rest[0]) ?? null };
  const command = find(name);
  const names = table.commands.map((one) => one.name).join(", ");
  if (name === undefined) throw invalid(`a command is required, one of ${names}`);
  if (command === undefined)
    throw invalid(`unrecognized command '${name}', expected one of ${names}`);
  return new Parser(command).parse(rest);
}

class Parser {
  readonly #command: Command;
  readonly #values = new Map<string, Value>();
  #positional = 0;

  constructor(command: Command) {
    this.#command = command;
  }

  parse(rest: readonly string[]): Request {
    const queue = [...rest];
    let onlyPositional = false;
    for (let text = queue.shift(); text !== undefined; text = queue.shift()) {
      if (onlyPositional || !text.startsWith("-") || text === "-") this.#take(text);
      else if (text === "--") onlyPositional = true;
      else if (text === "--help" || text === "-h") return { help: this.#command };
      else this.#option(text, queue);
    }
    const missing = this.#command.arguments.filter(
      ({ name, required }) => required && !this.#values.has(name),
    );
    if (missing.length > 0) {
      const names = missing.map(({ value }) => `<${value}>`).join(" ");
      throw invalid(`the following required arguments were not provided: ${names}`);
    }
    return { command: this.#command, values: this.#values };
  }

  #take(text: string): void {
    const argument = this.#command.arguments[this.#positional];
    if (argument === undefined) throw invalid(`unexpected argument '${text}' found`);
    this.#positional += 1;
    this.#set(argument, text);
  }

  #option(text: string, queue: string[]): void {
    const [, name, value] = /^--([^=]+)(?:=([\s\S]*))?$/.exec(text) ?? [];
    const argument = this.#command.options.find((option) => option.name === name);
    if (argument === undefined) throw invalid(`unexpected argument '${text}' found`);
    if (this.#values.has(argument.name)) {
      throw invalid(`the argument '--${argument.name}' cannot be used multiple times`);
    }
    if (argument.type === "flag") {
      if (value !== undefined)
        throw invalid(`unexpected value '${value}' for '--${argument.name}'`);
      this.#values.set(argument.name, true);
    } else {
      this.#set(argument, value ?? this.#next(argument, queue));
    }
  }

  #next(argument: Argument, queue: string[]): string {
    const next = queue[0];
    const takesHyphens = argument.type === "translation" || argument.type === "rotation";
    if (next === undefined || (next.startsWith("-") && !takesHyphens)) {
      throw invalid(`a value is required for '--${argument.name} <${argument.value}>'`);
    }
    queue.shift();
    return next;
  }

  #set(argument: Argument, text: string): void {
    try {
      this.#values.set(argument.name, parseValue(argument, text));
    } catch (cause) {
      const where = argument.required
        ? `<${argument.value}>`
        : `--${argument.name} <${argument.value}>`;
      const why = cause instanceof Error ? cause.message : String(cause);
      throw new HausdorffError("OPTION_INVALID", `invalid value '${text}' for '${where}': ${why}`, {
        cause,
      });
    }
  }
}
