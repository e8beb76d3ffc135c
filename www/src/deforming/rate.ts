// The rate of results over the last second.

/** The seconds over which results are counted. */
const SPAN = 1;

export class Rate {
  #times: number[] = [];
  #total = 0;

  /** Counts a result at a time in seconds, later than the last. */
  add(time: number): void {
    this.#total += 1;
    this.#times.push(time);
    const first = this.#times.findIndex((at) => at >= time - SPAN);
    this.#times.splice(0, first);
  }

  get total(): number {
    return this.#total;
  }

  /** Results a second; 0 before the second result. */
  get perSecond(): number {
    const [first, last] = [this.#times.at(0) ?? 0, this.#times.at(-1) ?? 0];
    return last > first ? (this.#times.length - 1) / (last - first) : 0;
  }

  clear(): void {
    this.#times = [];
    this.#total = 0;
  }
}
