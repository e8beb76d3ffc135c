//! Two models, where they lie, and the form of what is said of them.

pub(crate) mod motion;
mod placement;

pub(crate) use placement::{Placement, Unit, UnitsOfFiles};

use crate::reports::Format;
use clap::Args;
use std::path::PathBuf;

/// Two models, or two directories.
#[derive(Debug, Args)]
pub(crate) struct Pair {
    /// The model A, from which directed distances are measured, or a directory of models; - is standard input.
    pub(crate) a: PathBuf,
    /// The model B, or a directory whose files are compared with those of A of the same relative path.
    pub(crate) b: PathBuf,
}

/// The files compared and the form of the output.
#[derive(Debug, Args)]
pub(crate) struct Reporting {
    /// The form of the output; text if not given.
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Prints the result as one JSON object, as --format json.
    #[arg(long, conflicts_with = "format")]
    json: bool,
    /// Of directories, the files whose relative path matches PATTERN, such as *.step or parts/**/*.{brep,iges}; all models if not given.
    #[arg(long, hide_short_help = true, value_name = "PATTERN")]
    pub(crate) include: Option<String>,
    /// Keeps answers in FOLDER, and reads those to pairs of the same content and options from it.
    #[arg(long, hide_short_help = true, value_name = "FOLDER")]
    pub(crate) reuse: Option<PathBuf>,
    /// The name of the part, which --format html prints.
    #[arg(long, hide_short_help = true, value_name = "NAME")]
    pub(crate) part: Option<String>,
    /// Who compares, which --format html prints.
    #[arg(long, hide_short_help = true, value_name = "NAME")]
    pub(crate) operator: Option<String>,
}

impl Reporting {
    pub(crate) fn format(&self) -> Format {
        self.format.unwrap_or(if self.json { Format::Json } else { Format::Text })
    }
}

/// Two models that are compared, until when, and the form of the result.
#[derive(Debug, Args)]
pub(crate) struct Compared {
    /// The one model; - is standard input.
    pub(crate) a: PathBuf,
    /// The other model; - is standard input.
    pub(crate) b: PathBuf,
    /// Judges the faces that were read where others were left out; else that is undecided.
    #[arg(long)]
    pub(crate) allow_skipped: bool,
    /// Seconds after which what was reached is the result.
    #[arg(long, value_name = "SECONDS")]
    pub(super) max_seconds: Option<f64>,
    #[command(flatten)]
    pub(crate) placement: Placement,
    /// Prints the result as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}
