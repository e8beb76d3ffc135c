//! The linear least-squares problem of one step: three unknowns of a shift, three of a rotation.

use crate::alignment::field::Residual;
use crate::alignment::freedoms::{COORDINATES as UNKNOWNS, Coordinates, Freedoms};
use crate::alignment::moments::eigen;
use glam::DVec3;

/// The part of the largest eigenvalue below which a motion changes no residual: the square of the
/// part of a length by which a smooth motion along a symmetric part moves off it, with the errors of
/// directions.
const FREE: f64 = 1e-6;

/// The sum of weighted squares at one pose, linearised in a shift s and a rotation vector v about c:
/// a point p at the distance r from its foot in the direction u has the distance
/// r + u · (s + v × (p - c)), exact to first order, as the foot moves orthogonally to u.
pub(super) struct System<'a> {
    freedoms: &'a Freedoms,
    center: DVec3,
    /// The unit of angles is the inverse of this length.
    radius: f64,
    matrix: [[f64; UNKNOWNS]; UNKNOWNS],
    gradient: Coordinates,
}

/// A shift, a rotation vector in radians, and the decrease that the gradient alone predicts.
pub(super) struct Motion {
    pub(super) shift: DVec3,
    pub(super) vector: DVec3,
    pub(super) gain: f64,
}

impl<'a> System<'a> {
    /// Starts a problem about a centre, with angles in units of 1 / radius.
    pub(super) fn new(freedoms: &'a Freedoms, center: DVec3, radius: f64) -> Self {
        Self { freedoms, center, radius, matrix: [[0.0; UNKNOWNS]; UNKNOWNS], gradient: [0.0; UNKNOWNS] }
    }

    /// Adds a residual: one row, or three of a foot that is a point.
    pub(super) fn add(&mut self, residual: &Residual, weight: f64) {
        if weight == 0.0 {
            return;
        }
        match residual.direction {
            Some(direction) => self.add_row(residual, direction, weight),
            None => DVec3::AXES.into_iter().for_each(|axis| self.add_row(residual, axis, weight)),
        }
    }

    fn add_row(&mut self, residual: &Residual, direction: DVec3, weight: f64) {
        let row = self.freedoms.slopes(residual.point - self.center, self.radius, direction);
        let distance = residual.offset.dot(direction);
        for (i, entries) in self.matrix.iter_mut().enumerate() {
            let scaled = weight * row[i];
            self.gradient[i] += scaled * distance;
            for (entry, value) in entries.iter_mut().zip(row) {
                *entry += scaled * value;
            }
        }
    }

    /// Returns the step that minimises the linearised sum with `damping` times the squared step
    /// added, by Cholesky's decomposition: every pivot of a positive semidefinite matrix with
    /// `damping` on its diagonal is at least `damping`. Coordinates that are no freedom stay 0.
    pub(super) fn step(&self, damping: f64) -> Motion {
        let mut lower = [[0.0; UNKNOWNS]; UNKNOWNS];
        for i in 0..UNKNOWNS {
            for j in 0..=i {
                let known: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
                let rest = self.matrix[i][j] - known;
                lower[i][j] = if i == j { (rest + damping).max(damping).sqrt() } else { rest / lower[j][j] };
            }
        }
        let mut step = self.gradient.map(|value| -value);
        for i in 0..UNKNOWNS {
            let known: f64 = (0..i).map(|k| lower[i][k] * step[k]).sum();
            step[i] = (step[i] - known) / lower[i][i];
        }
        for i in (0..UNKNOWNS).rev() {
            let known: f64 = (i + 1..UNKNOWNS).map(|k| lower[k][i] * step[k]).sum();
            step[i] = (step[i] - known) / lower[i][i];
        }
        let gain = step.iter().zip(self.gradient).map(|(value, slope)| -value * slope).sum();
        let (vector, shift) = self.freedoms.motion(&step, self.radius);
        Motion { shift, vector, gain }
    }

    /// Returns the number of independent motions, of those that are free, that change no residual to first order.
    pub(super) fn freedoms(&self) -> usize {
        let (values, _) = eigen(self.matrix);
        let largest = values.into_iter().fold(0.0, f64::max);
        let still = values.into_iter().filter(|&value| !(value > FREE * largest)).count();
        still - (UNKNOWNS - self.freedoms.count())
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    fn plane_samples(height: f64) -> Vec<Residual> {
        (0..25)
            .map(|k| {
                let point = DVec3::new(f64::from(k % 5), f64::from(k / 5), height);
                Residual { point, offset: DVec3::Z * height, direction: Some(DVec3::Z) }
            })
            .collect()
    }

    #[test]
    fn one_step_lays_a_plane_on_a_plane_and_leaves_three_motions_free() {
        let free = Freedoms::all();
        let mut system = System::new(&free, DVec3::new(2.0, 2.0, 3.0), 2.0);
        plane_samples(3.0).iter().for_each(|residual| system.add(residual, 0.04));
        let motion = system.step(1e-12);
        assert!((motion.shift - DVec3::Z * -3.0).length() < 1e-9, "{:?}", motion.shift);
        assert!(motion.vector.length() < 1e-9);
        // The gain is twice the decrease of half the square: 9.
        assert!((motion.gain - 9.0).abs() < 1e-9);
        assert_eq!(system.freedoms(), 3);
    }

    /// On a ball every direction passes the centre.
    #[test]
    fn a_ball_turns_freely() {
        let free = Freedoms::all();
        let mut system = System::new(&free, DVec3::ZERO, 1.0);
        for (_, turn) in crate::alignment::moments::right_handed() {
            let point = turn * DVec3::new(1.0, 2.0, 2.0);
            let residual = Residual { point, offset: 0.1 * point, direction: Some(point / 3.0) };
            system.add(&residual, 1.0 / 24.0);
        }
        assert_eq!(system.freedoms(), 3);
    }
}
