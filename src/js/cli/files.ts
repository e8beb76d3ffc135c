import { createHash } from "node:crypto";
import { readFile, writeFile } from "node:fs/promises";
import { buffer } from "node:stream/consumers";
import { inflate } from "../cad/archive/inflate.js";
import { isGzip } from "../cad/kind.js";
import { type MeshFormat, meshFormatOf, readMesh } from "../cad/mesh.js";
import { convertCad, readCad } from "../cad/read.js";
import type { CadReport } from "../cad/report.js";
import { HausdorffError } from "../error.js";
import type { DistanceEngine } from "../measure/engine.js";
import type { NurbsModel } from "../model/model.js";

/** An error in a model's file, with the file's path. */
export class FileError extends Error {
  readonly code: string;

  constructor(path: string, error: HausdorffError) {
    super(`${path}: ${error.message}`, { cause: error });
    this.code = error.code;
  }
}

/** The path that stands for standard input, and for standard output. */
export const STANDARD_STREAM = "-";

/** A model's file, by which a result can be traced to it. */
export interface Source {
  /** The path as given. */
  path: string;
  /** SHA-256 of the file's bytes, in hexadecimal digits. */
  sha256: string;
}

/** What the commands need of a model, of the main class or of a worker. */
interface ReadModel {
  readonly report: CadReport | null;
  dispose(): void;
}

/** What reads models. */
export type ModelReader<Model> = Pick<DistanceEngine<Model>, "readCad" | "readMesh">;

/** A model that was read, and its file. */
export interface Input<Model extends ReadModel = NurbsModel> extends Disposable {
  model: Model;
  source: Source;
}

/** The model in a file; the faces left out are listed on standard error. */
export const readModel = (path: string): Promise<Input> =>
  readModelBy<NurbsModel>({ readCad, readMesh }, path);

/** The same by one of the classes. */
export async function readModelBy<Model extends ReadModel>(
  reader: ModelReader<Model>,
  path: string,
): Promise<Input<Model>> {
  return (await ModelFile.open(path)).readBy(reader);
}

/** A file whose bytes are read. */
export class ModelFile {
  readonly source: Source;
  readonly #bytes: Uint8Array;

  private constructor(source: Source, bytes: Uint8Array) {
    this.source = source;
    this.#bytes = bytes;
  }

  static async open(path: string): Promise<ModelFile> {
    const bytes = await bytesOf(path);
    return new ModelFile(sourceOf(path, bytes), bytes);
  }

  /** The model in the file; the faces left out are listed on standard error. */
  read(): Promise<Input> {
    return this.readBy<NurbsModel>({ readCad, readMesh });
  }

  /** The same by one of the classes. */
  readBy<Model extends ReadModel>(reader: ModelReader<Model>): Promise<Input<Model>> {
    const { path } = this.source;
    return naming(path, async () => {
      const { bytes, format } = await unpacked(path, this.#bytes);
      const model =
        format === undefined
          ? await reader.readCad(bytes, { name: path })
          : await reader.readMesh(bytes, format);
      warn(path, model.report);
      return { model, source: this.source, [Symbol.dispose]: () => model.dispose() };
    });
  }
}

/** The interchange JSON of the model in a file, and the report on reading it. */
export async function convertFile(
  path: string,
): Promise<{ json: string; report: CadReport; source: Source }> {
  return naming(path, async () => {
    const bytes = await bytesOf(path);
    const content = await unpacked(path, bytes);
    if (content.format !== undefined) {
      throw new HausdorffError(
        "FACETS_UNSUPPORTED",
        "a conversion to interchange JSON, which is not computed for this mesh or cloud of points",
      );
    }
    const converted = await convertCad(content.bytes, { name: path });
    warn(path, converted.report);
    return { ...converted, source: sourceOf(path, bytes) };
  });
}

/** What gzip may have compressed, and the format of a mesh by the name without `.gz`. */
async function unpacked(
  path: string,
  packed: Uint8Array,
): Promise<{ bytes: Uint8Array; format: MeshFormat | undefined }> {
  if (!isGzip(packed)) return { bytes: packed, format: meshFormatOf(path) };
  const bytes = await inflate(packed, "gzip");
  return { bytes, format: meshFormatOf(path.replace(/\.gz$/i, "")) };
}

function sourceOf(path: string, bytes: Uint8Array): Source {
  return { path, sha256: createHash("sha256").update(bytes).digest("hex") };
}

/**
 * Whether a verdict holds for the files: no faces were left out of their models, or that is
 * allowed. Says on standard error why it does not.
 */
export function isJudged(a: Input, b: Input, allowSkipped: boolean): boolean {
  const skipped = [a, b].reduce((sum, { model }) => sum + (model.report?.skipped.length ?? 0), 0);
  if (allowSkipped || skipped === 0) return true;
  process.stderr.write(
    `undecided: ${skipped} faces were left out; --allow-skipped judges the others\n`,
  );
  return false;
}

/** Writes a text to a file that is not there yet, or is to be replaced. */
export async function writeText(path: string, text: string, overwrite: boolean): Promise<void> {
  await writeFile(path, text, { flag: overwrite ? "w" : "wx" }).catch((cause: unknown) => {
    if ((cause as NodeJS.ErrnoException).code === "EEXIST") {
      const why = "is there already; --overwrite replaces it";
      throw new SystemError("OUTPUT_EXISTS", `${path} ${why}`, cause);
    }
    throw failed("OUTPUT_FAILED", path, cause);
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
  const reading = path === STANDARD_STREAM ? buffer(process.stdin) : readFile(path);
  return reading.catch((cause: unknown) => {
    throw failed("FILE_UNREADABLE", path, cause);
  });
}

/** An error of the operating system, whose message names the path. */
export class SystemError extends Error {
  readonly code: string;

  constructor(code: string, message: string, cause?: unknown) {
    super(message, { cause });
    this.code = code;
  }
}

export function failed(code: string, path: string, cause: unknown): SystemError {
  return new SystemError(code, `${path}: ${cause instanceof Error ? cause.message : cause}`, cause);
}

function warn(path: string, report: CadReport | null): void {
  const called = (face: number | string) => (typeof face === "number" ? `face ${face}` : face);
  for (const { face, entity, why } of report?.skipped ?? []) {
    const number = entity === undefined ? "" : ` (#${entity})`;
    process.stderr.write(`warning: ${path}: ${called(face)}${number} is left out: ${why}\n`);
  }
  for (const { face, why } of report?.notes ?? []) {
    process.stderr.write(`note: ${path}: ${called(face)}: ${why}\n`);
  }
}
