//! The arguments of the commands `clearance` and `gaps`, which search least distances.

use crate::arguments::models::Compared;
use clap::Args;
use nurbs_hausdorff::{ClearanceOptions, GapOptions, Result};

/// Two models, and how long and how narrowly their least distances are searched.
#[derive(Debug, Args)]
pub(crate) struct Search {
    #[command(flatten)]
    pub(crate) compared: Compared,
    /// Permitted width of an interval, in model units; what is nearer than it counts as touching.
    #[arg(long, value_name = "LENGTH")]
    tolerance: Option<f64>,
    /// The same as a fraction of the larger diagonal; 1e-6 if neither is given.
    #[arg(long, value_name = "FRACTION")]
    relative_tolerance: Option<f64>,
    /// Pairs of cells, for each interval, after which the interval reached is taken.
    #[arg(long, hide_short_help = true, value_name = "CELLS")]
    max_cells: Option<usize>,
}

#[derive(Debug, Args)]
pub(crate) struct ClearanceArguments {
    #[command(flatten)]
    pub(crate) search: Search,
    /// Decides whether the clearance is at least LIMIT: exit status 0 for yes, 1 for no, 3 for undecided.
    #[arg(long, value_name = "LIMIT")]
    pub(crate) limit: Option<f64>,
    /// Takes for the verdict what holds for every reading of the files within their gaps.
    #[arg(long)]
    pub(crate) strict_gaps: bool,
}

impl ClearanceArguments {
    /// The library's options.
    ///
    /// # Errors
    /// As [`nurbs_hausdorff::RigidTransform::new`]; the library checks the ranges.
    pub(crate) fn options(&self) -> Result<ClearanceOptions> {
        let Search { tolerance, relative_tolerance, max_cells, ref compared } = self.search;
        let Compared { max_seconds, ref placement, .. } = *compared;
        Ok(ClearanceOptions {
            tolerance,
            relative_tolerance,
            limit: self.limit,
            max_seconds,
            max_cells,
            scale_units: placement.scales_units(),
            transform: placement.transform()?,
        })
    }
}

#[derive(Debug, Args)]
pub(crate) struct GapsArguments {
    #[command(flatten)]
    pub(crate) search: Search,
    /// Lists the pairs of faces that come nearer than LENGTH, in model units.
    #[arg(long, value_name = "LENGTH")]
    below: f64,
}

impl GapsArguments {
    /// The library's options.
    ///
    /// # Errors
    /// As [`nurbs_hausdorff::RigidTransform::new`]; the library checks the ranges.
    pub(crate) fn options(&self) -> Result<GapOptions> {
        let Search { tolerance, relative_tolerance, max_cells, ref compared } = self.search;
        let Compared { max_seconds, ref placement, .. } = *compared;
        Ok(GapOptions {
            below: self.below,
            tolerance,
            relative_tolerance,
            max_seconds,
            max_cells,
            scale_units: placement.scales_units(),
            transform: placement.transform()?,
        })
    }
}
