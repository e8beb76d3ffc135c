//! Stage `boxes`: a box around every part of a cell.

use crate::bezier::{DerivativeBounds, Patch};
use crate::bvh::Aabb;
use crate::model::RigidTransform;

/// The part of a cell on one Bézier patch: where second derivatives exist,
/// which at a knot line they need not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// Index of the patch.
    pub patch: usize,
    /// Its range of s.
    pub s: [f64; 2],
    /// Its range of t.
    pub t: [f64; 2],
    /// How far the part can be from the triangles through its corners, in
    /// model units.
    pub growth: f64,
}

/// Room for the rounding of the growth, relative.
const ROUNDING_ROOM: f64 = 1.0 + 1e-12;

impl Part {
    /// The part s x t of patch `index`, with the bounds of its derivatives.
    ///
    /// The growth is `K = (Δs² M_ss + 2 Δs Δt M_st + Δt² M_tt) / 8` (Filip,
    /// Magedson, Markot 1986, the 2011 paper's too), or the diagonal of the
    /// patch's box where that is less: no two points of it are farther apart.
    #[must_use]
    pub fn new(index: usize, patch: &Patch<'_>, bounds: &DerivativeBounds, s: [f64; 2], t: [f64; 2]) -> Self {
        let (ds, dt) = (s[1] - s[0], t[1] - t[0]);
        let [ss, st, tt] = bounds.second;
        let growth = 0.125 * (ds * ds * ss + 2.0 * ds * dt * st + dt * dt * tt);
        // What is no number, as infinity times 0, gives way to the diagonal.
        let growth = (growth * ROUNDING_ROOM).min(patch.bounding_box().diagonal());
        Self { patch: index, s, t, growth }
    }
}

/// The box of the moved part: that of its four corners, grown on every side
/// by the part's growth and by `slack`, which is for rounding. O(p q).
#[must_use]
pub fn boxes(patch: &Patch<'_>, part: &Part, transform: &RigidTransform, slack: f64) -> Aabb {
    let corner = |index: usize| transform.apply(patch.point([part.s[index / 2], part.t[index % 2]]));
    (0..4).map(corner).fold(Aabb::EMPTY, Aabb::with).grown(part.growth + slack)
}
