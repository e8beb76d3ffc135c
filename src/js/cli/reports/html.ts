import { readFileSync } from "node:fs";
import { escapeXml } from "./escape.js";
import { counts, findingsOf, type Row, type Rows, statusOf, summaryOf, wordOf } from "./rows.js";

/** A page for browsers, in one file: the counts, and a table of the pairs with their findings. */
export function html(rows: Rows): string {
  const style = readFileSync(new URL("report.css", import.meta.url), "utf8");
  const title = `nurbs-hausdorff ${rows.command}: ${counts(rows)}`;
  return [
    "<!doctype html>",
    '<html lang="en">',
    '<meta charset="utf-8">',
    '<meta name="viewport" content="width=device-width">',
    "<style>",
    `${style}</style>`,
    `<title>${title}</title>`,
    `<h1>${title}</h1>`,
    `<p>A: ${escapeXml(rows.a)} <br>B: ${escapeXml(rows.b)}</p>`,
    "<table>",
    "<thead><tr><th>File</th><th>Result</th><th></th></tr></thead>",
    "<tbody>",
    ...rows.rows.map(line),
    "</tbody>",
    "</table>",
    "</html>",
    "",
  ].join("\n");
}

function line(row: Row): string {
  const [path, summary] = [row.path, summaryOf(row)].map(escapeXml);
  const items = findingsOf(row).map((finding) => `<li>${escapeXml(finding)}</li>`);
  const list = items.length === 0 ? "" : `<ul>${items.join("")}</ul>`;
  const cells = `<td>${path}</td><td>${wordOf(row)}</td><td>${summary}${list}</td>`;
  return `<tr class="status-${statusOf(row)}">${cells}</tr>`;
}
