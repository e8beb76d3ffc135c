//! Stage `boxes`: a box around every part of a cell.

use crate::bezier::{DerivativeBounds, Patch};
use crate::bvh::Aabb;
use crate::model::RigidTransform;

/// The part of a cell on one Bézier patch, where second derivatives exist; across
/// a knot line they need not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellPart {
    /// The index of the patch.
    pub patch: usize,
    /// Its interval of s.
    pub s: [f64; 2],
    /// Its interval of t.
    pub t: [f64; 2],
    /// An upper bound, in model units, on the distance of the part from the
    /// triangles through its corners.
    pub growth: f64,
}

/// A factor that exceeds the rounding of the growth.
const ROUNDING_FACTOR: f64 = 1.0 + 1e-12;

impl CellPart {
    /// Returns the part `s` × `t` of patch `index`, whose derivatives have these bounds.
    ///
    /// The growth is `K = (Δs² M_ss + 2 Δs Δt M_st + Δt² M_tt) / 8` (Filip,
    /// Magedson and Markot, *Surface algorithms using bounds on derivatives*,
    /// Computer Aided Geometric Design 3 (1986); the 2011 paper uses it too), or
    /// the diagonal of the patch's box if that is smaller.
    #[must_use]
    pub fn new(index: usize, patch: &Patch<'_>, bounds: &DerivativeBounds, s: [f64; 2], t: [f64; 2]) -> Self {
        let (ds, dt) = (s[1] - s[0], t[1] - t[0]);
        let [ss, st, tt] = bounds.second;
        let growth = 0.125 * (ds * ds * ss + 2.0 * ds * dt * st + dt * dt * tt);
        // `min` replaces NaN, as ∞ · 0 gives, by the diagonal, which is a bound too.
        let growth = (growth * ROUNDING_FACTOR).min(patch.bounding_box().diagonal());
        Self { patch: index, s, t, growth }
    }
}

/// Returns a box that contains the moved part: the box of its four corners, grown
/// on every side by the part's growth and by `margin`, a bound on rounding. O(p q).
#[must_use]
pub fn boxes(patch: &Patch<'_>, part: &CellPart, transform: &RigidTransform, margin: f64) -> Aabb {
    let corner = |index: usize| transform.apply(patch.point([part.s[index / 2], part.t[index % 2]]));
    (0..4).map(corner).fold(Aabb::EMPTY, Aabb::with).grown(part.growth + margin)
}
