import { readFileSync } from "node:fs";
import { version } from "../output/json.js";
import { STATUSES } from "./answer.js";
import { details } from "./details.js";
import { escapeXml } from "./escape.js";
import { counts, findingsOf, type Row, type Rows, statusOf, summaryOf, wordOf } from "./rows.js";

/**
 * A page for browsers and print, in one file: the counts, a table of the pairs with their
 * findings, and a section for a pair alone, or for each that did not pass.
 */
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
    ...(rows.fields.length === 0 ? [] : ["<dl>", ...rows.fields.map(field), "</dl>"]),
    "<table>",
    "<thead><tr><th>File</th><th>Result</th><th></th></tr></thead>",
    "<tbody>",
    ...rows.rows.map(line),
    "</tbody>",
    "</table>",
    ...rows.rows
      .filter((row) => rows.rows.length === 1 || statusOf(row) !== STATUSES.passed)
      .flatMap(details),
    `<footer>Made by nurbs-hausdorff ${version()} on ${new Date().toISOString().slice(0, 10)}</footer>`,
    "</html>",
    "",
  ].join("\n");
}

const field = ([term, text]: [string, string]): string =>
  `<dt>${term}</dt><dd>${escapeXml(text)}</dd>`;

function line(row: Row): string {
  const [path, summary] = [row.path, summaryOf(row)].map(escapeXml);
  const items = findingsOf(row).map((finding) => `<li>${escapeXml(finding)}</li>`);
  const list = items.length === 0 ? "" : `<ul>${items.join("")}</ul>`;
  const cells = `<td>${path}</td><td>${wordOf(row)}</td><td>${summary}${list}</td>`;
  return `<tr class="status-${statusOf(row)}">${cells}</tr>`;
}
