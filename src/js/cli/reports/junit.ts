import { STATUSES } from "./answer.js";
import { escapeXml } from "./escape.js";
import { findingsOf, type Row, type Rows, statusOf, summaryOf, wordOf } from "./rows.js";

/**
 * JUnit's XML, which CI services show as tests: one suite with a case for each pair. A pair that
 * is beyond the limit, was added or removed is a failure; one that is undecided or could not be
 * compared is an error.
 */
export function junit(rows: Rows): string {
  const count = (kind: string) => rows.rows.filter((row) => kindOf(row) === kind).length;
  const name = `nurbs-hausdorff ${rows.command}`;
  const time = rows.rows.reduce((sum, row) => sum + secondsOf(row), 0);
  const attributes = written({
    name,
    tests: rows.rows.length,
    failures: count("failure"),
    errors: count("error"),
    time: time.toFixed(3),
  });
  return [
    '<?xml version="1.0" encoding="UTF-8"?>',
    `<testsuites${attributes}>`,
    `  <testsuite${attributes}>`,
    ...rows.rows.flatMap((row) => testCase(name, row)),
    "  </testsuite>",
    "</testsuites>",
    "",
  ].join("\n");
}

function testCase(classname: string, row: Row): string[] {
  const summary = summaryOf(row);
  const kind = kindOf(row);
  const time = secondsOf(row).toFixed(3);
  const attributes = kind === undefined ? "" : written({ type: wordOf(row), message: summary });
  const element = kind ?? "system-out";
  const text = escapeXml([summary, ...findingsOf(row)].join("\n"));
  return [
    `    <testcase${written({ name: row.path, classname, time })}>`,
    `      <${element}${attributes}>${text}</${element}>`,
    "    </testcase>",
  ];
}

/** JUnit's element for what went wrong; none if nothing did. */
function kindOf(row: Row): "failure" | "error" | undefined {
  const status = statusOf(row);
  if (status === STATUSES.passed) return undefined;
  return status === STATUSES.failed ? "failure" : "error";
}

const secondsOf = ({ outcome }: Row): number => ("answer" in outcome ? outcome.answer.seconds : 0);

const written = (attributes: Readonly<Record<string, string | number>>): string =>
  Object.entries(attributes)
    .map(([name, value]) => ` ${name}="${escapeXml(String(value))}"`)
    .join("");
