import { escapeMarkdown, escapeXml } from "./escape.js";
import { counts, findingsOf, type Row, type Rows, summaryOf, wordOf } from "./rows.js";

/** A title with the counts, a table of the pairs, and the findings of each, folded: as forges show it. */
export function markdown(rows: Rows): string {
  const lines = rows.rows.map((row) => {
    const [path, summary] = [row.path, summaryOf(row)].map(escapeMarkdown);
    return `| ${path} | **${wordOf(row)}** | ${summary} |\n`;
  });
  const title = `### nurbs-hausdorff ${rows.command}: ${counts(rows)}\n`;
  const head = "\n| file | result | |\n|---|---|---|\n";
  return [title, head, ...lines, ...rows.rows.map(findings)].join("");
}

function findings(row: Row): string {
  const found = findingsOf(row);
  if (found.length === 0) return "";
  const lines = found.map((finding) => `- ${escapeMarkdown(finding)}\n`).join("");
  return `\n<details><summary>${escapeXml(row.path)}</summary>\n\n${lines}\n</details>\n`;
}
