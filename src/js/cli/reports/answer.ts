/** How a pair was judged: within the limit or without one, beyond it, or neither for certain. */
export type Verdict = "passed" | "failed" | "undecided";

/** The exit status of bad arguments, bad input or a failed machine. */
export const FAILED = 2;

export const STATUSES: Readonly<Record<Verdict, number>> = { passed: 0, failed: 1, undecided: 3 };

/** The answer to one pair. */
export interface Answer {
  verdict: Verdict;
  /** What the verdict is about; without it nothing was judged. */
  limit?: number | undefined;
  /** The verdict in the command's word, such as `unchanged`. */
  word: string;
  /** The answer in one line. */
  summary: string;
  /** A line for each place that matters, such as a face that changed. */
  findings: string[];
  /** The lines for people who compare one pair. */
  text: string;
  /** Seconds of preparing and searching. */
  seconds: number;
  /** Whether the same call on another machine gives the same verdict: no budget ended the search. */
  repeatable: boolean;
  /** What `--format json` prints. */
  json: object;
  /** The pictures of the page for browsers, as HTML; empty without any. */
  figures: string;
}
