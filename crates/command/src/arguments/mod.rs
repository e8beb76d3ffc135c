//! The arguments of the command line.

pub(crate) mod batch;
pub(crate) mod check;
pub(crate) mod comparisons;
pub(crate) mod files;
pub(crate) mod grid;
pub(crate) mod models;
mod names;
pub(crate) mod points;
pub(crate) mod score;
pub(crate) mod usage;

use batch::BatchArguments;
use check::CheckArguments;
use clap::{Parser, Subcommand};
use clap_complete::Shell;
use comparisons::align::AlignArguments;
use comparisons::clearance::{ClearanceArguments, GapsArguments};
use comparisons::{DiffArguments, DistanceArguments, OverlapArguments, StatisticsArguments};
use files::{ConvertArguments, InfoArguments};
use grid::GridArguments;
use points::ClosestPointsArguments;
use score::{ScoreArguments, SummaryArguments};

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
    /// is beyond --limit, 2 for bad input, 3 if --limit was not decided or, with --limit,
    /// faces were left out.
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
    /// is less or solids overlap, 2 for bad input, 3 if --limit was not decided or, with
    /// --limit, faces were left out.
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
    /// hausdorff=0.1. The names are valid, volume-ratio, area-ratio, centroid-distance, extent-difference,
    /// chamfer, chamfer-squared, hausdorff, iou, and precision, recall and f1, which may have the prefix
    /// normal- or edge-. The work ends if a requirement is missed.
    ///
    /// Exit status: 0 if the score was computed or all requirements are met, 1 if one is missed, 2 for bad
    /// input, 3 if one is undecided or, with a requirement, faces were left out.
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
