//! The arguments of the command `align`.

use super::by_hand::{DatumText, read_pairs};
use crate::arguments::models::Placement;
use crate::arguments::names::{SamplingName, named};
use crate::failure::Failure;
use clap::{Args, ValueEnum};
use nurbs_hausdorff::{BestFitOptions, FitNorm, FitStart, Robust, ZoneOptions};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct AlignArguments {
    /// The model A, which is moved, such as a scan; - is standard input.
    pub(crate) a: PathBuf,
    /// The model B, which it is laid on; - is standard input.
    pub(crate) b: PathBuf,
    /// The poses from which the fit starts: all rotations, --rotate and --translate alone, principal axes on
    /// each other, or the middles of boxes on each other.
    #[arg(long, value_enum, default_value_t = StartName::Any)]
    from: StartName,
    /// What the fit makes least: the mean of squared distances; the largest distance; that of a scan's points outside of B's
    /// body or inside, below 0 if all are on the other side; or none: A then stays where --from, --pairs and
    /// --datum lay it.
    #[arg(long, value_enum, default_value_t = NormName::Mean)]
    norm: NormName,
    /// A file of pairs of points, three or more, from which the fit starts in place of --from: lines
    /// x y z x y z of A and B, with a weight if there is one, or JSON.
    #[arg(long, value_name = "FILE", conflicts_with = "from")]
    pairs: Option<PathBuf>,
    /// A datum of A on that of B, the primary first, each in the freedoms that those before it leave: face:3=7 by
    /// the index of faces, plane:x,y,z,nx,ny,nz=…, axis:… by a point and a direction, or point:x,y,z=x,y,z.
    #[arg(long, value_name = "KIND:A=B", allow_hyphen_values = true)]
    datum: Vec<DatumText>,
    /// With --norm largest, outside or inside: the distance within which all of A should lie, in model units.
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub(crate) limit: Option<f64>,
    /// With such a norm: the largest shift of the motions that the interval is about; a hundredth of the
    /// larger diagonal if not given.
    #[arg(long, hide_short_help = true, value_name = "LENGTH")]
    box_translation: Option<f64>,
    /// With such a norm: the largest angle of the motions that the interval is about.
    #[arg(long, hide_short_help = true, value_name = "DEGREES", default_value_t = ZoneOptions::default().degrees)]
    box_degrees: f64,
    /// With such a norm: the largest number of boxes of motions that are bounded.
    #[arg(long, hide_short_help = true, value_name = "BOXES", default_value_t = ZoneOptions::default().max_boxes)]
    max_boxes: usize,
    /// The share of A's samples that lie on nothing of B and are left out, from 0 to 0.95.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    outliers: f64,
    /// The rule by which samples far from B lose their weight; trimmed if there are outliers, else none.
    #[arg(long, hide_short_help = true, value_enum)]
    robust: Option<RobustName>,
    /// The faces of A, by their indices, whose samples count in the last fit; all if not given.
    #[arg(long, hide_short_help = true, value_name = "FACES", value_delimiter = ',')]
    faces_of_a: Vec<usize>,
    /// The faces of B: in the last fit the samples count that are nearest to these; all if not given.
    #[arg(long, value_name = "FACES", value_delimiter = ',')]
    faces_of_b: Vec<usize>,
    /// The distance from B beyond which a sample does not count in the last fit.
    #[arg(long, value_name = "LENGTH")]
    max_distance: Option<f64>,
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
    pub(crate) placement: Placement,
    /// Prints the result as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

impl AlignArguments {
    /// The library's options.
    ///
    /// # Errors
    /// As [`nurbs_hausdorff::RigidTransform::new`], and of the file of pairs; the library checks the ranges.
    pub(crate) fn options(&self) -> Result<BestFitOptions, Failure> {
        let zone = ZoneOptions {
            translation: self.box_translation,
            degrees: self.box_degrees,
            limit: self.limit,
            max_boxes: self.max_boxes,
        };
        Ok(BestFitOptions {
            samples: self.samples,
            sampling: self.sampling.map(Into::into).unwrap_or_default(),
            start: self.from.into(),
            tolerance: self.tolerance,
            relative_tolerance: self.relative_tolerance,
            max_steps: self.max_steps,
            norm: self.norm.into(),
            pairs: self.pairs.as_deref().map_or(Ok(Vec::new()), read_pairs)?,
            datums: self.datum.iter().map(|DatumText(datum)| *datum).collect(),
            zone,
            outliers: self.outliers,
            robust: self.robust.map(Into::into),
            faces_of_a: self.faces_of_a.clone(),
            faces_of_b: self.faces_of_b.clone(),
            max_distance: self.max_distance,
            scale_units: self.placement.scales_units(),
            transform: self.placement.transform()?,
        })
    }

    /// Returns where the distances of the norm are, if on one side, as words behind a zone.
    pub(crate) fn side(&self) -> &'static str {
        match self.norm {
            NormName::Outside => " outside of B",
            NormName::Inside => " inside B",
            _ => "",
        }
    }
}

named!(StartName, FitStart, Any, Given, Axes, Boxes);
named!(NormName, FitNorm, Mean, Largest, Outside, Inside, None);
named!(RobustName, Robust, None, Trimmed, Tukey, GemanMcclure);
