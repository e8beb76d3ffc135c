//! The arguments of the command `align`.

use super::{Placement, SamplingName};
use clap::{Args, ValueEnum};
use nurbs_hausdorff::{BestFitOptions, FitStart, Result, Robust};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct AlignArguments {
    /// The model A, which is moved, such as a scan; - is standard input.
    pub(crate) a: PathBuf,
    /// The model B, which it is laid on; - is standard input.
    pub(crate) b: PathBuf,
    /// The poses from which the fit starts: all rotations, or --rotate and --translate alone.
    #[arg(long, value_enum, default_value_t = StartName::Any)]
    from: StartName,
    /// The share of A's samples that lie on nothing of B and are left out, from 0 to 0.95.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    outliers: f64,
    /// The rule by which samples far from B lose their weight; trimmed if there are outliers, else none.
    #[arg(long, value_enum)]
    robust: Option<RobustName>,
    /// Samples along each parameter direction of every surface of A.
    #[arg(long, hide_short_help = true, default_value_t = BestFitOptions::default().samples)]
    samples: usize,
    /// The rule by which the samples are spread; uniform if not given.
    #[arg(long, hide_short_help = true, value_enum)]
    sampling: Option<SamplingName>,
    /// Length of a step that ends the fit, in model units.
    #[arg(long, hide_short_help = true, value_name = "LENGTH")]
    tolerance: Option<f64>,
    /// The same as a fraction of the larger diagonal; 1e-9 if neither is given.
    #[arg(long, hide_short_help = true, value_name = "FRACTION")]
    relative_tolerance: Option<f64>,
    /// Largest number of steps of the last fit.
    #[arg(long, hide_short_help = true, value_name = "STEPS", default_value_t = BestFitOptions::default().max_steps)]
    max_steps: usize,
    #[command(flatten)]
    placement: Placement,
    /// Prints the result as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

impl AlignArguments {
    /// The library's options.
    ///
    /// # Errors
    /// As [`nurbs_hausdorff::RigidTransform::new`]; the library checks the ranges.
    pub(crate) fn options(&self) -> Result<BestFitOptions> {
        Ok(BestFitOptions {
            samples: self.samples,
            sampling: self.sampling.map(Into::into).unwrap_or_default(),
            start: self.from.into(),
            tolerance: self.tolerance,
            relative_tolerance: self.relative_tolerance,
            max_steps: self.max_steps,
            outliers: self.outliers,
            robust: self.robust.map(Into::into),
            scale_units: self.placement.scale_units,
            transform: self.placement.transform()?,
        })
    }

    /// Returns whether B is scaled to the unit of A.
    pub(crate) fn scales_units(&self) -> bool {
        self.placement.scale_units
    }
}

named!(StartName, FitStart, Any, Given);
named!(RobustName, Robust, None, Trimmed, Tukey, GemanMcclure);
