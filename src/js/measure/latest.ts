/**
 * Keeps one computation running: a new one cancels the one in progress. For models that change while
 * they are measured, where only the newest request counts.
 */
export class Latest {
  #abort = new AbortController();

  /**
   * Runs `work` with a signal that a newer `run`, `cancel` or `drop` aborts. Resolves to its result,
   * or to `undefined` if a newer one took its place or it was dropped; rejects as `work` does.
   */
  async run<Result>(work: (signal: AbortSignal) => Promise<Result>): Promise<Result | undefined> {
    this.drop();
    const abort = this.#abort;
    try {
      const result = await work(abort.signal);
      return this.#abort === abort ? result : undefined;
    } catch (error) {
      if (this.#abort === abort) throw error;
      return undefined;
    }
  }

  /** Cancels the one in progress, which then rejects with `CANCELLED`, or resolves as its method states. */
  cancel(): void {
    this.#abort.abort();
  }

  /** Cancels the one in progress, which then resolves to `undefined`. */
  drop(): void {
    this.#abort.abort();
    this.#abort = new AbortController();
  }
}
