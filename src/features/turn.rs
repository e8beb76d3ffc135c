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

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::axis::Axis;
    use crate::bezier::{Patch, PatchSet};
    use crate::solid::EdgePlace;
    use glam::{DVec3, DVec4};

    /// The arc of the side t = 0 of a patch of degree 1 × 1.
    fn side(index: u32, controls: &[DVec4; 4]) -> Arc {
        let curve = Curve { center: DVec3::ZERO, controls: vec![controls[0], controls[2]] };
        Arc { place: EdgePlace { index, axis: Axis::V, end: 0 }, range: [0.0, 1.0], curve }
    }

    /// Lemma E1, attained: from the middle of an edge on the x axis the other face's edge, at 45°, has the distance 0, and
    /// from x the nearest point is at x/√2 along it, up to r from the middle. There that face has turned from 0 at its
    /// start by atan(√3 s), by more than 48° where x > 0.83, though by less than 41° on the half of its edge that meets
    /// the x axis.
    #[test]
    fn turns_are_looked_for_as_far_as_the_ends_of_a_piece_have_their_nearest_points() {
        let plane =
            [[-1.0, 0.0], [-1.0, -1.0], [1.0, 0.0], [1.0, -1.0]].map(|[x, y]| DVec4::new(x, y, 0.0, 1.0));
        let along = DVec3::new(1.0, 1.0, 0.0).normalize();
        let across = DVec3::new(1.0, -1.0, 0.0).normalize();
        let steep = DVec3::Z * 3.0_f64.sqrt();
        let [start, end] = [along * -0.72, along * 1.32];
        let twisted = [start, start + across, end, end + across + steep].map(|point| point.extend(1.0));
        let mut patches = PatchSet::default();
        for controls in [&plane, &twisted] {
            patches.push(Patch::whole([1, 1], DVec3::ZERO, controls));
        }
        let faces = Faces::of_patches(&patches);
        let (one, whole) = (side(0, &plane), side(1, &twisted));
        let near_half = Arc { curve: whole.curve.split(0.5)[0].clone(), range: [0.0, 0.5], ..whole.clone() };
        let found = |other: Arc| {
            let edge = JoinedArc { one: one.clone(), other: Some(other), is_turned: false };
            let part = ArcPart { curve: &one.curve, range: one.range };
            sharpness(&faces, &edge, &part, 48.0_f64.to_radians())
        };
        assert_eq!(found(near_half), Sharpness::Smooth);
        assert_eq!(found(whole), Sharpness::Open);
    }
}
