//! The signs of deviations.

use super::PreparedModel;
use super::prepared::PreparedTarget;
use crate::bezier::Jet;
use crate::closest::Target;
use crate::flatness::Flatness;
use crate::solid::{Boundary, Side};
use glam::DVec3;
use serde::Serialize;
use std::sync::Arc;

/// The sine of the angle between the normal and the direction from a foot up to which the foot
/// counts as one inside a face: the distance to a face is least along its normal. Farther off, the
/// foot is on an edge or a corner, and the normal of one face says nothing.
const MAX_SINE: f64 = 1e-3;

/// The part of the sum of two radii that is used: the sum and the distance of centres are rounded.
const BALL: f64 = 1.0 - 1e-9;

/// What the signs of deviations stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Signs {
    /// Negative inside the solid, positive outside. Where neither is certain, on the boundary and in
    /// its gaps, 0; farther off NaN.
    Solid,
    /// Negative behind the normal of the face that has the foot; NaN where the foot lies on an edge
    /// or a corner and the point not along the normal, or where there is no normal.
    #[default]
    Faces,
}

/// The model from which deviations are measured, with its patches where it is a solid.
pub(super) struct SignSource<'a> {
    solid: Option<(&'a Boundary, Arc<PreparedTarget>)>,
}

/// The same, to be shared by threads.
#[derive(Clone, Copy)]
pub(super) struct SignRule<'a> {
    solid: Option<(&'a Boundary, &'a Target)>,
}

/// The side of the last point, near which the next one may lie.
#[derive(Default)]
pub(super) struct Known(Option<Ball>);

/// A ball without points of the model.
struct Ball {
    center: DVec3,
    radius: f64,
    side: Side,
}

impl<'a> SignSource<'a> {
    /// Joins the model's edges at first use.
    pub(super) fn new(model: &'a PreparedModel) -> Self {
        let boundary = model.boundary();
        Self { solid: boundary.is_closed().then(|| (boundary, model.target(Flatness::None))) }
    }

    pub(super) fn rule(&self) -> SignRule<'_> {
        SignRule { solid: self.solid.as_ref().map(|(boundary, target)| (*boundary, &target.target)) }
    }
}

impl SignRule<'_> {
    /// Returns what the signs stand for.
    pub(super) fn signs(&self) -> Signs {
        if self.solid.is_some() { Signs::Solid } else { Signs::Faces }
    }

    /// Returns the distance of a point with its sign, as [`Signs`] states. `clear` is a lower bound
    /// on the point's distance, `known` belongs to this model.
    pub(super) fn signed(&self, point: DVec3, clear: f64, foot: &Jet, known: &mut Known) -> f64 {
        let distance = point.distance(foot.point);
        let Some((boundary, target)) = self.solid else { return along_normal(point, foot) };
        match side(boundary, target, point, boundary.clear_radius(clear), known) {
            Side::Inside => -distance,
            Side::Outside => distance,
            Side::Undecided if distance <= boundary.reach() => 0.0,
            Side::Undecided => f64::NAN,
        }
    }
}

/// Returns the side of a point about which a ball of this radius has no points of the model.
///
/// The side does not change within a set without points of the boundary, so that balls that overlap
/// have one.
fn side(boundary: &Boundary, target: &Target, point: DVec3, radius: f64, known: &mut Known) -> Side {
    let side = match &known.0 {
        Some(ball) if radius > 0.0 && ball.center.distance(point) < BALL * (ball.radius + radius) => {
            ball.side
        }
        Some(ball) => boundary.side_beside(target, point, (ball.center, ball.side)),
        None => boundary.side(target, point, 0.0),
    };
    if side != Side::Undecided {
        known.0 = Some(Ball { center: point, radius: if radius > 0.0 { radius } else { 0.0 }, side });
    }
    side
}

/// Returns the distance, negative behind the foot's normal, as [`Signs::Faces`] states.
fn along_normal(point: DVec3, foot: &Jet) -> f64 {
    let offset = point - foot.point;
    let Some(normal) = foot.normal() else { return f64::NAN };
    let (distance, along) = (offset.length(), offset.dot(normal));
    let is_along = offset.cross(normal).length() <= MAX_SINE * distance;
    if is_along { distance.copysign(along) } else { f64::NAN }
}
