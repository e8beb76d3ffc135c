import type { CadOptions, FaceDraft } from "../cad/options.js";
import type { CadReport } from "../cad/report.js";
import type { ErrorCode } from "../error.js";
import type { DeviationMaps } from "../measure/points/maps.js";
import type { OnProgress } from "../measure/progress.js";

/** What a model's twin on the caller's thread knows of it. */
export interface ModelFacts {
  name: string | null;
  unit: number | null;
  report: CadReport | null;
  gap: number;
  gapProven: boolean;
  faceCount: number;
  /** The faces' names. */
  faceNames: (string | null)[];
  /** The faces' colours. */
  faceColors: ([number, number, number] | null)[];
  boundingBox: { min: [number, number, number]; max: [number, number, number] };
}

/** What the caller's thread knows of the engine. */
export interface EngineFacts {
  backend: "gpu" | "cpu";
  adapter: string | null;
  notice: string | null;
  /** The number of workers that run. */
  workers: number;
}

/** A call of a method; models are named by the number under which the worker keeps them. */
export interface Call {
  id: number;
  method: string;
  args: unknown[];
  /** Whether progress is reported. */
  progress?: boolean;
}

/** What the caller's thread sends. */
export type Request = Call | { cancel: number } | { drop: number };

/** An error on its way between threads. */
export interface Failure {
  code: ErrorCode | undefined;
  message: string;
  /** With `CANCELLED`: the interval reached. */
  interval?: readonly [lower: number, upper: number] | undefined;
}

/** What the worker reports of a file that it reads: a library that it loads, or a face. */
export interface ReadingReport {
  library?: Parameters<NonNullable<CadOptions["onLibrary"]>>[0];
  face?: FaceDraft;
}

/** What the worker reports of maps that it makes: coarse ones, or the progress. */
export interface MapReport {
  coarse?: DeviationMaps;
  progress?: Parameters<OnProgress>;
}

/** What the worker sends. */
export type Reply =
  | { id: number; result: unknown; engine: EngineFacts | undefined }
  | { id: number; failure: Failure }
  | { id: number; progress: unknown[] };

/** One end of the channel between the two threads. */
export interface Port {
  post(message: Request | Reply, transfer: ArrayBuffer[]): void;
  /** Whether waiting for messages keeps the process alive, where that is a question. */
  hold(held: boolean): void;
  close(): void;
}

/** Connects to a worker: the caller's, or a new one. */
export type Connect = (listener: Listener<Reply>, worker: Worker | undefined) => Port;

/** How a port delivers messages and reports its end. */
export interface Listener<Message> {
  message(message: Message): void;
  failed(why: string): void;
}
