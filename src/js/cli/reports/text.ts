import { counts, findingsOf, type Rows, summaryOf, wordOf } from "./rows.js";

/** A line for each pair, with its findings below it, and the counts. */
export function text(rows: Rows): string {
  const lines = rows.rows.flatMap((row) => [
    `${wordOf(row).padEnd(10)} ${row.path}: ${summaryOf(row)}`,
    ...findingsOf(row).map((finding) => `           ${finding}`),
  ]);
  return [...lines, `files      ${counts(rows)}`, ""].join("\n");
}
