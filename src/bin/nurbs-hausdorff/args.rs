//! The arguments.

use crate::motion::{Rotation, Translation};
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use nurbs_hausdorff::options::{Culling, Flatness, Projection, SamplingRule};
use nurbs_hausdorff::{Backend, Method, Options, Result, RigidTransform};
use std::path::PathBuf;

/// How far apart are two NURBS models? Models are interchange JSON files.
#[derive(Debug, Parser)]
#[command(version, about)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Measures the Hausdorff distance from A to B.
    ///
    /// Exit status: 0 done, or within --max; 1 beyond --max; 2 bad input;
    /// 3 undecided about --max.
    Distance(Box<DistanceArguments>),
    /// Tells what a model consists of.
    Info(InfoArguments),
    /// Prints a completion script.
    Completions {
        /// The shell to complete in.
        shell: Shell,
    },
}

#[derive(Debug, Args)]
pub(crate) struct DistanceArguments {
    /// The model measured from.
    pub(crate) a: PathBuf,
    /// The model measured to.
    pub(crate) b: PathBuf,
    /// How the distance is computed.
    #[arg(long, value_enum, default_value_t = MethodName::Certified)]
    method: MethodName,
    /// certified: width of the interval, relative to the larger diagonal.
    #[arg(long, default_value_t = 1e-6)]
    tolerance: f64,
    /// certified: the tolerance is in model units.
    #[arg(long)]
    absolute: bool,
    /// Only whether the distance is at most LIMIT; exit status 0 yes, 1 no, 3 undecided.
    #[arg(long, value_name = "LIMIT")]
    pub(crate) max: Option<f64>,
    /// certified: seconds a direction after which the interval so far is told.
    #[arg(long, value_name = "SECONDS")]
    max_seconds: Option<f64>,
    /// certified: cells a direction after which the interval so far is told.
    #[arg(long, value_name = "CELLS")]
    max_cells: Option<usize>,
    /// iteration: samples along each direction of every surface.
    #[arg(long, default_value_t = 64)]
    samples: usize,
    /// iteration: how the samples are spread.
    #[arg(long, value_enum, default_value_t = SamplingName::Uniform)]
    sampling: SamplingName,
    /// iteration: how flat B's patches are cut.
    #[arg(long, value_enum, default_value_t = FlatnessName::Loose)]
    flatness: FlatnessName,
    /// iteration: the step of the projection, damped Newton or the 2012 paper's own.
    #[arg(long, value_enum, default_value_t = ProjectionName::Newton)]
    projection: ProjectionName,
    /// iteration: the patches tried, those near enough or all as in the paper.
    #[arg(long, value_enum, default_value_t = CullingName::Tree)]
    culling: CullingName,
    /// iteration: steps on one patch.
    #[arg(long, default_value_t = 5)]
    iterations: u32,
    /// iteration: change of distance that ends the tangent-plane step, in model units.
    #[arg(long, default_value_t = 0.01)]
    step_tolerance: f64,
    /// hierarchy: cells along each direction of every surface.
    #[arg(long, default_value_t = 64)]
    grid: usize,
    /// hierarchy: memory for pairs of boxes, in MiB.
    #[arg(long, value_name = "MIB", default_value_t = 256)]
    memory_budget: usize,
    /// Both directions; the distance is the larger.
    #[arg(long)]
    symmetric: bool,
    /// Moves A before it is measured.
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,0", allow_hyphen_values = true)]
    translate: Translation,
    /// Turns A about an axis through the origin before it is moved.
    #[arg(long, value_name = "X,Y,Z,DEGREES", default_value = "0,0,1,0", allow_hyphen_values = true)]
    rotate: Rotation,
    /// Statistics of the deviation at the samples; estimates.
    #[arg(long)]
    statistics: bool,
    /// Where iteration and hierarchy work and samples are projected; certified is float64 work on the CPU.
    #[arg(long, value_enum, default_value_t = BackendName::Auto)]
    backend: BackendName,
    /// Prints one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct InfoArguments {
    /// The model.
    pub(crate) model: PathBuf,
    /// Prints one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

impl DistanceArguments {
    /// The library's options.
    ///
    /// # Errors
    /// As [`RigidTransform::new`]; ranges are the library's to check.
    pub(crate) fn options(&self) -> Result<Options> {
        Ok(Options {
            method: self.method.into(),
            tolerance: self.tolerance,
            absolute: self.absolute,
            limit: self.max,
            max_seconds: self.max_seconds,
            max_cells: self.max_cells,
            samples: self.samples,
            sampling: self.sampling.into(),
            flatness: self.flatness.into(),
            projection: self.projection.into(),
            culling: self.culling.into(),
            iterations: self.iterations,
            step_tolerance: self.step_tolerance,
            grid: self.grid,
            memory_budget: self.memory_budget,
            symmetric: self.symmetric,
            transform: RigidTransform::new(self.rotate.0, self.translate.0)?,
            backend: self.backend.into(),
            field: self.statistics,
        })
    }
}

/// A library enum by its names on the command line.
macro_rules! named {
    ($name:ident, $library:ident, $($variant:ident),+) => {
        #[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
        pub(crate) enum $name { $($variant),+ }
        impl From<$name> for $library {
            fn from(name: $name) -> Self {
                match name { $($name::$variant => Self::$variant),+ }
            }
        }
    };
}

named!(MethodName, Method, Certified, Iteration, Hierarchy);
named!(SamplingName, SamplingRule, Uniform, ArcLength);
named!(FlatnessName, Flatness, None, Loose, Tight, Curvature);
named!(ProjectionName, Projection, Newton, TangentPlane);
named!(CullingName, Culling, Tree, None);
named!(BackendName, Backend, Auto, Gpu, Cpu);
