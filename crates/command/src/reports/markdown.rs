//! The report as Markdown with tables, as forges show it.

use super::{Row, Rows};
use quick_xml::escape::escape;
use std::fmt::Write;

/// Returns a title with the counts, a table of the pairs, and the findings of each, folded.
pub(super) fn report(rows: &Rows) -> String {
    let mut text = format!("### nurbs-hausdorff {}: {}\n", rows.command, rows.counts());
    text.push_str("\n| file | result | |\n|---|---|---|\n");
    for row in &rows.rows {
        // Writing to a string does not fail.
        let _ =
            writeln!(text, "| {} | **{}** | {} |", escaped(&row.path), row.word(), escaped(&row.summary()));
    }
    rows.rows.iter().for_each(|row| findings(&mut text, row));
    text
}

fn findings(text: &mut String, row: &Row) {
    if row.findings().is_empty() {
        return;
    }
    // Writing to a string does not fail.
    let _ = write!(text, "\n<details><summary>{}</summary>\n\n", escape(&row.path));
    for finding in row.findings() {
        let _ = writeln!(text, "- {}", escaped(finding));
    }
    text.push_str("\n</details>\n");
}

/// Returns the text with a backslash before each character that Markdown could take for a mark.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        match character {
            '\n' | '\r' => escaped.push(' '),
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '|' | '&' | '~' | '#' => {
                escaped.extend(['\\', character]);
            }
            _ => escaped.push(character),
        }
    }
    escaped
}
