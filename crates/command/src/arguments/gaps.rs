//! The arguments of the command `gaps`.

use super::Placement;
use clap::Args;
use nurbs_hausdorff::{GapOptions, Result};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct GapsArguments {
    /// The one model; - is standard input.
    pub(crate) a: PathBuf,
    /// The other model; - is standard input.
    pub(crate) b: PathBuf,
    /// Lists the pairs of faces that come nearer than LENGTH, in model units.
    #[arg(long, value_name = "LENGTH")]
    below: f64,
    /// Permitted width of the intervals, in model units.
    #[arg(long, value_name = "LENGTH")]
    tolerance: Option<f64>,
    /// The same as a fraction of the larger diagonal; 1e-6 if neither is given.
    #[arg(long, value_name = "FRACTION")]
    relative_tolerance: Option<f64>,
    /// Takes the faces that were read where others were left out; else the exit status is 3.
    #[arg(long)]
    pub(crate) allow_skipped: bool,
    /// Seconds after which the pairs so far are the result.
    #[arg(long, value_name = "SECONDS")]
    max_seconds: Option<f64>,
    /// Pairs of cells, for each pair of faces, after which the interval reached is taken.
    #[arg(long, hide_short_help = true, value_name = "CELLS")]
    max_cells: Option<usize>,
    #[command(flatten)]
    pub(crate) placement: Placement,
    /// Prints the result as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

impl GapsArguments {
    /// The library's options.
    ///
    /// # Errors
    /// As [`nurbs_hausdorff::RigidTransform::new`]; the library checks the ranges.
    pub(crate) fn options(&self) -> Result<GapOptions> {
        Ok(GapOptions {
            below: self.below,
            tolerance: self.tolerance,
            relative_tolerance: self.relative_tolerance,
            max_seconds: self.max_seconds,
            max_cells: self.max_cells,
            scale_units: self.placement.scales_units(),
            transform: self.placement.transform()?,
        })
    }
}
