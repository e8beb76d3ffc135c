//! The position and the units of two models.

use super::motion::{Rotation, Translation};
use clap::{Args, ValueEnum};
use nurbs_hausdorff::{Result, RigidTransform};
use serde::Deserialize;

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
    /// The unit of A's coordinates, whatever its file states; those of STEP and IGES are millimetres once they are read. B
    /// is scaled to it.
    #[arg(long, value_name = "UNIT", value_enum, hide_short_help = true)]
    pub(crate) unit_of_a: Option<Unit>,
    /// The same of B, which is scaled to the unit of A.
    #[arg(long, value_name = "UNIT", value_enum, hide_short_help = true)]
    pub(crate) unit_of_b: Option<Unit>,
}

impl Placement {
    /// Whether B is scaled to the unit of A: who states a unit wants lengths in it.
    pub(in crate::arguments) fn scales_units(&self) -> bool {
        self.scale_units || self.units.unit_of_a.is_some() || self.units.unit_of_b.is_some()
    }

    /// The motion of A.
    ///
    /// # Errors
    /// As [`RigidTransform::new`].
    pub(in crate::arguments) fn transform(&self) -> Result<RigidTransform> {
        RigidTransform::new(self.rotate.0, self.translate.0)
    }
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
