import { readFile, writeFile } from "node:fs/promises";
import { convertCad, readCad } from "../cad/read.js";
import type { CadReport } from "../cad/report.js";
import { HausdorffError } from "../error.js";
import type { NurbsModel } from "../model/model.js";

/** An error in a model's file, with the file's path. */
export class FileError extends Error {
  readonly code: string;

  constructor(path: string, error: HausdorffError) {
    super(`${path}: ${error.message}`, { cause: error });
    this.code = error.code;
  }
}

/** The model in a file; the faces left out are listed on standard error. */
export async function readModel(path: string): Promise<NurbsModel> {
  return naming(path, async () => {
    const model = await readCad(await bytesOf(path), { name: path });
    warn(path, model.report);
    return model;
  });
}

/** The interchange JSON of the model in a file, and the report on reading it. */
export async function convertFile(path: string): Promise<{ json: string; report: CadReport }> {
  return naming(path, async () => {
    const converted = await convertCad(await bytesOf(path), { name: path });
    warn(path, converted.report);
    return converted;
  });
}

/** A result with the faces that were left out of the files' models, if any. */
export function ofFiles<R extends object>(result: R, a: NurbsModel, b: NurbsModel): object {
  const [leftOfA, leftOfB] = [a, b].map(({ report }) => report?.skipped ?? []);
  const none = !leftOfA?.length && !leftOfB?.length;
  return none ? result : { ...result, skipped: { a: leftOfA, b: leftOfB } };
}

/**
 * Whether a verdict holds for the files: no faces were left out of their models, or that is
 * allowed. Says on standard error why it does not.
 */
export function isJudged(a: NurbsModel, b: NurbsModel, allowSkipped: boolean): boolean {
  const skipped = [a, b].reduce((sum, { report }) => sum + (report?.skipped.length ?? 0), 0);
  if (allowSkipped || skipped === 0) return true;
  process.stderr.write(
    `undecided: ${skipped} faces were left out; --allow-skipped judges the others\n`,
  );
  return false;
}

/** Writes a text to a file. */
export async function writeText(path: string, text: string): Promise<void> {
  await writeFile(path, text).catch((cause: unknown) => {
    throw unreadable(path, cause, "OUTPUT_FAILED");
  });
}

async function naming<T>(path: string, run: () => Promise<T>): Promise<T> {
  try {
    return await run();
  } catch (error) {
    if (error instanceof HausdorffError) throw new FileError(path, error);
    throw error;
  }
}

async function bytesOf(path: string): Promise<Uint8Array> {
  return readFile(path).catch((cause: unknown) => {
    throw unreadable(path, cause, "FILE_UNREADABLE");
  });
}

/** An error of the operating system, which names the path itself. */
class SystemError extends Error {
  readonly code: string;

  constructor(code: string, path: string, cause: unknown) {
    super(`${path}: ${cause instanceof Error ? cause.message : String(cause)}`, { cause });
    this.code = code;
  }
}

function unreadable(path: string, cause: unknown, code: string): SystemError {
  return new SystemError(code, path, cause);
}

function warn(path: string, report: CadReport | null): void {
  for (const { face, entity, why } of report?.skipped ?? []) {
    const number = entity === undefined ? "" : ` (#${entity})`;
    process.stderr.write(`warning: ${path}: ${face}${number} is left out: ${why}\n`);
  }
  for (const { face, why } of report?.notes ?? []) {
    process.stderr.write(`note: ${path}: ${face}: ${why}\n`);
  }
}
