/**
 * The type of `onProgress`. `stalled` is true while a search by method
 * `certified` gains nothing: its interval has not halved over ten times the
 * cells that it took to the last halving, so that it may take much longer than
 * so far, and a budget or the signal may have to end it.
 */
export type OnProgress = (
  fraction: number,
  interval?: [lower: number, upper: number],
  stalled?: boolean,
) => void;
