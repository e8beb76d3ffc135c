import { ofVersion, printJson } from "../output/json.js";
import { print } from "../output/output.js";
import { html } from "./html.js";
import { junit } from "./junit.js";
import { markdown } from "./markdown.js";
import { jsonOf, type Rows, statusOfAll } from "./rows.js";
import { text } from "./text.js";

/** The form of the output. */
export type Format = "text" | "json" | "junit" | "markdown" | "html";

/** Whether a pair that fails is a row of the output rather than the end of the program. */
export const isReport = (format: Format): boolean => format !== "text" && format !== "json";

/** Prints the report and returns the exit status. */
export function printReport(rows: Rows, format: Format): number {
  if (format === "json") printJson(ofVersion(jsonOf(rows)));
  else print({ text, junit, markdown, html }[format](rows));
  return statusOfAll(rows);
}
