//! The arguments of the commands `score` and `summary`.

use super::models::Placement;
use super::names::named;
use clap::{Args, ValueEnum};
use nurbs_hausdorff::{Result, ScoreAlignment, ScoreNumber, ScoreOptions};
use std::path::PathBuf;

named!(AlignName, ScoreAlignment, None, Box, BestFit);

/// A number with a bound, as `f1=0.99`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bound(ScoreNumber, f64);

fn bound(text: &str) -> std::result::Result<Bound, String> {
    let (number, value) =
        text.split_once('=').ok_or_else(|| format!("found {text:?}, expected NUMBER=VALUE"))?;
    let value = value.parse().map_err(|_| format!("found {value:?}, expected a number"))?;
    Ok(Bound(number.parse()?, value))
}

#[derive(Debug, Args)]
pub(crate) struct ScoreArguments {
    /// The candidate, such as what a program generated; - is standard input.
    pub(crate) candidate: PathBuf,
    /// The truth, which it is scored against; - is standard input.
    pub(crate) truth: PathBuf,
    /// A distance at which precision, recall and F1 are stated, in model units; may be repeated.
    #[arg(long, value_name = "LENGTH")]
    threshold: Vec<f64>,
    /// The same as a fraction of the diagonal of the truth's box; 0.01 if neither is given.
    #[arg(long, value_name = "FRACTION")]
    relative_threshold: Vec<f64>,
    /// The largest angle between tangent planes that count as alike, in degrees.
    #[arg(long, value_name = "DEGREES", default_value_t = 30.0)]
    normal_angle: f64,
    /// The angle by which a surface turns at a feature edge at least, in degrees.
    #[arg(long, value_name = "DEGREES", default_value_t = 30.0)]
    feature_angle: f64,
    /// How the candidate is laid on the truth: as it is, by the middle and the longest side of the boxes, or by the best fit.
    #[arg(long, value_enum, default_value_t = AlignName::None)]
    align: AlignName,
    /// Requires a number to be at least a value: exit status 0 if all are met, 1 if one is missed, 3 if undecided; may be repeated.
    #[arg(long, value_name = "NUMBER=VALUE", value_parser = bound)]
    at_least: Vec<Bound>,
    /// Requires a number to be at most a value, as --at-least.
    #[arg(long, value_name = "NUMBER=VALUE", value_parser = bound)]
    at_most: Vec<Bound>,
    /// Compares faces one by one: those within LIMIT of the other model are unchanged.
    #[arg(long, value_name = "LIMIT")]
    limit: Option<f64>,
    /// Permitted width of the intervals of lengths, in model units.
    #[arg(long, value_name = "LENGTH")]
    tolerance: Option<f64>,
    /// The same as a fraction of the diagonal of the truth's box; 1e-3 if neither is given.
    #[arg(long, value_name = "FRACTION")]
    relative_tolerance: Option<f64>,
    /// Permitted width of the intervals of precision and recall, of areas, with normals and of edges.
    #[arg(long, hide_short_help = true, value_name = "PART", default_value_t = 1e-3)]
    part_tolerance: f64,
    /// Seconds after which the intervals reached are the result.
    #[arg(long, value_name = "SECONDS")]
    max_seconds: Option<f64>,
    /// Parts of a model after which the intervals reached are the result.
    #[arg(long, hide_short_help = true, value_name = "CELLS", default_value_t = 300_000)]
    max_cells: usize,
    /// Judges the faces that were read where others were left out; else that is undecided.
    #[arg(long)]
    pub(crate) allow_skipped: bool,
    #[command(flatten)]
    pub(crate) placement: Placement,
    /// Prints the result as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

impl ScoreArguments {
    /// The library's options.
    ///
    /// # Errors
    /// As [`nurbs_hausdorff::RigidTransform::new`]; the library checks the ranges.
    pub(crate) fn options(&self) -> Result<ScoreOptions> {
        let bounds = |all: &[Bound]| all.iter().map(|&Bound(number, value)| (number, value)).collect();
        Ok(ScoreOptions {
            thresholds: self.threshold.clone(),
            relative_thresholds: self.relative_threshold.clone(),
            normal_angle: self.normal_angle,
            feature_angle: self.feature_angle,
            align: self.align.into(),
            tolerance: self.tolerance,
            relative_tolerance: self.relative_tolerance,
            part_tolerance: self.part_tolerance,
            limit: self.limit,
            at_least: bounds(&self.at_least),
            at_most: bounds(&self.at_most),
            max_cells: self.max_cells,
            max_seconds: self.max_seconds,
            scale_units: self.placement.scales_units(),
            transform: self.placement.transform()?,
        })
    }
}

#[derive(Debug, Args)]
pub(crate) struct SummaryArguments {
    /// The answers of batch to lines of command score; - is standard input.
    pub(crate) answers: PathBuf,
    /// The form of the output.
    #[arg(long, value_enum, default_value_t = SummaryFormat::Text)]
    pub(crate) format: SummaryFormat,
}

/// The form of a summary.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum SummaryFormat {
    /// Lines for people.
    Text,
    /// One JSON object.
    Json,
    /// A line for each number.
    Csv,
    /// A table.
    Latex,
}
