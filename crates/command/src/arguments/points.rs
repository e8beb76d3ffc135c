//! The arguments of the command `closest-points`.

use super::models::motion::{Rotation, Translation};
use super::names::BackendName;
use clap::Args;
use nurbs_hausdorff::{ClosestPointOptions, Result, RigidTransform};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct ClosestPointsArguments {
    /// The model; - is standard input.
    pub(crate) model: PathBuf,
    /// The file of the points: a cloud, a scan, text with three coordinates a line, or a mesh, whose corners they are.
    pub(crate) points: PathBuf,
    /// Writes a line for each point to a CSV file, - for standard output in place of other results: the point as it is
    /// given, the signed distance of its image, the bound of that, the foot and its face.
    #[arg(long, short, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Replaces the output if it is there already.
    #[arg(long, requires = "output")]
    pub(crate) overwrite: bool,
    /// Permitted excess of a distance, in model units.
    #[arg(long, value_name = "LENGTH")]
    tolerance: Option<f64>,
    /// The same as a fraction of the model's diagonal; 1e-9 if neither is given.
    #[arg(long, value_name = "FRACTION")]
    relative_tolerance: Option<f64>,
    /// Distances up to LENGTH have the sign 0, which is then not decided.
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0)]
    sign_tolerance: f64,
    /// The processor that looks for feet; auto is a GPU that is no software, else the CPU.
    #[arg(long, hide_short_help = true, value_enum, default_value_t = BackendName::Cpu)]
    backend: BackendName,
    /// Moves the points before they are measured.
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,0", allow_hyphen_values = true)]
    translate: Translation,
    /// Rotates the points about an axis through the origin, before --translate moves them.
    #[arg(long, value_name = "X,Y,Z,DEGREES", default_value = "0,0,1,0", allow_hyphen_values = true)]
    rotate: Rotation,
    /// Prints the result as one JSON object, with a list for each number of a point.
    #[arg(long)]
    pub(crate) json: bool,
}

impl ClosestPointsArguments {
    /// The library's options, whose ranges it checks.
    ///
    /// # Errors
    /// As [`RigidTransform::new`].
    pub(crate) fn options(&self) -> Result<ClosestPointOptions> {
        Ok(ClosestPointOptions {
            tolerance: self.tolerance,
            relative_tolerance: self.relative_tolerance,
            sign_tolerance: self.sign_tolerance,
            backend: self.backend.into(),
            transform: RigidTransform::new(self.rotate.0, self.translate.0)?,
        })
    }
}
