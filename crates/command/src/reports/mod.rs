//! The report on a pair of files or of directories, in the formats that people and CI services read.

mod answer;
mod details;
mod figures;
mod histogram;
mod html;
mod junit;
mod markdown;
mod rows;
mod text;

pub(crate) use answer::{Answer, Verdict};
pub(crate) use details::NO_PICTURES;
pub(crate) use figures::{clash_figures, figures};
pub(crate) use rows::{Outcome, Row, Rows};

use crate::failure::Failure;
use crate::output::{json::print_json, print};
use clap::ValueEnum;

/// The form of the output.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// Lines for people.
    Text,
    /// One JSON object.
    Json,
    /// XML that CI services show as tests, a pair each.
    Junit,
    /// A table that forges show in comments and summaries.
    Markdown,
    /// A page for browsers.
    Html,
}

impl Format {
    /// Whether a pair that fails is a row of the output rather than the end of the program.
    pub(crate) fn is_report(self) -> bool {
        matches!(self, Self::Junit | Self::Markdown | Self::Html)
    }
}

/// Prints the report and returns the exit status.
///
/// # Errors
/// [`Failure::Output`].
pub(crate) fn print_report(rows: &Rows, format: Format) -> Result<u8, Failure> {
    match format {
        Format::Json => print_json(rows)?,
        Format::Text => print(&text::report(rows))?,
        Format::Junit => print(&junit::report(rows)?)?,
        Format::Markdown => print(&markdown::report(rows))?,
        Format::Html => print(&html::report(rows))?,
    }
    Ok(rows.verdict.status())
}
