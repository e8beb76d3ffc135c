//! One of the two models, and the error of its computed points.

use crate::bvh::Aabb;
use crate::closest::Target;
use crate::model::RigidTransform;
use crate::rounding::{VANISHING_LENGTH, gamma};

/// The roundings of a bound of a pair, relative to the largest length of a control point of
/// both models: lemma C2 of docs/clearance.md.
const BOUND_ROUNDINGS: f64 = 64.0;

/// A model as the search sees it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Body<'a> {
    /// Its patches and their tree.
    pub(crate) target: &'a Target,
    /// A box around the control points of its surfaces and patches.
    pub(crate) control_box: Aabb,
    /// An upper bound on the distance between a computed point and the exact one.
    pub(crate) point_error: f64,
}

impl Body<'_> {
    /// Returns the error that halving a patch so often adds to its control points (lemma R4
    /// of docs/rounding.md).
    fn halving_error(&self, halvings: u32) -> f64 {
        gamma(2.0 * f64::from(halvings) * self.target.max_degree as f64) * self.control_box.diagonal()
    }
}

/// Returns an upper bound on the error of both bounds of a pair of pieces, the one of A moved,
/// after at most `halvings` halvings of each: E of lemma C2.
pub(super) fn pair_error([a, b]: [&Body<'_>; 2], transform: &RigidTransform, halvings: u32) -> f64 {
    let of_a = a.control_box.farthest_from_origin();
    let length = (of_a + transform.offset().length()).max(b.control_box.farthest_from_origin());
    a.point_error
        + b.point_error
        + transform.rounding(of_a)
        + a.halving_error(halvings)
        + b.halving_error(halvings)
        + gamma(BOUND_ROUNDINGS) * length
        + VANISHING_LENGTH
}
