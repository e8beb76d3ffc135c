//! Closest points: the iterations on one patch, and the certified search over a model.
//!
//! The tangent-plane iteration and the choice of its start are those of I.
//! Hanniel, A. Krishnamurthy and S. McMains, *Computing the Hausdorff distance
//! between NURBS surfaces using numerical iteration on the GPU*, Graphical
//! Models 74 (2012), 255–264, "the 2012 paper" below.

mod branch_and_bound;
mod critical_point;
mod distance_polynomial;
mod initial_guess;
mod located;
mod nearby_patches;
mod newton;
mod separating_plane;
mod tangent_plane;
mod target;

pub use branch_and_bound::{Closest, closest};
pub(crate) use branch_and_bound::{closest_above, closest_beside};
pub use critical_point::CriticalPoint;
pub use distance_polynomial::SquaredDistance;
pub use initial_guess::nearest_control;
pub(crate) use located::{Located, closest_located};
pub(crate) use nearby_patches::{NearbyPatch, NearbyPatches};
pub use newton::newton;
pub(crate) use newton::{MAX_HALVINGS, newton_below};
pub use tangent_plane::{contraction, tangent_plane};
pub use target::Target;

use serde::{Deserialize, Serialize};

/// The way in which the projection of one point on one patch ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[repr(u32)]
#[non_exhaustive]
pub enum Status {
    /// At a stationary point inside the patch.
    Converged = 0,
    /// At the iteration limit, or where no step reduced the distance.
    IterationLimit = 1,
    /// At a stationary point of an edge of the patch; the distance would decrease beyond the edge.
    OnEdge = 2,
}

impl Status {
    /// Returns the status that a kernel wrote as a number; an unknown number counts as not converged.
    #[must_use]
    pub fn from_code(code: u32) -> Self {
        match code {
            0 => Self::Converged,
            2 => Self::OnEdge,
            _ => Self::IterationLimit,
        }
    }
}

/// The point of a patch at which an iteration for a given target ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foot {
    /// (s, t) in [0, 1]².
    pub parameters: [f64; 2],
    /// The squared distance from the target to that point, an upper bound on the
    /// squared distance to the patch.
    pub distance_squared: f64,
    /// The way in which the iteration ended.
    pub status: Status,
}

/// The step that an iteration takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Projection {
    /// The damped Newton step with an active set at the patch's edges.
    #[default]
    Newton,
    /// The 2012 paper's tangent-plane step.
    TangentPlane,
}
