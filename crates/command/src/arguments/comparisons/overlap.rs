//! The arguments of `overlap`.

use crate::arguments::models::Compared;
use clap::Args;
use nurbs_hausdorff::{OverlapOptions, Result};

#[derive(Debug, Args)]
pub(crate) struct OverlapArguments {
    #[command(flatten)]
    pub(crate) compared: Compared,
    /// Permitted width of the common volume, as a fraction of the union's; 1e-3 if not given.
    #[arg(long, value_name = "FRACTION")]
    tolerance: Option<f64>,
    /// Pieces of faces after which the intervals reached are the result; 400,000 if not given.
    #[arg(long, hide_short_help = true, value_name = "CELLS")]
    max_cells: Option<usize>,
}

impl OverlapArguments {
    /// The library's options.
    ///
    /// # Errors
    /// As [`RigidTransform::new`]; the library checks the ranges.
    pub(crate) fn options(&self) -> Result<OverlapOptions> {
        let &Self { tolerance, max_cells, ref compared } = self;
        Ok(OverlapOptions {
            tolerance,
            max_seconds: compared.max_seconds,
            max_cells,
            scale_units: compared.placement.scales_units(),
            transform: compared.placement.transform()?,
        })
    }
}
