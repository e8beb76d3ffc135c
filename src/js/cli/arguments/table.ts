import { readFileSync } from "node:fs";

/** The type of an argument's value. */
export type ArgumentType =
  | "flag"
  | "number"
  | "integer"
  | "path"
  | "text"
  | "translation"
  | "rotation"
  | "choice";

/** An argument as the native command defines it. */
export interface Argument {
  name: string;
  type: ArgumentType;
  help: string | null;
  required?: boolean;
  /** The value's name in the help. */
  value?: string;
  choices?: string[];
  default?: string;
}

export interface Command {
  name: string;
  about: string | null;
  longAbout: string | null;
  arguments: Argument[];
  options: Argument[];
}

export interface Table {
  about: string;
  commands: Command[];
}

/**
 * The commands and options. The file is written from the native command's
 * definition, and a test there holds them against each other.
 */
export function table(): Table {
  return JSON.parse(readFileSync(new URL("../options.json", import.meta.url), "utf8")) as Table;
}
