import { type Answer, FAILED, STATUSES } from "./answer.js";

/** The end of the comparison of a pair, or that a file is in B or in A alone. */
export type Outcome =
  | { answer: Answer }
  | { error: { code: string; message: string } }
  | { only: "added" | "removed" };

/** A pair of files, or a file without a partner. */
export interface Row {
  /** The path relative to both directories, with `/` between its parts; or the path of B. */
  path: string;
  outcome: Outcome;
}

/** All pairs of a call. */
export interface Rows {
  /** The command that compared them. */
  command: string;
  /** What was compared, and with what, as given. */
  a: string;
  b: string;
  rows: Row[];
  /** What the caller states of the comparison, for people: terms with their texts. */
  fields: [term: string, text: string][];
}

/** The outcome in a word. */
export function wordOf({ outcome }: Row): string {
  if ("answer" in outcome) return outcome.answer.word;
  return "only" in outcome ? outcome.only : "error";
}

/** The outcome in a line. */
export function summaryOf({ outcome }: Row): string {
  if ("answer" in outcome) return outcome.answer.summary;
  if ("error" in outcome) return `${outcome.error.code}: ${outcome.error.message}`;
  return `the file is in ${outcome.only === "added" ? "B" : "A"} alone`;
}

/** The lines on places. */
export const findingsOf = ({ outcome }: Row): string[] =>
  "answer" in outcome ? outcome.answer.findings : [];

/** The exit status of this pair alone. */
export function statusOf({ outcome }: Row): number {
  if ("answer" in outcome) return STATUSES[outcome.answer.verdict];
  return "error" in outcome ? FAILED : STATUSES.failed;
}

/**
 * The exit status: of a pair that failed, else of one that is beyond the limit, was added or
 * removed, else of one that is undecided.
 */
export function statusOfAll({ rows }: Rows): number {
  const statuses = new Set(rows.map(statusOf));
  const order = [FAILED, STATUSES.failed, STATUSES.undecided];
  return order.find((status) => statuses.has(status)) ?? STATUSES.passed;
}

/** The words of all rows with their numbers, in the order of their first row: `3 unchanged, 1 added`. */
export function counts({ rows }: Rows): string {
  const counts = new Map<string, number>();
  for (const word of rows.map(wordOf)) counts.set(word, (counts.get(word) ?? 0) + 1);
  return [...counts].map(([word, count]) => `${count} ${word}`).join(", ");
}

/** What `--format json` prints of two directories. */
export function jsonOf({ command, a, b, rows }: Rows): object {
  const pairs = rows.map((row) => {
    const { outcome, path } = row;
    const result = "answer" in outcome ? { result: outcome.answer.json } : {};
    const error = "error" in outcome ? { error: outcome.error } : {};
    return { path, state: wordOf(row), ...result, ...error };
  });
  return { command, a, b, pairs };
}
