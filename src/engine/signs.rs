//! The signs of deviations.

use super::PreparedModel;
use super::prepared::{PreparedTarget, Shells};
use crate::closest::{Closest, Target};
use crate::facets::{FacetTarget, Nearest};
use crate::flatness::Flatness;
use crate::pieces::FacePieces;
use crate::solid::{Enclosing, Side, pseudonormal};
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The sine of the angle between the normal and the direction from a foot up to which the foot
/// counts as one inside a face: the distance to a face is least along its normal. Farther off, the
/// foot is on an edge, a corner or the rim, and all faces there count.
const MAX_SINE: f64 = 1e-3;

/// The cosine of the angle between the normal and the direction from a foot below which a point beside
/// the rim has no sign: it is in the tangent plane but for the errors of foot and normal.
const MIN_COSINE: f64 = 1e-6;

/// The part of the sum of two radii that is used: the sum and the distance of centres are rounded.
const BALL: f64 = 1.0 - 1e-9;

/// What the signs of deviations stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Signs {
    /// Negative inside the solid, positive outside. Where neither is certain, on the boundary and in
    /// its gaps, 0; farther off NaN.
    Solid,
    /// Negative behind the normal of the face that has the foot; where the foot lies on an edge, a
    /// corner or the rim, behind the angle-weighted normal of the faces there. NaN where no normal
    /// exists, where those of the faces cancel, and in the tangent plane beside the rim. The faces of
    /// a mesh are its triangles.
    #[default]
    Faces,
}

/// The model from which deviations are measured, with its patches; none of a cloud, nor of a mesh
/// that is not closed or too large to be joined.
pub(super) struct SignSource<'a> {
    pieces: &'a FacePieces,
    source: Option<(Shells<'a>, Arc<PreparedTarget>)>,
    tolerance: f64,
}

/// The same, to be shared by threads.
#[derive(Clone, Copy)]
pub(super) struct SignRule<'a> {
    pieces: &'a FacePieces,
    source: Option<(Shells<'a>, &'a Target)>,
    /// Distances up to it have the sign 0.
    tolerance: f64,
}

/// The closest point of a model.
pub(super) enum SignFoot<'a> {
    /// On a patch of the target.
    Patch(&'a Closest, &'a Target),
    /// On the facet at a place of its tree.
    Facet(&'a FacetTarget, u32, &'a Nearest),
}

impl SignFoot<'_> {
    /// Returns the vector from the foot to the point.
    fn offset(&self, point: DVec3) -> DVec3 {
        match self {
            Self::Patch(closest, _) => point - closest.point,
            Self::Facet(_, _, nearest) => -nearest.offset,
        }
    }
}

/// The shells about the last point, near which the next one may lie.
#[derive(Clone, Default)]
pub(super) struct Known(Option<Ball>);

/// A ball without points of the model.
#[derive(Clone)]
struct Ball {
    center: DVec3,
    radius: f64,
    enclosing: Enclosing,
}

impl<'a> SignSource<'a> {
    /// Joins the model's edges at first use. Distances up to `tolerance` have the sign 0.
    pub(super) fn new(model: &'a PreparedModel, tolerance: f64) -> Self {
        let is_needed = model.facets().is_none_or(|mesh| mesh.may_close() && model.boundary().is_closed());
        let source = is_needed.then(|| (model.sides(), model.target(Flatness::None)));
        Self { pieces: model.pieces(), source, tolerance }
    }

    pub(super) fn rule(&self) -> SignRule<'_> {
        let source = self.source.as_ref().map(|(shells, target)| (*shells, &target.target));
        SignRule { pieces: self.pieces, source, tolerance: self.tolerance }
    }
}

impl SignRule<'_> {
    /// Returns what the signs stand for.
    pub(super) fn signs(&self) -> Signs {
        if self.solid().is_some() { Signs::Solid } else { Signs::Faces }
    }

    /// Returns the shells of the model with its patches, if it is closed.
    fn solid(&self) -> Option<(Shells<'_>, &Target)> {
        self.source.filter(|(shells, _)| shells.boundary.is_closed())
    }

    /// Returns the radius of a ball without points of the boundary about a point, from a lower bound on its distance;
    /// `None` of a model that is not closed.
    pub(super) fn clear_radius(&self, clear: f64) -> Option<f64> {
        self.solid().map(|(shells, _)| shells.boundary.clear_radius(clear))
    }

    /// Returns the side of a point whose distance is not below `clear`; `None` of a model that is not closed. `known`
    /// belongs to this model.
    pub(super) fn side(&self, point: DVec3, clear: f64, known: &mut Known) -> Option<Side> {
        let (shells, target) = self.solid()?;
        Some(side(&shells, target, point, shells.boundary.clear_radius(clear), known))
    }

    /// Returns the distance of a point with its sign, as [`Signs`] states. `clear` is a lower bound
    /// on the point's distance, `known` belongs to this model.
    pub(super) fn signed(&self, point: DVec3, clear: f64, foot: &SignFoot<'_>, known: &mut Known) -> f64 {
        let distance = foot.offset(point).length();
        if distance <= self.tolerance {
            return 0.0;
        }
        let Some((shells, target)) = self.solid() else { return self.along_normal(point, foot) };
        let boundary = shells.boundary;
        // No ray from the boundary itself decides, whichever way it goes.
        if distance <= boundary.margin_at(point) {
            return 0.0;
        }
        let side = side(&shells, target, point, boundary.clear_radius(clear), known);
        with_sign(side, distance, boundary.reach())
    }

    /// Returns the distance, negative behind the normal, as [`Signs::Faces`] states.
    fn along_normal(&self, point: DVec3, foot: &SignFoot<'_>) -> f64 {
        let offset = foot.offset(point);
        let distance = offset.length();
        let normal = match *foot {
            SignFoot::Patch(closest, of_foot) => {
                let patch = of_foot.patches.patch(closest.patch);
                let is_turned = |surface: usize| self.pieces.is_turned(surface);
                let of_face = |normal: DVec3| if is_turned(patch.surface) { -normal } else { normal };
                let is_along = |normal: &DVec3| offset.cross(*normal).length() <= MAX_SINE * distance;
                let of_all = || {
                    let (shells, target) = self.source?;
                    pseudonormal(target, closest.point, shells.boundary.reach(), is_turned)
                };
                patch.jet(closest.parameters).normal().filter(is_along).map(of_face).or_else(of_all)
            }
            SignFoot::Facet(facets, place, nearest) => facets.normal(place, nearest),
        };
        let Some(along) = normal.map(|normal| offset.dot(normal)) else { return f64::NAN };
        if along.abs() >= MIN_COSINE * distance { distance.copysign(along) } else { f64::NAN }
    }
}

/// Returns the distance of a point on this side, as [`Signs::Solid`] states; edges are joined up to
/// `reach`.
fn with_sign(side: Side, distance: f64, reach: f64) -> f64 {
    match side {
        Side::Inside => -distance,
        Side::Outside => distance,
        Side::Undecided if distance <= reach => 0.0,
        Side::Undecided => f64::NAN,
    }
}

/// Returns the side of a point about which a ball of this radius has no points of the model.
///
/// The shells about a point do not change within a set without points of the boundary, so that balls
/// that overlap have the same.
fn side(shells: &Shells<'_>, target: &Target, point: DVec3, radius: f64, known: &mut Known) -> Side {
    let boundary = shells.boundary;
    let enclosing = match &known.0 {
        Some(ball) if radius > 0.0 && ball.center.distance(point) < BALL * (ball.radius + radius) => {
            Some(ball.enclosing.clone())
        }
        Some(ball) => boundary.enclosing_beside(target, point, (ball.center, &ball.enclosing)),
        None => boundary.enclosing(target, point, 0.0),
    };
    let Some(enclosing) = enclosing else { return Side::Undecided };
    let side = shells.side(&enclosing);
    known.0 = Some(Ball { center: point, radius: if radius > 0.0 { radius } else { 0.0 }, enclosing });
    side
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn a_point_without_a_side_is_on_the_boundary_or_has_no_sign() {
        let signed = |side: Side, distance: f64| with_sign(side, distance, 0.25);
        assert_eq!([signed(Side::Inside, 0.5), signed(Side::Outside, 0.5)], [-0.5, 0.5]);
        assert_eq!([signed(Side::Inside, 0.125), signed(Side::Outside, 0.125)], [-0.125, 0.125]);
        assert_eq!(signed(Side::Undecided, 0.25), 0.0);
        assert!(signed(Side::Undecided, 0.26).is_nan());
    }
}
