//! The arguments of `diff`.

use crate::arguments::models::{Pair, Placement, Reporting};
use clap::Args;
use nurbs_hausdorff::{DiffOptions, Result};

#[derive(Debug, Args)]
pub(crate) struct DiffArguments {
    #[command(flatten)]
    pub(crate) pair: Pair,
    /// Distance, in model units, up to which a face counts as unchanged.
    #[arg(long, default_value_t = 1e-3)]
    limit: f64,
    /// Judges by --limit the faces that were read where others were left out; else that is undecided.
    #[arg(long)]
    pub(crate) allow_skipped: bool,
    /// Takes for the verdict what holds for every reading of the files within their gaps.
    #[arg(long)]
    pub(crate) strict_gaps: bool,
    /// Cells after which a face is given up as undecided.
    #[arg(long, hide_short_help = true, value_name = "CELLS", default_value_t = 1_000_000)]
    max_cells: usize,
    /// Seconds after which faces that are not decided are given up as undecided.
    #[arg(long, value_name = "SECONDS")]
    max_seconds: Option<f64>,
    #[command(flatten)]
    pub(crate) placement: Placement,
    #[command(flatten)]
    pub(crate) reporting: Reporting,
}

impl DiffArguments {
    /// The library's options.
    ///
    /// # Errors
    /// As [`RigidTransform::new`]; the library checks the ranges.
    pub(crate) fn options(&self) -> Result<DiffOptions> {
        Ok(DiffOptions {
            limit: self.limit,
            max_cells: self.max_cells,
            max_seconds: self.max_seconds,
            scale_units: self.placement.scales_units(),
            transform: self.placement.transform()?,
        })
    }
}
