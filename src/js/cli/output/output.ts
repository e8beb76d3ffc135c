import { writeSync } from "node:fs";

const STANDARD_OUTPUT = 1;

/** Writes text to standard output, in whole, and returns whether there is a reader: it is no failure if it has gone. */
export function print(text: string): boolean {
  let rest = Buffer.from(text);
  while (rest.length > 0) {
    try {
      rest = rest.subarray(writeSync(STANDARD_OUTPUT, rest));
    } catch (error) {
      const { code } = error as NodeJS.ErrnoException;
      if (code === "EPIPE") return false;
      // A pipe that is full is written again.
      if (code !== "EAGAIN") throw Object.assign(error as Error, { code: "OUTPUT_FAILED" });
    }
  }
  return true;
}
