import { HausdorffError } from "../error.js";
import { requireWhole } from "../measure/cancelled.js";
import type { EngineFacts, Failure, Listener, Port, Reply } from "./messages.js";

/** What a call passes on besides its arguments. */
export interface CallOptions {
  signal?: AbortSignal | undefined;
  /** Called with what the worker's method reports. */
  onProgress?: ((...progress: never[]) => void) | undefined;
  /** Buffers that are transferred, not copied. */
  transfer?: ArrayBuffer[];
  /**
   * Whether the result is a model, which the worker cannot stop making at any moment: an aborted
   * signal then rejects at once, and the worker drops what it makes.
   */
  makesModel?: boolean;
}

interface Pending extends CallOptions {
  resolve(result: unknown): void;
  reject(error: unknown): void;
  cancel(): void;
}

/**
 * The calls that a worker has yet to answer.
 * @internal
 */
export class Channel {
  readonly #port: Port;
  readonly #pending = new Map<number, Pending>();
  #calls = 0;
  #closed = false;
  #failure: string | undefined;
  /** What the last reply said of the engine. */
  engine: EngineFacts | undefined;

  constructor(connect: (listener: Listener<Reply>) => Port) {
    this.#port = connect({
      message: (reply) => this.#take(reply),
      failed: (why) => this.#fail(why),
    });
  }

  /** Calls a method of the worker; resolves to its result and the call's number. */
  async call(
    method: string,
    args: unknown[],
    options: CallOptions = {},
  ): Promise<[unknown, number]> {
    this.requireOpen();
    const { signal, onProgress, transfer = [] } = options;
    if (signal?.aborted) throw failed({ code: "CANCELLED", message: "cancelled" }, signal);
    this.#calls += 1;
    const id = this.#calls;
    const cancel = () => {
      this.#port.post({ cancel: id }, []);
      if (options.makesModel !== true) return;
      this.drop(id);
      this.#pending.get(id)?.reject(failed({ code: "CANCELLED", message: "cancelled" }, signal));
    };
    const answer = new Promise<unknown>((resolve, reject) => {
      this.#pending.set(id, { ...options, resolve, reject, cancel });
    });
    try {
      this.#port.post({ id, method, args, progress: onProgress !== undefined }, transfer);
      this.#port.hold(true);
      signal?.addEventListener("abort", cancel);
      return [requireWhole(await answer, signal), id];
    } catch (error) {
      if (error instanceof DOMException && error.name === "DataCloneError") {
        throw new HausdorffError("ARGUMENT_INVALID", `${method}: ${error.message}`, {
          cause: error,
        });
      }
      throw error;
    } finally {
      signal?.removeEventListener("abort", cancel);
      this.#pending.delete(id);
      if (this.#pending.size === 0) this.#rest();
    }
  }

  /** Frees a model of the worker. */
  drop(id: number): void {
    if (!this.#closed) this.#port.post({ drop: id }, []);
  }

  /** Ends the worker when all calls are answered. */
  close(): void {
    this.#closed = true;
    if (this.#pending.size === 0) this.#rest();
  }

  requireOpen(): void {
    if (this.#failure !== undefined)
      throw failed({ code: "WORKER_FAILED", message: this.#failure });
    if (this.#closed) throw new HausdorffError("DISPOSED", "the Hausdorff object was disposed of");
  }

  #rest(): void {
    if (this.#closed) this.#port.close();
    else this.#port.hold(false);
  }

  #take(reply: Reply): void {
    const pending = this.#pending.get(reply.id);
    if (pending === undefined) return;
    if ("progress" in reply) {
      try {
        pending.onProgress?.(...(reply.progress as never[]));
      } catch (thrown) {
        pending.cancel();
        pending.reject(thrown);
      }
    } else if ("failure" in reply) {
      pending.reject(failed(reply.failure, pending.signal));
    } else {
      this.engine = reply.engine ?? this.engine;
      pending.resolve(reply.result);
    }
  }

  #fail(why: string): void {
    this.#failure = why;
    for (const { reject } of this.#pending.values()) {
      reject(failed({ code: "WORKER_FAILED", message: why }));
    }
  }
}

function failed({ code, message, interval }: Failure, signal?: AbortSignal): Error {
  if (code === undefined) return new Error(message);
  const cause = code === "CANCELLED" && signal?.aborted ? { cause: signal.reason } : {};
  return new HausdorffError(code, message, { ...cause, interval });
}
