//! Foot points: the nearest point of a patch, and of a model.

mod branch_and_bound;
mod distance_polynomial;
mod initial_guess;
mod nearby_patches;
mod newton;
mod tangent_plane;
mod target;

pub(crate) use branch_and_bound::closest_above;
pub use branch_and_bound::{Closest, closest};
pub use distance_polynomial::{CriticalPoint, SquaredDistance};
pub use initial_guess::nearest_control;
pub(crate) use nearby_patches::{Candidate, Candidates};
pub use newton::newton;
pub(crate) use newton::{MAX_HALVINGS, newton_below};
pub use tangent_plane::{contraction, tangent_plane};
pub use target::Target;

use serde::Serialize;

/// How the projection of one sample ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[repr(u32)]
pub enum Status {
    /// At a stationary point inside the patch.
    Converged = 0,
    /// At the iteration limit, or where no step made the distance smaller.
    IterationLimit = 1,
    /// At a stationary point of an edge of the patch, with the patch going on nearer outside.
    OnEdge = 2,
}

impl Status {
    /// The status a kernel wrote as a number; unknown numbers are not converged.
    #[must_use]
    pub fn from_code(code: u32) -> Self {
        match code {
            0 => Self::Converged,
            2 => Self::OnEdge,
            _ => Self::IterationLimit,
        }
    }
}

/// A point of a patch that an iteration reached for a given target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foot {
    /// (s, t) in [0, 1]^2.
    pub parameters: [f64; 2],
    /// Squared distance from the target to the patch's point there, so never
    /// less than the squared distance from the target to the patch.
    pub distance_squared: f64,
    /// How the iteration ended.
    pub status: Status,
}

/// The two rules by which a step is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub enum Projection {
    /// Damped Newton with an active set at the patch's edges ([`newton`]).
    #[default]
    Newton,
    /// The 2012 paper's tangent-plane step ([`tangent_plane`]).
    TangentPlane,
}
