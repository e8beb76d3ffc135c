import type { OnProgress } from "../../measure/progress.js";
import { exponential } from "./numbers.js";

/** Digits after the point of the interval shown. */
const DIGITS = 6;

/** The progress on standard error, shown only on a terminal. */
export class Progress {
  readonly report: OnProgress = (fraction, interval) => {
    if (!process.stderr.isTTY) return;
    const percent = `${Math.floor(100 * fraction)}%`.padStart(4);
    const range = interval?.map((bound) => exponential(bound, DIGITS)).join(", ");
    process.stderr.write(`\r\x1b[K${percent}${range ? ` [${range}]` : ""}`);
  };

  end(): void {
    if (process.stderr.isTTY) process.stderr.write("\r\x1b[K");
  }
}
