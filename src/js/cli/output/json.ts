import { readFileSync } from "node:fs";
import type { CadReport } from "../../cad/report.js";
import type { Source } from "../files.js";
import { print } from "./output.js";

/**
 * The version of the names and meanings in the JSON. It rises when one is removed or
 * changes, not when one is added.
 */
const SCHEMA_VERSION = 1;

/** The package's version. */
export function version(): string {
  const path = new URL("../../../package.json", import.meta.url);
  return JSON.parse(readFileSync(path, "utf8")).version;
}

const head = () => ({ schemaVersion: SCHEMA_VERSION, version: version() });

/** What a result says of a model: its file, and the report on reading it. */
interface Origin {
  source: Source;
  model: { report: CadReport | null };
}

/** A result with the versions. */
export const ofVersion = (result: object): object => ({ ...head(), ...result });

/** A result of the files of A and B, with its origin and the faces left out of them. */
export function ofFiles(result: object, a: Origin, b: Origin): object {
  const files = { a: a.source, b: b.source };
  const [leftOfA, leftOfB] = [a, b].map(({ model }) => model.report?.skipped ?? []);
  return { ...head(), files, ...result, skipped: { a: leftOfA, b: leftOfB } };
}

/** A result of one file, with its origin. */
export function ofFile(result: object, source: Source): object {
  return { ...head(), file: source, ...result };
}

/** One JSON object on one line. */
export const line = (value: unknown): string => `${JSON.stringify(value)}\n`;

/** Writes one JSON object on one line. */
export function printJson(value: unknown): void {
  print(line(value));
}
