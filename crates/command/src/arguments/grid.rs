//! The arguments of the command `grid`.

use super::models::motion::Translation;
use super::names::PrecisionName;
use clap::Args;
use nurbs_hausdorff::{GridOptions, SignedDistanceOptions};
use std::path::PathBuf;
use std::str::FromStr;

#[derive(Debug, Args)]
pub(crate) struct GridArguments {
    /// The model; - is standard input.
    pub(crate) model: PathBuf,
    /// The file to write, of the format that its ending names: .npy, .nrrd or .vti.
    #[arg(long, short, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// The first point; if not given, the box is in the middle of the grid.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    origin: Option<Translation>,
    /// The distance of neighbours along each axis.
    #[arg(long, value_name = "LENGTH")]
    spacing: Option<f64>,
    /// The numbers of points along x, y and z; if not given, the grid reaches two spacings and the band beyond the box.
    #[arg(long, value_name = "NX,NY,NZ")]
    counts: Option<Counts>,
    /// The number of spacings along the longest side of the box, instead of --spacing; 64 if neither is given.
    #[arg(long, value_name = "NUMBER", conflicts_with = "spacing")]
    resolution: Option<u32>,
    /// Measures distances up to LENGTH; those beyond are written as LENGTH with their sign.
    #[arg(long, value_name = "LENGTH")]
    band: Option<f64>,
    /// Permitted excess of a distance, in model units.
    #[arg(long, value_name = "LENGTH")]
    tolerance: Option<f64>,
    /// The same as a fraction of the model's diagonal; 1e-6 if neither is given.
    #[arg(long, value_name = "FRACTION")]
    relative_tolerance: Option<f64>,
    /// The precision of the values in the file.
    #[arg(long, value_enum, default_value_t = PrecisionName::Float32)]
    precision: PrecisionName,
    /// Replaces the output if it is there already.
    #[arg(long)]
    pub(crate) overwrite: bool,
    /// Prints the grid as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

impl GridArguments {
    /// The library's options, whose ranges it checks.
    pub(crate) fn options(&self) -> SignedDistanceOptions {
        SignedDistanceOptions {
            grid: GridOptions {
                origin: self.origin.map(|origin| origin.0.to_array()),
                spacing: self.spacing,
                counts: self.counts.map(|counts| counts.0),
                resolution: self.resolution,
            },
            band: self.band,
            tolerance: self.tolerance,
            relative_tolerance: self.relative_tolerance,
            precision: self.precision.into(),
        }
    }
}

/// `nx,ny,nz`, the numbers of points along the axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Counts(pub(crate) [usize; 3]);

impl FromStr for Counts {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let count = |text: &str| {
            text.trim().parse().map_err(|_| format!("found {text:?}, expected a whole number from 0"))
        };
        let counts: Vec<usize> = text.split(',').map(count).collect::<Result<_, _>>()?;
        let found = counts.len();
        counts.try_into().map(Self).map_err(|_| format!("found {found} numbers, expected 3"))
    }
}
