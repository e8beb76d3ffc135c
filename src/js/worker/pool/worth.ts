/**
 * Whether it is worth it to send a model to other workers: as soon as what is left of a call would take longer, at the
 * rate so far, than the model took to be made, as it has to be made there once more.
 * @internal
 */
export class Worth {
  readonly #milliseconds: number;
  /** The first report, before which the model may have been prepared. */
  #first: { time: number; fraction: number } | undefined;
  #resolve: () => void = () => {};
  /** Resolves when it is. */
  readonly known: Promise<void>;

  constructor(milliseconds: number) {
    this.#milliseconds = milliseconds;
    this.known = new Promise((resolve) => {
      this.#resolve = resolve;
    });
  }

  /** Takes the fraction of the call that is done. */
  report(fraction: number): void {
    const time = performance.now();
    const first = this.#first;
    if (first === undefined) {
      this.#first = { time, fraction };
      return;
    }
    const left = ((time - first.time) / (fraction - first.fraction)) * (1 - fraction);
    if (left > this.#milliseconds) this.#resolve();
  }
}
