//! The arguments of `statistics`.

use crate::arguments::models::Placement;
use clap::Args;
use nurbs_hausdorff::{Result, StatisticsOptions};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct StatisticsArguments {
    /// The model A, whose points are measured; - is standard input.
    pub(crate) a: PathBuf,
    /// The model B, which they are measured to; - is standard input.
    pub(crate) b: PathBuf,
    /// Permitted width of the intervals of lengths, in model units.
    #[arg(long, value_name = "LENGTH")]
    tolerance: Option<f64>,
    /// The same as a fraction of the larger diagonal; 1e-4 if neither is given.
    #[arg(long, value_name = "FRACTION")]
    relative_tolerance: Option<f64>,
    /// Adds the part of A that is farther from B than LIMIT.
    #[arg(long, value_name = "LIMIT")]
    limit: Option<f64>,
    /// Permitted width of the interval of that part.
    #[arg(long, hide_short_help = true, value_name = "PART", default_value_t = 1e-3)]
    part_tolerance: f64,
    /// Seconds after which the intervals reached are the result.
    #[arg(long, value_name = "SECONDS")]
    max_seconds: Option<f64>,
    /// Parts of A after which the intervals reached are the result.
    #[arg(long, hide_short_help = true, value_name = "CELLS", default_value_t = 300_000)]
    max_cells: usize,
    #[command(flatten)]
    pub(crate) placement: Placement,
    /// Prints the result as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

impl StatisticsArguments {
    /// The library's options.
    ///
    /// # Errors
    /// As [`RigidTransform::new`]; the library checks the ranges.
    pub(crate) fn options(&self) -> Result<StatisticsOptions> {
        Ok(StatisticsOptions {
            tolerance: self.tolerance,
            relative_tolerance: self.relative_tolerance,
            limit: self.limit,
            part_tolerance: self.part_tolerance,
            max_seconds: self.max_seconds,
            max_cells: self.max_cells,
            scale_units: self.placement.scales_units(),
            transform: self.placement.transform()?,
            ..StatisticsOptions::default()
        })
    }
}
