//! The report as lines for people.

use super::Rows;
use std::fmt::Write;

/// Returns a line for each pair, with its findings below it, and the counts.
pub(super) fn report(rows: &Rows) -> String {
    let mut text = String::new();
    for row in &rows.rows {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{:<10} {}: {}", row.word(), row.path, row.summary());
        for finding in row.findings() {
            let _ = writeln!(text, "           {finding}");
        }
    }
    let _ = writeln!(text, "files      {}", rows.counts());
    text
}
