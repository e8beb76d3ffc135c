//! The arguments.

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

pub(crate) mod align;
pub(crate) mod by_hand;
pub(crate) mod check;
pub(crate) mod clearance;
pub(crate) mod grid;
pub(crate) mod motion;
pub(crate) mod points;
pub(crate) mod score;
pub(crate) mod usage;

use crate::reports::Format;
use align::AlignArguments;
use check::CheckArguments;
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use clearance::{ClearanceArguments, GapsArguments};
use grid::GridArguments;
use motion::{Rotation, Translation};
use nurbs_hausdorff::{
    Backend, DiffOptions, DistanceOptions, MethodName, NamedOptions, OverlapOptions, Precision, Result,
    RigidTransform, StatisticsOptions,
    options::{Audit, Culling, Flatness, Projection, SamplingRule},
};
use points::ClosestPointsArguments;
use score::{ScoreArguments, SummaryArguments};
use serde::Deserialize;
use std::path::PathBuf;

/// How far apart are two NURBS models? Models are files of STEP, interchange JSON or BREP text.
#[derive(Debug, Parser)]
#[command(name = "nurbs-hausdorff", version, about)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Computes the Hausdorff distance from A to B.
    ///
    /// Exit status: 0 if the distance was computed or is within --limit, 1 if it
    /// is beyond --limit, 2 for bad input, 3 if --limit was not decided or faces
    /// were left out.
    Distance(Box<DistanceArguments>),
    /// Compares two models face by face.
    ///
    /// Exit status: 0 if no face changed by more than --limit, 1 if one did,
    /// 2 for bad input, 3 if a face could not be decided and none changed, or
    /// if faces were left out.
    Diff(DiffArguments),
    /// Computes the least distance of A from B, and whether solids overlap.
    ///
    /// Exit status: 0 if the clearance was computed or is at least --limit, 1 if it
    /// is less or solids overlap, 2 for bad input, 3 if --limit was not decided or
    /// faces were left out.
    Clearance(ClearanceArguments),
    /// Lists the pairs of faces of two models that come nearer than --below, each with its least distance.
    ///
    /// Exit status: 0 if all pairs were compared, 2 for bad input, 3 if a budget ended that or faces were left out.
    Gaps(GapsArguments),
    /// Computes the volumes that two solids have in common and apart, each as an interval.
    ///
    /// Exit status: 0 if they were computed, 2 for bad input, 3 if a model has no volume or faces were
    /// left out.
    Overlap(OverlapArguments),
    /// Compares all pairs of bodies of a model, or of several: which clash, touch or come near.
    ///
    /// Exit status: 0 if no pair clashes and all rules are kept, 1 if a pair clashes or a rule is broken,
    /// 2 for bad input, 3 if that could not be decided or faces were left out.
    Check(CheckArguments),
    /// Computes statistics of the distances from A to B, each as an interval that holds it.
    ///
    /// Of a cloud of points they are over its points, else over the area of A: the mean, the root
    /// mean square, the percentiles 50, 95 and 99, and the part beyond --limit.
    ///
    /// Exit status: 0 if they were computed, 2 for bad input.
    Statistics(StatisticsArguments),
    /// Scores a candidate against the truth: every number an interval that holds it.
    ///
    /// Mean distances both ways, precision, recall and F1 by area, the Hausdorff distance, volume, area,
    /// centroid, extents and validity. A number may be required by --at-least f1=0.99 or --at-most
    /// hausdorff=0.1; names are valid, volume-ratio, area-ratio, centroid-distance, extent-difference,
    /// precision, recall, f1, chamfer, chamfer-squared, hausdorff and iou. Work ends where one is missed.
    ///
    /// Exit status: 0 if the score was computed or all requirements are met, 1 if one is missed, 2 for bad
    /// input, 3 if one is undecided or faces were left out.
    Score(Box<ScoreArguments>),
    /// Prints means, medians and the invalid ratio of the scores of a data set, as intervals that hold them.
    ///
    /// It reads the answers of batch to lines with the command score.
    ///
    /// Exit status: 0 if they were printed, 2 for bad input.
    Summary(SummaryArguments),
    /// Lays A on B: finds the rigid motion of A that fits B best, from any pose.
    ///
    /// The first pose may be made by hand: from pairs of points, or by datums in their order. With --norm largest the
    /// largest distance is made least, and its least value over a box of motions is printed as an interval that holds
    /// it. The last line printed measures the pair in that pose.
    ///
    /// Exit status: 0 if a fit was found or passes --limit, 1 if no motion of the box does, 2 for bad input, 3 if
    /// the best pose is no fit or --limit was not decided.
    Align(Box<AlignArguments>),
    /// Measures points from a model: signed distances with their bounds, the feet and their faces.
    ///
    /// Signs are those of the solid, negative inside, where the model closes, else those of the faces' normals.
    ///
    /// Exit status: 0 if they were measured, 2 for bad input.
    ClosestPoints(ClosestPointsArguments),
    /// Writes the signed distances of a solid on a grid of points, negative inside.
    ///
    /// What is left out of --origin, --spacing and --counts follows from the model's box. The file is
    /// an array of NumPy (.npy, of shape x, y, z), NRRD (.nrrd) or an image of VTK (.vti).
    ///
    /// Exit status: 0 if it was written, 2 for bad input, which models that do not close are.
    Grid(GridArguments),
    /// Answers many pairs of files: lines of JSON in, lines of JSON out, in their order.
    ///
    /// A line has an id, the files a and b, a command (distance, diff, clearance, score or align;
    /// distance if none) and options by the names of the API, such as {"id": 1, "a": "a.step", "b": "b.step",
    /// "limit": 0.1}. The answer has the id and what the command prints with --json, or an error.
    ///
    /// Exit status: 0 if all pairs have a result, 1 if one has an error, 2 for bad usage, 130 if
    /// interrupted.
    Batch(BatchArguments),
    /// Prints the faces, patches and bounding box of a model.
    Info(InfoArguments),
    /// Writes a model as interchange JSON, and prints what reading it kept and left out.
    Convert(ConvertArguments),
    /// Prints a completion script.
    Completions {
        /// The shell to complete in.
        shell: Shell,
    },
}

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

/// The position and the unit in which the models are measured.
#[derive(Debug, Args)]
pub(crate) struct Placement {
    /// Scales B to the unit of A if the files state different units; else that is an error.
    #[arg(long)]
    pub(crate) scale_units: bool,
    #[command(flatten)]
    pub(crate) units: UnitsOfFiles,
    /// Moves A before it is measured.
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,0", allow_hyphen_values = true)]
    translate: Translation,
    /// Rotates A about an axis through the origin, before --translate moves it.
    #[arg(long, value_name = "X,Y,Z,DEGREES", default_value = "0,0,1,0", allow_hyphen_values = true)]
    rotate: Rotation,
}

/// The units of both files, whatever they state.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct UnitsOfFiles {
    /// The unit of A's coordinates, whatever its file states; B is scaled to it.
    #[arg(long, value_name = "UNIT", value_enum, hide_short_help = true)]
    pub(crate) unit_of_a: Option<Unit>,
    /// The unit of B's coordinates, whatever its file states; B is scaled to that of A.
    #[arg(long, value_name = "UNIT", value_enum, hide_short_help = true)]
    pub(crate) unit_of_b: Option<Unit>,
}

impl Placement {
    /// Whether B is scaled to the unit of A: who states a unit wants lengths in it.
    fn scales_units(&self) -> bool {
        self.scale_units || self.units.unit_of_a.is_some() || self.units.unit_of_b.is_some()
    }

    /// The motion of A.
    ///
    /// # Errors
    /// As [`RigidTransform::new`].
    fn transform(&self) -> Result<RigidTransform> {
        RigidTransform::new(self.rotate.0, self.translate.0)
    }
}

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
    max_seconds: Option<f64>,
    #[command(flatten)]
    pub(crate) placement: Placement,
    /// Prints the result as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

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

#[derive(Debug, Args)]
pub(crate) struct BatchArguments {
    /// The pairs, a line of JSON each; - is standard input.
    pub(crate) pairs: PathBuf,
    /// The file of the answers; standard output if not given.
    #[arg(long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Goes on with the output: pairs whose id it answers are left out.
    #[arg(long, requires = "output")]
    pub(crate) resume: bool,
    /// Replaces the output if it is there already.
    #[arg(long, conflicts_with = "resume")]
    pub(crate) overwrite: bool,
    /// Pairs compared at the same time; the number of cores if not given.
    #[arg(long, value_name = "PAIRS")]
    pub(crate) jobs: Option<usize>,
    /// Models kept prepared, those used last.
    #[arg(long, value_name = "MODELS", default_value_t = 16)]
    pub(crate) cache: usize,
    /// Seconds per search for pairs that state none, after which the interval reached is the result.
    #[arg(long, value_name = "SECONDS")]
    pub(crate) max_seconds: Option<f64>,
}

#[derive(Debug, Args)]
pub(crate) struct InfoArguments {
    /// The model; - is standard input.
    pub(crate) model: PathBuf,
    /// The unit of the facts; that of the model if not given.
    #[arg(long, value_enum)]
    pub(crate) unit: Option<Unit>,
    /// The mass of a cubic unit of the facts, for the mass of bodies.
    #[arg(long, value_name = "MASS")]
    pub(crate) density: Option<f64>,
    /// Prints the result as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

/// A unit of length.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, ValueEnum, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Unit {
    Mm,
    Cm,
    M,
    In,
    Ft,
    Um,
}

impl Unit {
    /// Returns its metres.
    pub(crate) fn metres(self) -> f64 {
        match self {
            Self::Mm => 1e-3,
            Self::Cm => 1e-2,
            Self::M => 1.0,
            Self::In => 0.0254,
            Self::Ft => 0.3048,
            Self::Um => 1e-6,
        }
    }
}

#[derive(Debug, Args)]
pub(crate) struct ConvertArguments {
    /// The model; - is standard input.
    pub(crate) input: PathBuf,
    /// The file to write; - is standard output.
    pub(crate) output: PathBuf,
    /// Replaces the output if it is there already.
    #[arg(long)]
    pub(crate) overwrite: bool,
    /// Prints the report as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
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

named!(MethodChoice, MethodName, Certified, Iteration, Hierarchy);
named!(SamplingName, SamplingRule, Uniform, ArcLength);
named!(FlatnessName, Flatness, None, Loose, Tight, Curvature);
named!(ProjectionName, Projection, Newton, TangentPlane);
named!(CullingName, Culling, Tree, None);
named!(PrecisionName, Precision, Float32, Float64);
named!(AuditName, Audit, Share, All);
named!(BackendName, Backend, Auto, Gpu, Cpu);
