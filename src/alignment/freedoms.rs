//! The motions that a fit may make: turns about axes through a centre, and shifts.

use crate::model::RigidTransform;
use glam::DVec3;

/// The largest number of coordinates of a motion.
pub(crate) const COORDINATES: usize = 6;

/// A small motion by its coordinates, lengths all: turns first, then shifts; the rest is 0.
pub(crate) type Coordinates = [f64; COORDINATES];

/// Orthonormal axes of turns and directions of shifts, in the frame of B.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Freedoms {
    /// The point that turns keep; `None` where they may be about any, as shifts undo the difference.
    pub(crate) center: Option<DVec3>,
    pub(crate) turns: Vec<DVec3>,
    pub(crate) shifts: Vec<DVec3>,
}

impl Freedoms {
    /// All six.
    pub(crate) fn all() -> Self {
        Self { center: None, turns: DVec3::AXES.to_vec(), shifts: DVec3::AXES.to_vec() }
    }

    /// Returns the point that turns after a motion keep: the one that is given, or the image of the middle of A.
    pub(crate) fn center_of(&self, motion: &RigidTransform, middle: DVec3) -> DVec3 {
        self.center.unwrap_or_else(|| motion.apply(middle))
    }

    /// Returns the number of coordinates.
    pub(crate) fn count(&self) -> usize {
        self.turns.len() + self.shifts.len()
    }

    /// Returns the rotation vector and the shift of coordinates, with angles in units of 1 / radius.
    pub(crate) fn motion(&self, coordinates: &Coordinates, radius: f64) -> (DVec3, DVec3) {
        let (turns, shifts) = coordinates.split_at(self.turns.len());
        let sum = |directions: &[DVec3], lengths: &[f64]| -> DVec3 {
            directions.iter().zip(lengths).map(|(&direction, &length)| length * direction).sum()
        };
        (sum(&self.turns, turns) / radius, sum(&self.shifts, shifts))
    }

    /// Returns how fast a point at `arm` from the centre of turns moves along `direction`, in each coordinate.
    pub(crate) fn slopes(&self, arm: DVec3, radius: f64, direction: DVec3) -> Coordinates {
        self.slopes_about(&self.turns, arm.cross(direction) / radius, direction)
    }

    /// The same by turns about other axes, and by the moment of the direction in units of their lengths.
    pub(super) fn slopes_about(&self, turns: &[DVec3], moment: DVec3, direction: DVec3) -> Coordinates {
        let turns = turns.iter().map(|axis| axis.dot(moment));
        let all = turns.chain(self.shifts.iter().map(|shift| shift.dot(direction)));
        let mut slopes = [0.0; COORDINATES];
        slopes.iter_mut().zip(all).for_each(|(slope, value)| *slope = value);
        slopes
    }

    /// Returns the motion that follows `base` by coordinates, about `center`.
    pub(crate) fn followed(
        &self,
        base: &RigidTransform,
        coordinates: &Coordinates,
        (center, radius): (DVec3, f64),
    ) -> RigidTransform {
        let (vector, shift) = self.motion(coordinates, radius);
        base.followed(vector, center, shift)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// A point at the distance 2 on the x axis that turns about z moves along y by twice the angle: by 1 for a turn of 1
    /// in units of 1 / 2.
    #[test]
    fn slopes_are_movements() {
        let free = Freedoms { center: None, turns: vec![DVec3::Z], shifts: vec![DVec3::X] };
        assert_eq!(free.slopes(2.0 * DVec3::X, 2.0, DVec3::Y), [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(free.slopes(2.0 * DVec3::X, 2.0, DVec3::X), [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
        let (vector, shift) = free.motion(&[0.5, 3.0, 0.0, 0.0, 0.0, 0.0], 2.0);
        assert_eq!((vector, shift), (0.25 * DVec3::Z, 3.0 * DVec3::X));
    }
}
