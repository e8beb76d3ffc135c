//! The angle by which a surface turns at an edge.

use super::Faces;
use crate::bvh::Aabb;
use crate::normals::{DISTANCE_ROUNDINGS, Hull, NormalCone};
use crate::rounding::gamma;
use crate::solid::{Arc, Curve, JoinedArc};

/// The number of times that the arc of the other face is halved at most.
const MAX_HALVINGS: u32 = 48;

/// What is known of the angle by which a surface turns at the points of a part of an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sharpness {
    /// It is larger than the permitted one, or the surface ends: a feature edge.
    Sharp,
    /// It is at most that.
    Smooth,
    /// Neither is shown.
    Open,
    /// Neither is shown, as there may be a point without a normal.
    NoNormal,
}

/// A part of an arc: the curve, and the fractions of its ends.
pub(super) struct ArcPart<'a> {
    pub(super) curve: &'a Curve,
    pub(super) range: [f64; 2],
}

/// Returns what is known of a part of an edge (lemma E1 of docs/score.md).
pub(super) fn sharpness(faces: &Faces<'_>, edge: &JoinedArc, part: &ArcPart<'_>, angle: f64) -> Sharpness {
    let Some(other) = &edge.other else { return Sharpness::Sharp };
    let Some(cone) = faces.cone(&edge.one, part.range) else { return Sharpness::NoNormal };
    let Hull { aabb, middle, radius } = hull(part.curve);
    let length = aabb.farthest_from_origin();
    let (_, distance) = other.curve.closest(middle);
    let reach = (distance + radius) * (1.0 + gamma(DISTANCE_ROUNDINGS)) + gamma(DISTANCE_ROUNDINGS) * length;
    let near = Near { faces, other, aabb, radius, reach, cone, is_turned: edge.is_turned };
    let Some([least, most]) = near.turns(&other.curve, [0.0, 1.0], 0) else { return Sharpness::NoNormal };
    if least > angle {
        Sharpness::Sharp
    } else if most <= angle {
        Sharpness::Smooth
    } else {
        Sharpness::Open
    }
}

/// A part of an edge with the arc of the other face.
struct Near<'a> {
    faces: &'a Faces<'a>,
    other: &'a Arc,
    aabb: Aabb,
    radius: f64,
    /// The nearest point of the arc to each point of the part is within this.
    reach: f64,
    cone: NormalCone,
    is_turned: bool,
}

impl Near<'_> {
    /// Returns bounds on the angles between the normals of the part and those of the parts of the arc within reach; `None`
    /// where there may be no normal.
    fn turns(&self, curve: &Curve, range: [f64; 2], depth: u32) -> Option<[f64; 2]> {
        let Hull { aabb, radius, .. } = hull(curve);
        if self.aabb.gap(&aabb).length() > self.reach {
            return Some([f64::INFINITY, f64::NEG_INFINITY]);
        }
        if radius > self.radius && depth < MAX_HALVINGS {
            let [low, high] = curve.split(0.5);
            let middle = 0.5 * (range[0] + range[1]);
            let [one, other] = [
                self.turns(&low, [range[0], middle], depth + 1)?,
                self.turns(&high, [middle, range[1]], depth + 1)?,
            ];
            let least = if one[0] < other[0] { one[0] } else { other[0] };
            let most = if one[1] > other[1] { one[1] } else { other[1] };
            return Some([least, most]);
        }
        Some(self.cone.turns(&self.faces.cone(self.other, range)?, self.is_turned))
    }
}

/// Returns a box and a ball about a curve.
fn hull(curve: &Curve) -> Hull {
    Hull::of(&curve.points().collect::<Vec<_>>())
}
