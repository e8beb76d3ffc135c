//! The arguments of `distance`.

use crate::arguments::models::{Pair, Placement, Reporting};
use crate::arguments::names::{
    AuditName, BackendName, CullingName, FlatnessName, MethodChoice, ProjectionName, SamplingName,
};
use clap::Args;
use nurbs_hausdorff::{DistanceOptions, NamedOptions, Result};

#[derive(Debug, Args)]
pub(crate) struct DistanceArguments {
    #[command(flatten)]
    pub(crate) pair: Pair,
    /// The method that computes the distance.
    #[arg(long, hide_short_help = true, value_enum, default_value_t = MethodChoice::Certified)]
    method: MethodChoice,
    /// Permitted width of the interval, in model units.
    #[arg(long, value_name = "LENGTH")]
    tolerance: Option<f64>,
    /// The same as a fraction of the larger diagonal; 1e-6 if neither is given.
    #[arg(long, value_name = "FRACTION")]
    relative_tolerance: Option<f64>,
    /// Decides whether the distance is at most LIMIT: exit status 0 for yes, 1 for no, 3 for undecided.
    #[arg(long, value_name = "LIMIT")]
    pub(crate) limit: Option<f64>,
    /// Judges by --limit the faces that were read where others were left out; else that is undecided.
    #[arg(long)]
    pub(crate) allow_skipped: bool,
    /// Takes for the verdict what holds for every reading of the files within their gaps.
    #[arg(long)]
    pub(crate) strict_gaps: bool,
    /// certified: seconds per direction after which the interval reached is the result.
    #[arg(long, value_name = "SECONDS")]
    max_seconds: Option<f64>,
    /// certified: cells per direction after which the interval reached is the result.
    #[arg(long, hide_short_help = true, value_name = "CELLS")]
    max_cells: Option<usize>,
    /// certified: the bounds that are audited while the search runs; a share if not given.
    #[arg(long, value_enum)]
    audit: Option<AuditName>,
    /// iteration and --deviations: samples along each parameter direction of every surface; 64 if not given.
    #[arg(long, hide_short_help = true)]
    samples: Option<usize>,
    /// iteration and --deviations: the rule by which the samples are spread; uniform if not given.
    #[arg(long, hide_short_help = true, value_enum)]
    sampling: Option<SamplingName>,
    /// iteration: the flatness to which the patches of B are cut; loose if not given.
    #[arg(long, hide_short_help = true, value_enum)]
    flatness: Option<FlatnessName>,
    /// iteration: the step of the projection, damped Newton (if not given) or the tangent-plane step of the 2012 paper.
    #[arg(long, hide_short_help = true, value_enum)]
    projection: Option<ProjectionName>,
    /// iteration: the patches on which a sample is projected, those near enough (if not given) or all as in the paper.
    #[arg(long, hide_short_help = true, value_enum)]
    culling: Option<CullingName>,
    /// iteration: largest number of steps on one patch; 5 if not given.
    #[arg(long, hide_short_help = true)]
    iterations: Option<u32>,
    /// iteration: change of distance that ends the tangent-plane step, in model units; 0.01 if not given.
    #[arg(long, hide_short_help = true)]
    step_tolerance: Option<f64>,
    /// hierarchy: cells along each parameter direction of every surface; 64 if not given.
    #[arg(long, hide_short_help = true)]
    grid: Option<usize>,
    /// hierarchy: memory for the pairs of boxes, in MiB; 256 if not given.
    #[arg(long, hide_short_help = true, value_name = "MIB")]
    memory_budget: Option<usize>,
    /// Computes both directions; the distance is the larger one.
    #[arg(long)]
    symmetric: bool,
    #[command(flatten)]
    pub(crate) placement: Placement,
    /// Adds statistics of the deviation at a grid of samples; they are estimates.
    #[arg(long, hide_short_help = true)]
    deviations: bool,
    /// The processor for the kernels; auto is the GPU if there is one, except for method certified.
    #[arg(long, hide_short_help = true, value_enum, default_value_t = BackendName::Auto)]
    backend: BackendName,
    #[command(flatten)]
    pub(crate) reporting: Reporting,
}

impl DistanceArguments {
    /// The library's options.
    ///
    /// # Errors
    /// As [`RigidTransform::new`]; [`nurbs_hausdorff::Error::OptionInvalid`] for an option of
    /// another method. The library checks the ranges.
    pub(crate) fn options(&self) -> Result<DistanceOptions> {
        DistanceOptions::try_from(NamedOptions {
            method: self.method.into(),
            tolerance: self.tolerance,
            relative_tolerance: self.relative_tolerance,
            limit: self.limit,
            max_seconds: self.max_seconds,
            max_cells: self.max_cells,
            audit: self.audit.map(Into::into),
            samples: self.samples,
            sampling: self.sampling.map(Into::into),
            flatness: self.flatness.map(Into::into),
            projection: self.projection.map(Into::into),
            culling: self.culling.map(Into::into),
            iterations: self.iterations,
            step_tolerance: self.step_tolerance,
            grid: self.grid,
            memory_budget: self.memory_budget,
            symmetric: self.symmetric,
            scale_units: self.placement.scales_units(),
            transform: self.placement.transform()?,
            backend: self.backend.into(),
            deviations: self.deviations,
        })
    }
}
