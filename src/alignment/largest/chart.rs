//! A box of motions about a pose, in coordinates whose rounding and curvature are bounded.

use crate::alignment::freedoms::{COORDINATES, Coordinates, Freedoms};
use crate::model::RigidTransform;
use crate::rounding::gamma;
use glam::DVec3;

/// The terms of the alternating series of the Jacobian: the next one is below 1e-20 for angles up to 3.
const TERMS: usize = 14;

/// The roundings of a point's image under a motion of the chart, relative to the lengths that enter: the
/// quaternion of a rotation vector is off by 16u, its product with another and the division by its length by 24u
/// more, so that an image is off by 4 · 40u and the 65u of lemma R2; sums take 8u.
const IMAGE_ROUNDINGS: f64 = 1024.0;

/// Motions that follow `base`: x stands for the rotation by the vector v(x) about `center`, then the shift s(x).
#[derive(Debug, Clone)]
pub(crate) struct Chart {
    pub(crate) base: RigidTransform,
    pub(crate) freedoms: Freedoms,
    pub(crate) center: DVec3,
    /// The unit of angles is the inverse of this length.
    pub(crate) radius: f64,
}

/// A box of coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cell {
    pub(crate) middle: Coordinates,
    pub(crate) half: Coordinates,
}

/// The motion in the middle of a cell, with what bounds the others.
pub(super) struct Middle {
    pub(super) motion: RigidTransform,
    /// The image of the centre.
    pub(super) center: DVec3,
    /// Upper bounds on the angle and the shift between the middle and a motion of the cell.
    pub(super) angle: f64,
    pub(super) shift: f64,
    /// An upper bound on the difference between a turn from the middle and the exponential of its linear part (lemma Z1).
    pub(super) twist: f64,
    /// The images of the axes of turns under the Jacobian of the exponential, in units of the radius.
    pub(super) turns: Vec<DVec3>,
    /// The lengths beside a point's own that enter its image.
    lengths: f64,
}

impl Chart {
    /// Returns the motion of coordinates.
    pub(crate) fn motion(&self, coordinates: &Coordinates) -> RigidTransform {
        self.freedoms.followed(&self.base, coordinates, (self.center, self.radius))
    }

    /// Returns the box of turns up to an angle in radians about each axis, and of shifts along each direction.
    pub(crate) fn cell(&self, angle: f64, shift: f64) -> Cell {
        let turns = self.freedoms.turns.len();
        let half = std::array::from_fn(|k| match k {
            _ if k < turns => angle * self.radius,
            _ if k < self.freedoms.count() => shift,
            _ => 0.0,
        });
        Cell { middle: [0.0; COORDINATES], half }
    }

    pub(super) fn middle(&self, cell: &Cell) -> Middle {
        let turns = self.freedoms.turns.len();
        let (vector, shift) = self.freedoms.motion(&cell.middle, self.radius);
        let above = 1.0 + gamma(32.0);
        let length = |of: &[f64]| of.iter().map(|half| half * half).sum::<f64>().sqrt() * above;
        let angle = length(&cell.half[..turns]) / self.radius * above;
        let from_base = vector.length() * above;
        let jacobian = |axis: &DVec3| {
            let [first, second] = series(vector.length_squared());
            let once = vector.cross(*axis);
            (*axis + first * once + second * vector.cross(once)) / self.radius
        };
        Middle {
            motion: self.motion(&cell.middle),
            center: self.center + shift,
            angle,
            shift: length(&cell.half[turns..]),
            twist: from_base * angle * angle * (from_base + angle).exp() / 12.0 * above,
            turns: self.freedoms.turns.iter().map(jacobian).collect(),
            lengths: self.base.offset().length() + 2.0 * self.center.length() + shift.length(),
        }
    }
}

/// Returns (1 − cos θ) / θ² and (θ − sin θ) / θ³ of θ², by their series, which do not cancel.
fn series(square: f64) -> [f64; 2] {
    let (mut first, mut second) = (0.0, 0.0);
    let mut term = 0.5;
    for k in 0..TERMS {
        let next = (2 * k + 3) as f64;
        first += term;
        second += term / next;
        term *= -square / (next * (next + 1.0));
    }
    [first, second]
}

impl Middle {
    /// Returns how fast a point whose image is `image` moves along a unit vector, in each coordinate.
    pub(super) fn slopes(&self, freedoms: &Freedoms, image: DVec3, direction: DVec3) -> Coordinates {
        freedoms.slopes_about(&self.turns, (image - self.center).cross(direction), direction)
    }

    /// Returns an upper bound on the error of the image of a point at this length.
    pub(super) fn rounding(&self, length: f64) -> f64 {
        gamma(IMAGE_ROUNDINGS) * (length + self.lengths)
    }
}

impl Cell {
    /// Returns the corner of the largest coordinates and the opposite one.
    pub(super) fn opposite_corners(&self) -> [Coordinates; 2] {
        [1.0, -1.0].map(|sign| std::array::from_fn(|k| self.middle[k] + sign * self.half[k]))
    }

    /// Returns the coordinate of the longest side.
    pub(super) fn longest(&self) -> usize {
        (1..COORDINATES).fold(0, |best, k| if self.half[k] > self.half[best] { k } else { best })
    }

    /// Returns both halves across the side of a coordinate.
    pub(super) fn halves(&self, axis: usize) -> [Self; 2] {
        let half = 0.5 * self.half[axis];
        [-half, half].map(|off| {
            let mut part = *self;
            part.half[axis] = half;
            part.middle[axis] += off;
            part
        })
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use glam::DQuat;

    fn chart() -> Chart {
        let base = RigidTransform::about(DQuat::from_rotation_x(0.7), DVec3::X, DVec3::Y);
        Chart { base, freedoms: Freedoms::all(), center: DVec3::new(1.0, 2.0, -1.0), radius: 3.0 }
    }

    /// The slopes of a cell beside the base are the derivatives of its motions, which the Jacobian of the
    /// exponential makes them: those of the base would be off by a tenth.
    #[test]
    fn slopes_are_derivatives_and_errors_are_of_second_order() {
        let chart = chart();
        let point = DVec3::new(4.0, -2.0, 5.0);
        let cell = Cell { middle: [0.9, -0.6, 0.3, 0.2, 0.1, -0.4], half: [0.01; COORDINATES] };
        let middle = chart.middle(&cell);
        let image = middle.motion.apply(point);
        let arm = (chart.base.apply(point) - chart.center).length();
        for direction in DVec3::AXES {
            let slopes = middle.slopes(&chart.freedoms, image, direction);
            for axis in 0..COORDINATES {
                let mut at = cell.middle;
                at[axis] += 0.01;
                let moved = (chart.motion(&at).apply(point) - image).dot(direction);
                let error = (moved - 0.01 * slopes[axis]).abs();
                let angle = if axis < 3 { 0.01 / chart.radius } else { 0.0 };
                assert!(error <= (0.5 * angle * angle + middle.twist) * arm + 1e-14, "{axis}: {error}");
            }
        }
    }

    /// A turn from the middle of a cell differs from the exponential of its first order by at most the twist, and by
    /// nearly as much where it is across the turn of the middle.
    #[test]
    fn the_twist_is_attained() {
        let base = RigidTransform::IDENTITY;
        let chart = Chart { base, freedoms: Freedoms::all(), center: DVec3::ZERO, radius: 1.0 };
        let within = |vector: DVec3, step: DVec3| {
            let (mut middle, mut half) = ([0.0; COORDINATES], [0.0; COORDINATES]);
            middle[..3].copy_from_slice(&vector.to_array());
            half[..3].copy_from_slice(&step.abs().to_array());
            let middle = chart.middle(&Cell { middle, half });
            let turn = DQuat::from_scaled_axis(vector + step) * DQuat::from_scaled_axis(-vector);
            let [first, second] = series(vector.length_squared());
            let once = vector.cross(step);
            let exponential = DQuat::from_scaled_axis(step + first * once + second * vector.cross(once));
            let apart = DVec3::AXES.map(|axis| (turn * axis - exponential * axis).length());
            (apart.into_iter().fold(0.0, f64::max), middle.twist)
        };
        let (apart, twist) = within(0.1 * DVec3::X, 0.02 * DVec3::Y);
        assert!(apart <= twist && apart >= 0.85 * twist, "{apart} of {twist}");
        let random = &mut fastrand::Rng::with_seed(3);
        for _ in 0..1000 {
            let [vector, step] =
                [1.0, 0.3].map(|size| size * DVec3::from_array([0; 3].map(|_| random.f64() - 0.5)));
            let (apart, twist) = within(vector, step);
            assert!(apart <= twist + 1e-14, "{apart} of {twist}");
        }
    }

    #[test]
    fn halves_cover_the_cell() {
        let cell = Cell { middle: [0.0; COORDINATES], half: [1.0, 1.0, 4.0, 1.0, 1.0, 0.0] };
        let [low, high] = cell.halves(cell.longest());
        assert_eq!((low.middle[2], high.middle[2], low.half[2]), (-2.0, 2.0, 2.0));
        assert_eq!((low.half[0], low.middle[0]), (1.0, 0.0));
    }

    #[test]
    fn the_series_are_those_of_cosine_and_sine() {
        for angle in [0.3_f64, 1.0, 2.5] {
            let [first, second] = series(angle * angle);
            assert!((first - (1.0 - angle.cos()) / angle.powi(2)).abs() < 1e-15);
            assert!((second - (angle - angle.sin()) / angle.powi(3)).abs() < 1e-15);
        }
        assert_eq!(series(0.0), [0.5, 1.0 / 6.0]);
    }
}
