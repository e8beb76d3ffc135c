import { writeSync } from "node:fs";

const STANDARD_OUTPUT = 1;

/** Writes text to standard output, in whole; it is no failure if the reader has gone. */
export function print(text: string): void {
  let rest = Buffer.from(text);
  while (rest.length > 0) {
    try {
      rest = rest.subarray(writeSync(STANDARD_OUTPUT, rest));
    } catch (error) {
      const { code } = error as NodeJS.ErrnoException;
      if (code === "EPIPE") return;
      // A pipe that is full is written again.
      if (code !== "EAGAIN") throw Object.assign(error as Error, { code: "OUTPUT_FAILED" });
    }
  }
}
