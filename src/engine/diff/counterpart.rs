//! Round faces that changed, and those of the other model that they became: resized, moved, or both.

use super::{DiffOptions, DiffResult, FaceDifference, FaceState};
use crate::bvh::Aabb;
use crate::carrier::FaceForm;
use crate::engine::PreparedModel;
use crate::interval::Interval;
use crate::model::RigidTransform;
use glam::DVec3;
use serde::Serialize;

/// What became of a round face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub enum FaceChange {
    /// The radii certainly differ by more than the limit, and the centre or the axis is within it of the other one.
    Resized,
    /// The centre or the axis is farther than the limit from the other one, and the radii are not known to differ by more.
    Moved,
    /// Both.
    ResizedAndMoved,
}

/// The face of the other model that a round face is taken to have become. Both changed and lie on a sphere, a cylinder or
/// a torus, and of all such faces the box of each is the nearest to that of the other.
///
/// Which two faces belong together is a guess; what is said of the two is certain as in [`FaceForm`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct FaceCounterpart {
    /// The index of the face in the other model.
    pub face: usize,
    /// What differs.
    pub change: FaceChange,
    /// The radius of this face: of a torus that of the tube.
    pub radius: Interval,
    /// The radius of the other face, in the same unit.
    pub other_radius: Interval,
    /// The way from A's centre, after the transform, to that of B; of cylinders across the axis, from A's to B's.
    pub shift: [f64; 3],
}

/// Says of changed round faces which faces of the other model they became. O(changed²), and their forms.
pub(super) fn pair_round_faces(
    result: &mut DiffResult,
    [a, b]: [&PreparedModel; 2],
    &DiffOptions { limit, transform, .. }: &DiffOptions,
) {
    let of_a = round_faces(a, &result.faces_of_a, &transform);
    let of_b = round_faces(b, &result.faces_of_b, &RigidTransform::IDENTITY);
    for one in &of_a {
        let Some(other) = nearest(one, &of_b, limit) else { continue };
        if nearest(other, &of_a, limit).is_none_or(|back| back.face != one.face) {
            continue;
        }
        let Some((shift, change)) = one.change(other, limit) else { continue };
        let counterpart = |own: &Round, other: &Round| FaceCounterpart {
            face: other.face,
            change,
            radius: own.radius,
            other_radius: other.radius,
            shift: shift.to_array(),
        };
        result.faces_of_a[one.face].counterpart = Some(counterpart(one, other));
        result.faces_of_b[other.face].counterpart = Some(counterpart(other, one));
    }
}

/// A changed face that lies on a sphere, a cylinder or a torus.
struct Round {
    face: usize,
    /// The centre, or a point of the axis.
    point: DVec3,
    /// The direction of the axis; 0 of a sphere.
    direction: DVec3,
    radius: Interval,
    /// The radius of a torus' circle, 0 of others.
    major_radius: f64,
    /// Whether the point may be anywhere on the axis.
    is_cylinder: bool,
    /// The middle of its box, and the length of the diagonal.
    middle: DVec3,
    size: f64,
}

fn round_faces(model: &PreparedModel, faces: &[FaceDifference], transform: &RigidTransform) -> Vec<Round> {
    let Some(source) = model.source() else { return Vec::new() };
    let changed = faces.iter().filter(|face| face.state == FaceState::Changed);
    changed
        .filter_map(|&FaceDifference { face, .. }| {
            let form = FaceForm::of(source.surfaces().get(face)?)?;
            let (point, direction, radius, major_radius) = match form {
                FaceForm::Sphere { point, radius } => (point, [0.0; 3], radius, 0.0),
                FaceForm::Cylinder { point, direction, radius } => (point, direction, radius, 0.0),
                FaceForm::Torus { point, direction, major_radius, radius } => {
                    (point, direction, radius, major_radius)
                }
                FaceForm::Plane { .. } | FaceForm::Cone { .. } => return None,
            };
            let pieces = model.pieces().faces()[face].clone();
            let aabb = pieces.map(|piece| model.box_of_piece(piece)).fold(Aabb::EMPTY, Aabb::union);
            Some(Round {
                face,
                point: transform.apply(DVec3::from_array(point)),
                direction: transform.rotate(DVec3::from_array(direction)),
                radius,
                major_radius,
                is_cylinder: matches!(form, FaceForm::Cylinder { .. }),
                middle: transform.apply(aabb.center()),
                size: aabb.diagonal(),
            })
        })
        .collect()
}

/// Returns the face of the same kind, with a parallel axis, whose box is nearest.
fn nearest<'a>(one: &Round, others: &'a [Round], limit: f64) -> Option<&'a Round> {
    let away = |other: &&Round| one.middle.distance_squared(other.middle);
    others.iter().filter(|other| one.is_like(other, limit)).min_by(|p, q| away(p).total_cmp(&away(q)))
}

impl Round {
    /// Returns whether both are of one kind, and their axes as good as parallel along the faces.
    fn is_like(&self, other: &Self, limit: f64) -> bool {
        let size = if self.size > other.size { self.size } else { other.size };
        self.is_cylinder == other.is_cylinder
            && (self.direction == DVec3::ZERO) == (other.direction == DVec3::ZERO)
            && (self.major_radius - other.major_radius).abs() <= limit
            && self.direction.cross(other.direction).length() * size <= limit
    }

    /// Returns the way from the centre or the axis of a face of A to that of B, and what differs; `None` if nothing
    /// does that is certain.
    fn change(&self, other: &Self, limit: f64) -> Option<(DVec3, FaceChange)> {
        let way = other.point - self.point;
        let shift = if self.is_cylinder { way - self.direction * self.direction.dot(way) } else { way };
        let is_moved = shift.length() > limit;
        let [more, less] = [other.radius - self.radius, self.radius - other.radius];
        let is_resized = more.lower > limit || less.lower > limit;
        let change = match (is_resized, is_moved) {
            (true, false) => FaceChange::Resized,
            (false, true) => FaceChange::Moved,
            (true, true) => FaceChange::ResizedAndMoved,
            (false, false) => return None,
        };
        Some((shift, change))
    }
}

#[cfg(all(test, feature = "shapes", not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::engine::Engine;
    use crate::model::Model;
    use crate::shapes::operations::transformed;
    use crate::shapes::{cylinder, sphere};
    use glam::DQuat;

    const SHIFT: DVec3 = DVec3::new(0.2, 0.0, 0.1);

    fn moved(model: &Model, by: DVec3) -> Model {
        transformed(model, &RigidTransform::new(DQuat::IDENTITY, by).unwrap()).unwrap()
    }

    /// What became of the faces of A that have a counterpart; that of B says the same the other way round.
    fn became(a: &Model, b: &Model, options: &DiffOptions) -> Vec<FaceCounterpart> {
        let [a, b] = [a, b].map(|model| PreparedModel::new(model).unwrap());
        let result = Engine::cpu().diff(&a, &b, options).wait().unwrap();
        let found = result.faces_of_a.iter().filter_map(|face| Some((face.face, face.counterpart?)));
        found
            .map(|(face, found)| {
                let back = result.faces_of_b[found.face].counterpart.unwrap();
                let expected =
                    FaceCounterpart { face, radius: found.other_radius, other_radius: found.radius, ..found };
                assert_eq!(back, expected);
                found
            })
            .collect()
    }

    fn assert_is(found: &FaceCounterpart, change: FaceChange, radii: [f64; 2], shift: DVec3) {
        assert_eq!(found.change, change);
        for (interval, radius) in [found.radius, found.other_radius].into_iter().zip(radii) {
            assert!(interval.contains(radius) && interval.width() < 1e-10, "{found:?} for {radius}");
        }
        assert!(DVec3::from_array(found.shift).distance(shift) < 1e-10, "{found:?} for {shift}");
    }

    #[test]
    fn a_wall_with_another_radius_is_resized_and_one_elsewhere_moved() {
        let (one, other) = (cylinder(1.5, 3.0).unwrap(), cylinder(1.625, 3.0).unwrap());
        let options = DiffOptions::default();
        // A cylinder is the same after a motion along its axis.
        let across = DVec3::X * SHIFT.x;
        for (b, change, radius, shift) in [
            (other.clone(), FaceChange::Resized, 1.625, DVec3::ZERO),
            (moved(&one, SHIFT), FaceChange::Moved, 1.5, across),
            (moved(&other, SHIFT), FaceChange::ResizedAndMoved, 1.625, across),
        ] {
            let found = became(&one, &b, &options);
            assert!(!found.is_empty(), "{change:?}");
            found.iter().for_each(|one| assert_is(one, change, [1.5, radius], shift));
            let back = became(&b, &one, &options);
            back.iter().for_each(|one| assert_is(one, change, [radius, 1.5], -shift));
            assert_eq!(back.len(), found.len());
        }
    }

    /// A is compared after its transform.
    #[test]
    fn the_shift_of_a_ball_is_that_after_the_transform() {
        let ball = sphere(DVec3::ZERO, 2.0).unwrap();
        let transform = RigidTransform::new(DQuat::from_rotation_z(0.5), DVec3::X).unwrap();
        let options = DiffOptions { transform, ..DiffOptions::default() };
        let found = became(&ball, &moved(&ball, SHIFT), &options);
        assert!(!found.is_empty());
        found.iter().for_each(|one| assert_is(one, FaceChange::Moved, [2.0; 2], SHIFT - DVec3::X));
    }

    #[test]
    fn a_wall_that_is_longer_and_one_about_another_axis_have_none() {
        let wall = cylinder(1.5, 3.0).unwrap();
        let turn = DQuat::from_rotation_x(0.5);
        let turned = transformed(&wall, &RigidTransform::new(turn, DVec3::ZERO).unwrap()).unwrap();
        assert_eq!(became(&wall, &turned, &DiffOptions::default()), []);
        let found =
            became(&cylinder(1.5, 3.0).unwrap(), &cylinder(1.5, 3.5).unwrap(), &DiffOptions::default());
        assert_eq!(found, []);
    }
}
