//! The motion by datums in their order: each takes of the freedoms that those before it leave.

use crate::alignment::freedoms::Freedoms;
use crate::error::{Error, Result};
use crate::limits::is_in_range;
use crate::model::RigidTransform;
use crate::rounding::unit;
use crate::sorting::sort_by_number;
use glam::{DQuat, DVec3};
use serde::Deserialize;

/// The sine below which a direction counts as one that a datum before has taken: coordinates of
/// files agree to more digits, and a smaller angle would move the part by a million of its error.
const SAME_DIRECTION: f64 = 1e-6;

/// A feature of a part that a datum is taken from.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
#[non_exhaustive]
pub enum Feature {
    /// A plane by a point and its outward normal, of any length.
    Plane {
        /// A point on it.
        point: [f64; 3],
        /// Its normal.
        normal: [f64; 3],
    },
    /// An axis by a point and its direction, of any length.
    Axis {
        /// A point on it.
        point: [f64; 3],
        /// Its direction.
        direction: [f64; 3],
    },
    /// A point.
    Point {
        /// Its coordinates.
        point: [f64; 3],
    },
    /// A face, which stands for what [`crate::PreparedModel::face_feature`] returns; of the models of a best
    /// fit only.
    Face {
        /// Its index.
        index: usize,
    },
}

/// A datum of A and that of B on which it belongs; both are of one kind.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Datum {
    /// The feature of A.
    pub a: Feature,
    /// The feature of B.
    pub b: Feature,
}

/// A motion by datums.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DatumFit {
    /// Moves A.
    pub transform: RigidTransform,
    /// The number of freedoms, of six, that each datum took, in their order.
    pub taken: Vec<usize>,
    /// The number of freedoms that are left, in which A keeps its first pose.
    pub free: usize,
}

impl RigidTransform {
    /// Returns the motion that aligns datums of A with those of B in their order. The primary datum is aligned
    /// first; each later one uses only the degrees of freedom that are left. On a free part a plane constrains
    /// two rotations and one translation, an axis two of each, a point three translations. Degrees of freedom
    /// that no datum constrains keep the pose of `given`.
    ///
    /// # Errors
    /// [`Error::OptionInvalid`] for features of two kinds, a direction without length, and coordinates
    /// that are not finite or above 1e100.
    pub fn from_datums(datums: &[Datum], given: &Self) -> Result<DatumFit> {
        Ok(by_datums(datums, given)?.0)
    }
}

/// Returns the motion by datums, with the freedoms that they leave.
///
/// # Errors
/// Those of [`RigidTransform::from_datums`].
pub(crate) fn by_datums(datums: &[Datum], given: &RigidTransform) -> Result<(DatumFit, Freedoms)> {
    let mut state =
        State { motion: *given, turning: Turning::Free, sliding: DVec3::AXES.to_vec(), anchor: None };
    let mut taken = Vec::with_capacity(datums.len());
    for (index, datum) in datums.iter().enumerate() {
        let before = state.freedoms();
        let (a, b) = (Checked::of(index, &datum.a)?, Checked::of(index, &datum.b)?);
        if a.rank != b.rank {
            let found = format!("datum {index} has features of two kinds, expected one");
            return Err(Error::OptionInvalid { found });
        }
        state.turn(&a, &b);
        state.slide(&a, &b);
        taken.push(before - state.freedoms());
    }
    let turns = match state.turning {
        Turning::Free => DVec3::AXES.to_vec(),
        Turning::About(axis) => vec![axis],
        Turning::Fixed => Vec::new(),
    };
    let fit = DatumFit { transform: state.motion, taken, free: state.freedoms() };
    Ok((fit, Freedoms { center: state.anchor, turns, shifts: state.sliding }))
}

/// A feature that was checked: a point, a direction of length 1 (of a point none), and the number of
/// coordinates of the point that count.
struct Checked {
    point: DVec3,
    direction: Option<DVec3>,
    rank: usize,
}

impl Checked {
    fn of(index: usize, feature: &Feature) -> Result<Self> {
        let (point, direction, rank) = match feature {
            Feature::Plane { point, normal } => (point, Some(normal), 1),
            Feature::Axis { point, direction } => (point, Some(direction), 2),
            Feature::Point { point } => (point, None, 3),
            Feature::Face { index: face } => {
                let found =
                    format!("datum {index} is face {face} of no model, expected a plane, an axis or a point");
                return Err(Error::OptionInvalid { found });
            }
        };
        if !point.iter().chain(direction.into_iter().flatten()).all(|&value| is_in_range(value)) {
            let found = format!("datum {index} has a coordinate that is not finite or above 1e100");
            return Err(Error::OptionInvalid { found });
        }
        let direction = direction.map(|direction| unit(DVec3::from_array(*direction)));
        if direction == Some(DVec3::ZERO) {
            let found = format!("datum {index} has a direction of length 0");
            return Err(Error::OptionInvalid { found });
        }
        Ok(Self { point: DVec3::from_array(*point), direction, rank })
    }

    /// Returns the orthogonal directions along which the point counts.
    fn across(&self) -> Vec<DVec3> {
        match self.direction {
            Some(normal) if self.rank == 1 => vec![normal],
            Some(along) => {
                let (one, other) = along.any_orthonormal_pair();
                vec![one, other]
            }
            None => DVec3::AXES.to_vec(),
        }
    }
}

/// The rotations that are left.
#[derive(Clone, Copy, PartialEq)]
enum Turning {
    Free,
    About(DVec3),
    Fixed,
}

/// The motion so far, with the freedoms that are left.
struct State {
    motion: RigidTransform,
    turning: Turning,
    /// Orthonormal directions of the translations that are left.
    sliding: Vec<DVec3>,
    /// The point that rotations keep.
    anchor: Option<DVec3>,
}

impl State {
    fn freedoms(&self) -> usize {
        let turning = match self.turning {
            Turning::Free => 3,
            Turning::About(_) => 1,
            Turning::Fixed => 0,
        };
        turning + self.sliding.len()
    }

    /// Takes rotations: lays the direction of A on that of B. A point has one where translations can no
    /// longer move it: from the point that rotations keep. So has an axis along that of the rotation that is left, as a
    /// second bore beside the first.
    fn turn(&mut self, a: &Checked, b: &Checked) {
        let image = self.motion.apply(a.point);
        let anchor = self.anchor.unwrap_or(image);
        let (from, to) = match (a.direction, b.direction) {
            (Some(of_a), Some(of_b)) if !(a.rank == 2 && self.is_about([self.motion.rotate(of_a), of_b])) => {
                (self.motion.rotate(of_a), of_b)
            }
            _ if self.slides_across() => return,
            _ => (unit(image - anchor), unit(b.point - anchor)),
        };
        if from == DVec3::ZERO || to == DVec3::ZERO {
            return;
        }
        let vector = match self.turning {
            Turning::Free => {
                self.turning = Turning::About(to);
                DQuat::from_rotation_arc(from, to).to_scaled_axis()
            }
            Turning::About(axis) => {
                let [from, to] = [from, to].map(|vector| vector - axis * vector.dot(axis));
                if !(from.length() > SAME_DIRECTION && to.length() > SAME_DIRECTION) {
                    return;
                }
                self.turning = Turning::Fixed;
                axis * axis.dot(from.cross(to)).atan2(from.dot(to))
            }
            Turning::Fixed => return,
        };
        self.motion = self.motion.followed(vector, anchor, DVec3::ZERO);
    }

    /// Returns whether one rotation is left, about an axis along these directions.
    fn is_about(&self, directions: [DVec3; 2]) -> bool {
        let Turning::About(axis) = self.turning else { return false };
        directions.iter().all(|direction| direction.cross(axis).length() <= SAME_DIRECTION)
    }

    /// Returns whether a translation is left across the axis of the rotation that is left.
    fn slides_across(&self) -> bool {
        let axis = match self.turning {
            Turning::Free => DVec3::ZERO,
            Turning::About(axis) => axis,
            Turning::Fixed => return true,
        };
        self.sliding
            .iter()
            .any(|direction| direction.cross(axis).length() > SAME_DIRECTION || axis == DVec3::ZERO)
    }

    /// Takes translations: moves the point of A onto the feature of B along those that are left.
    fn slide(&mut self, a: &Checked, b: &Checked) {
        let before = self.sliding.len();
        for across in b.across() {
            let free: DVec3 = self.sliding.iter().map(|&direction| direction * across.dot(direction)).sum();
            let square = free.length_squared();
            if !(square.sqrt() > SAME_DIRECTION) {
                continue;
            }
            let off = across.dot(b.point - self.motion.apply(a.point));
            self.motion = self.motion.followed(DVec3::ZERO, DVec3::ZERO, free * (off / square));
            self.take(free / square.sqrt());
        }
        if before - self.sliding.len() >= 2 {
            self.anchor = Some(b.point);
        }
    }

    /// Removes a direction, one of the space of those that are left.
    fn take(&mut self, direction: DVec3) {
        let mut left: Vec<DVec3> = Vec::new();
        let count = self.sliding.len() - 1;
        // Those most across the direction first, so that what is dropped is the one along it.
        sort_by_number(&mut self.sliding, |one| one.dot(direction).abs());
        for &known in &self.sliding {
            let mut rest = known - direction * known.dot(direction);
            for &one in &left {
                rest -= one * rest.dot(one);
            }
            if left.len() < count {
                left.push(unit(rest));
            }
        }
        self.sliding = left;
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    const ROUNDING: f64 = 1e-13;

    fn plane(point: [f64; 3], normal: [f64; 3]) -> Feature {
        Feature::Plane { point, normal }
    }

    fn datums(features: &[(Feature, Feature)]) -> Vec<Datum> {
        features.iter().map(|&(a, b)| Datum { a, b }).collect()
    }

    fn fit(features: &[(Feature, Feature)]) -> DatumFit {
        RigidTransform::from_datums(&datums(features), &RigidTransform::IDENTITY).unwrap()
    }

    /// The three sides of a box that was moved, against those of the box.
    #[test]
    fn three_planes_take_three_two_and_one() {
        let axis = DVec3::new(1.0, 2.0, 2.0) / 3.0;
        let pose =
            RigidTransform::new(DQuat::from_axis_angle(axis, 2.5), DVec3::new(4.0, -1.0, 2.0)).unwrap();
        let sides = DVec3::AXES.map(|normal| {
            let point = DVec3::new(1.0, 2.0, 3.0);
            let of_a = plane(pose.apply(point).to_array(), (3.0 * pose.rotate(normal)).to_array());
            (of_a, plane(point.to_array(), normal.to_array()))
        });
        let found = fit(&sides);
        assert_eq!((found.taken.as_slice(), found.free), ([3, 2, 1].as_slice(), 0));
        for corner in [DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0), DVec3::X * 5.0] {
            assert!(found.transform.apply(pose.apply(corner)).distance(corner) < 50.0 * ROUNDING);
        }
    }

    /// Two sides at 90° on B, of A at 90° - 0.1: the primary one is laid on its side exactly, and the
    /// other one is off by the angle; in the other order, the other way round.
    #[test]
    fn the_order_of_datums_changes_the_pose_as_it_should() {
        let lean = 0.1_f64;
        let floor = (plane([0.0; 3], [0.0, 0.0, 1.0]), plane([0.0; 3], [0.0, 0.0, 1.0]));
        let wall = (plane([0.0; 3], [lean.cos(), 0.0, lean.sin()]), plane([0.0; 3], [1.0, 0.0, 0.0]));
        let angles = |found: &DatumFit| {
            [(DVec3::Z, DVec3::Z), (DVec3::new(lean.cos(), 0.0, lean.sin()), DVec3::X)]
                .map(|(of_a, of_b)| found.transform.rotate(of_a).angle_between(of_b))
        };
        let first = angles(&fit(&[floor, wall]));
        assert!(first[0] < 1e-7 && (first[1] - lean).abs() < 1e-7, "{first:?}");
        let second = angles(&fit(&[wall, floor]));
        assert!((second[0] - lean).abs() < 1e-7 && second[1] < 1e-7, "{second:?}");
    }

    /// A plate: its floor, a bore, and a second bore that only turns it.
    #[test]
    fn a_plane_a_bore_and_a_slot_take_three_two_and_one() {
        let pose =
            RigidTransform::new(DQuat::from_axis_angle(DVec3::Z, 0.4), DVec3::new(1.0, 2.0, 3.0)).unwrap();
        let up = [0.0, 0.0, 1.0];
        let at = |point: DVec3| pose.apply(point).to_array();
        let floor = (plane(at(DVec3::ZERO), up), plane([0.0; 3], up));
        let bore = |x: f64, height: f64, wider: f64| {
            let of_a = Feature::Axis { point: at(DVec3::new(x + wider, 1.0, height)), direction: up };
            (of_a, Feature::Axis { point: [x, 1.0, 0.0], direction: up })
        };
        // A's second bore is farther off than B's: only its direction from the first one counts.
        let point = |(a, b): (Feature, Feature)| {
            let of = |feature| match feature {
                Feature::Axis { point, .. } => Feature::Point { point },
                other => other,
            };
            (of(a), of(b))
        };
        for second in [point(bore(5.0, 0.0, 0.2)), bore(5.0, 0.7, 0.2)] {
            let found = fit(&[floor, bore(1.0, 0.3, 0.0), second]);
            assert_eq!((found.taken.as_slice(), found.free), ([3, 2, 1].as_slice(), 0));
            for corner in [DVec3::ZERO, DVec3::new(5.0, 1.0, 0.0)] {
                assert!(found.transform.apply(pose.apply(corner)).distance(corner) < 100.0 * ROUNDING);
            }
        }
        // Bores alone leave the shift along them; the same bore again takes nothing.
        assert_eq!(fit(&[bore(1.0, 0.3, 0.0), bore(5.0, 0.0, 0.0)]).taken, [4, 1]);
        assert_eq!(fit(&[floor, bore(1.0, 0.3, 0.0), bore(1.0, 0.0, 0.0)]).taken, [3, 2, 0]);
    }

    #[test]
    fn what_no_datum_takes_stays_free_and_as_it_was() {
        let ball = |x: f64| Feature::Point { point: [x, 0.0, 0.0] };
        let found = fit(&[(ball(1.0), ball(4.0))]);
        assert_eq!((found.taken.as_slice(), found.free), ([3].as_slice(), 3));
        assert_eq!(found.transform.apply(DVec3::new(1.0, 5.0, 0.0)), DVec3::new(4.0, 5.0, 0.0));
        // A second point turns the part about the first one; a third one on their line takes nothing.
        let aside = Feature::Point { point: [4.0, 2.0, 0.0] };
        let found = fit(&[(ball(1.0), ball(4.0)), (ball(2.0), aside), (ball(3.0), aside)]);
        assert_eq!((found.taken.as_slice(), found.free), ([3, 2, 0].as_slice(), 1));
        assert!(found.transform.apply(DVec3::X * 2.0).distance(DVec3::new(4.0, 1.0, 0.0)) < ROUNDING);
        // The same plane twice takes nothing more.
        let floor = (plane([0.0; 3], [0.0, 0.0, 1.0]), plane([0.0, 0.0, 2.0], [0.0, 0.0, 1.0]));
        assert_eq!(fit(&[floor, floor]).taken, [3, 0]);
    }

    #[test]
    fn features_of_two_kinds_and_directions_without_length_are_refused() {
        let ball = Feature::Point { point: [0.0; 3] };
        for pair in [
            (ball, plane([0.0; 3], [0.0, 0.0, 1.0])),
            (plane([0.0; 3], [0.0; 3]), plane([0.0; 3], [0.0, 0.0, 1.0])),
            (Feature::Point { point: [f64::NAN, 0.0, 0.0] }, ball),
            (Feature::Face { index: 0 }, Feature::Face { index: 0 }),
        ] {
            let refused = RigidTransform::from_datums(&datums(&[pair]), &RigidTransform::IDENTITY);
            assert_eq!(refused.map_err(|error| error.code()), Err("OPTION_INVALID"));
        }
    }
}
