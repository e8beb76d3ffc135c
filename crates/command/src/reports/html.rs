//! The report as a page for browsers, in one file.

use super::details::section;
use super::{Row, Rows, Verdict};
use chrono::Utc;
use quick_xml::escape::escape;
use std::fmt::Write;

/// The style of the page.
const STYLE: &str = include_str!("report.css");

/// The page up to its style.
const HEAD: &str = r#"<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<style>
"#;

/// Returns the page: the counts, a table of the pairs with their findings, and a section for a pair
/// alone, or for each that did not pass.
pub(super) fn report(rows: &Rows) -> String {
    let title = format!("nurbs-hausdorff {}: {}", rows.command, rows.counts());
    let mut text = HEAD.to_owned();
    // Writing to a string does not fail.
    let _ = write!(
        text,
        "{STYLE}</style>\n<title>{title}</title>\n<h1>{title}</h1>\n<p>{}</p>\n",
        compared(rows)
    );
    if !rows.fields.is_empty() {
        text.push_str("<dl>\n");
        for (term, of) in &rows.fields {
            let _ = writeln!(text, "<dt>{term}</dt><dd>{}</dd>", escape(of.as_str()));
        }
        text.push_str("</dl>\n");
    }
    let kind = if rows.b.is_empty() { "Bodies" } else { "File" };
    // Writing to a string does not fail.
    let _ =
        writeln!(text, "<table>\n<thead><tr><th>{kind}</th><th>Result</th><th></th></tr></thead>\n<tbody>");
    rows.rows.iter().for_each(|row| line(&mut text, row));
    text.push_str("</tbody>\n</table>\n");
    let is_alone = rows.rows.len() == 1;
    for row in rows.rows.iter().filter(|row| is_alone || row.status() != Verdict::Passed.status()) {
        section(&mut text, row);
    }
    let _ = write!(
        text,
        "<footer>Made by nurbs-hausdorff {} on {}</footer>\n</html>\n",
        env!("CARGO_PKG_VERSION"),
        Utc::now().date_naive()
    );
    text
}

/// What was compared: both sides, or the only one.
fn compared(rows: &Rows) -> String {
    match rows.b.is_empty() {
        true => escape(&rows.a).into_owned(),
        false => format!("A: {} <br>B: {}", escape(&rows.a), escape(&rows.b)),
    }
}

fn line(text: &mut String, row: &Row) {
    let (path, word, summary) = (escape(&row.path), row.word(), row.summary());
    let findings: String =
        row.findings().iter().map(|finding| format!("<li>{}</li>", escape(finding.as_str()))).collect();
    let list = if findings.is_empty() { String::new() } else { format!("<ul>{findings}</ul>") };
    // Writing to a string does not fail.
    let _ = writeln!(
        text,
        "<tr class=\"status-{}\"><td>{path}</td><td>{word}</td><td>{}{list}</td></tr>",
        row.status(),
        escape(&summary)
    );
}
