//! The arguments of the command `check`.

use crate::reports::Format;
use clap::{Args, ValueEnum};
use nurbs_hausdorff::{CheckOptions, CheckRules};
use std::path::PathBuf;

/// The form of the output of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum CheckFormat {
    /// Lines for people.
    Text,
    /// One JSON object.
    Json,
    /// XML that CI services show as tests, a pair of bodies each.
    Junit,
    /// A table that forges show in comments and summaries.
    Markdown,
    /// A page for browsers, with pictures of each clash.
    Html,
}

#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// The models, whose bodies are all compared where they are; - is standard input.
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// Lists pairs that are nearer than LENGTH.
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0)]
    below: f64,
    /// The distance up to which bodies touch, in model units, and the permitted width of intervals.
    #[arg(long, value_name = "LENGTH")]
    tolerance: Option<f64>,
    /// The same as a fraction of the diagonal of all bodies; 1e-6 if neither is given.
    #[arg(long, value_name = "FRACTION")]
    relative_tolerance: Option<f64>,
    /// Pairs of cells, for each pair of bodies, after which its interval so far is taken.
    #[arg(long, hide_short_help = true, value_name = "CELLS", default_value_t = CheckOptions::default().max_cells)]
    max_cells: usize,
    /// Seconds after which pairs that are not searched yet are bounded once only.
    #[arg(long, hide_short_help = true, value_name = "SECONDS")]
    max_seconds: Option<f64>,
    /// Scales models to the unit of the first if the files state different units; else that is an error.
    #[arg(long)]
    scale_units: bool,
    /// A file of JSON: which clashes are intended, what must touch, and what must be apart by how much.
    #[arg(long, value_name = "FILE")]
    pub(crate) rules: Option<PathBuf>,
    /// Judges the faces that were read where others were left out; else the verdict is undecided.
    #[arg(long)]
    pub(crate) allow_skipped: bool,
    /// The form of the output; text if not given.
    #[arg(long, value_enum)]
    format: Option<CheckFormat>,
    /// Prints the result as one JSON object, as --format json.
    #[arg(long, conflicts_with = "format")]
    json: bool,
}

impl CheckArguments {
    /// The library's options, which checks their ranges.
    pub(crate) fn options(&self, rules: CheckRules) -> CheckOptions {
        CheckOptions {
            below: self.below,
            tolerance: self.tolerance,
            relative_tolerance: self.relative_tolerance,
            max_cells: self.max_cells,
            max_seconds: self.max_seconds,
            scale_units: self.scale_units,
            rules,
        }
    }

    pub(crate) fn format(&self) -> Format {
        match self.format {
            Some(CheckFormat::Json) => Format::Json,
            Some(CheckFormat::Junit) => Format::Junit,
            Some(CheckFormat::Markdown) => Format::Markdown,
            Some(CheckFormat::Html) => Format::Html,
            Some(CheckFormat::Text) => Format::Text,
            None if self.json => Format::Json,
            None => Format::Text,
        }
    }
}
