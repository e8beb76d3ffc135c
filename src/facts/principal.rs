//! The principal moments and axes of an interval matrix.

use super::Matrix;
use crate::interval::Interval;
use crate::rounding::gamma;
use crate::sorting::sort_by_number;
use glam::{DMat3, DVec3};

/// The number of sweeps of Jacobi's method: three suffice for three rows, whose entries off the diagonal are
/// squared by each.
const SWEEPS: usize = 12;

/// The roundings of products of three matrices of three rows, relative to the product of their norms.
const PRODUCT_ROUNDINGS: f64 = 64.0;

/// The eigenvalues of a symmetric matrix whose entries are known to be in intervals, ascending.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Principal {
    pub(crate) moments: [Interval; 3],
    /// Unit vectors near the eigenvectors, the largest coordinate of each positive.
    pub(crate) axes: [DVec3; 3],
    /// Upper bounds on the angles between each axis and the eigenvector, in radians; π / 2 where the moments are
    /// not told apart.
    pub(crate) angles: [f64; 3],
}

impl Principal {
    /// Lemma V6 of docs/facts.md.
    pub(crate) fn new(matrix: &Matrix) -> Self {
        let middle = [0, 1, 2].map(|i| [0, 1, 2].map(|j| matrix[i][j].middle()));
        let radius = [0, 1, 2].map(|i| DVec3::from_array([0, 1, 2].map(|j| matrix[i][j].radius())));
        let middle = DMat3::from_cols_array_2d(&middle);
        let spread = norm(&DMat3::from_cols(radius[0], radius[1], radius[2]));
        Self::by_axes(&middle, spread, sorted(jacobi(middle), &middle))
    }

    /// Lemma V6 for any axes: they are near orthogonal unit vectors, and the nearer to eigenvectors the narrower the
    /// intervals. Entries are within a matrix of the norm `spread` of `middle`.
    fn by_axes(middle: &DMat3, spread: f64, axes: [DVec3; 3]) -> Self {
        let q = DMat3::from_cols(axes[0], axes[1], axes[2]);
        let turned = q.transpose() * *middle * q;
        let diagonal = [0, 1, 2].map(|k| turned.col(k)[k]);
        let off = norm(&(turned - DMat3::from_diagonal(DVec3::from_array(diagonal))));
        let size = norm(middle);
        let rounding = gamma(PRODUCT_ROUNDINGS);
        let skew = norm(&(q.transpose() * q - DMat3::IDENTITY)) + rounding;
        let error = (off + rounding * size + 3.0 * skew * size + spread) * (1.0 + rounding);
        let mut sorted = diagonal;
        sorted.sort_unstable_by(f64::total_cmp);
        let moments = sorted.map(|value| Interval::about(value, error));
        let angles = [0, 1, 2].map(|k| {
            let residual = (*middle * axes[k] - diagonal[k] * axes[k]).length();
            let residual = (residual + spread + rounding * size) * (1.0 + 2.0 * skew);
            let others = [moments[(k + 1) % 3], moments[(k + 2) % 3]];
            angle(residual, diagonal[k], others)
        });
        Self { moments, axes, angles }
    }
}

/// Returns an upper bound on the angle between a vector of this residual and an eigenvector, for a value whose
/// distance from the other eigenvalues follows from their intervals.
fn angle(residual: f64, value: f64, others: [Interval; 2]) -> f64 {
    let right = std::f64::consts::FRAC_PI_2;
    let mut largest = 0.0_f64;
    for other in others {
        let [below, above] = [other.lower - value, value - other.upper];
        let distance = if below > above { below } else { above };
        let sine = residual / distance;
        if !(distance > 0.0 && sine < 1.0) {
            return right;
        }
        // asin x <= x π / 2.
        let bound = right * sine;
        largest = if bound > largest { bound } else { largest };
    }
    largest
}

/// Returns the axes in the order of their moments, each with its largest coordinate positive.
fn sorted(axes: DMat3, matrix: &DMat3) -> [DVec3; 3] {
    let mut axes = [axes.col(0), axes.col(1), axes.col(2)];
    sort_by_number(&mut axes, |axis| axis.dot(*matrix * *axis));
    axes.map(|axis| {
        let axis = axis.normalize_or_zero();
        let [x, y, z] = axis.abs().to_array();
        let largest = if x >= y && x >= z {
            axis.x
        } else if y >= z {
            axis.y
        } else {
            axis.z
        };
        if largest < 0.0 { -axis } else { axis }
    })
}

/// Returns vectors near the eigenvectors, by Jacobi's rotations.
fn jacobi(mut matrix: DMat3) -> DMat3 {
    let mut axes = DMat3::IDENTITY;
    for [p, q] in [[0, 1], [1, 2], [0, 2]].into_iter().cycle().take(3 * SWEEPS) {
        let entry = matrix.col(p)[q];
        if entry == 0.0 {
            continue;
        }
        let half = (matrix.col(q)[q] - matrix.col(p)[p]) / (2.0 * entry);
        let tangent = half.signum() / (half.abs() + half.hypot(1.0));
        let cosine = 1.0 / tangent.hypot(1.0);
        let sine = tangent * cosine;
        let mut rotation = DMat3::IDENTITY;
        rotation.col_mut(p)[p] = cosine;
        rotation.col_mut(q)[q] = cosine;
        rotation.col_mut(q)[p] = sine;
        rotation.col_mut(p)[q] = -sine;
        matrix = rotation.transpose() * matrix * rotation;
        axes *= rotation;
    }
    if axes.is_finite() { axes } else { DMat3::IDENTITY }
}

/// Returns Frobenius's norm, which is at least the largest stretch.
fn norm(matrix: &DMat3) -> f64 {
    matrix.to_cols_array().iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    fn about(matrix: DMat3, error: f64) -> Principal {
        let entries = matrix.to_cols_array_2d().map(|row| row.map(|entry| Interval::about(entry, error)));
        Principal::new(&entries)
    }

    /// Eigenvalues 1, 2 and 4 with rational eigenvectors.
    #[test]
    fn the_moments_of_a_turned_diagonal_are_found() {
        let axes = DMat3::from_cols(
            DVec3::new(2.0, -1.0, 2.0) / 3.0,
            DVec3::new(2.0, 2.0, -1.0) / 3.0,
            DVec3::new(-1.0, 2.0, 2.0) / 3.0,
        );
        let matrix = axes * DMat3::from_diagonal(DVec3::new(4.0, 1.0, 2.0)) * axes.transpose();
        let found = about(matrix, 1e-15);
        for (interval, expected) in found.moments.iter().zip([1.0, 2.0, 4.0]) {
            assert!(interval.contains(expected) && interval.width() < 1e-12, "{interval:?}");
        }
        for (k, column) in [(0, 1), (1, 2), (2, 0)] {
            let angle = found.axes[k].dot(axes.col(column)).abs();
            assert!((1.0 - angle) < 1e-14, "{k}: {angle}");
            assert!(found.angles[k] < 1e-12, "{:?}", found.angles);
        }
    }

    /// Of the matrix with 1 on the diagonal and 2 × 2 blocks of e off it, e moves the moments by e.
    #[test]
    fn the_width_of_the_entries_is_that_of_the_moments() {
        let found = about(DMat3::from_diagonal(DVec3::new(1.0, 1.0, 3.0)), 1e-3);
        // [[1, 1e-3], [1e-3, 1]] has the eigenvalues 1 ± 1e-3, and more on the diagonal 1 ± 2e-3.
        assert!(found.moments[0].contains(0.998) && found.moments[0].lower > 0.99);
        assert!(found.angles[0] > 1.57 && found.angles[2] < 4e-3, "{:?}", found.angles);
    }

    /// [[1, e], [e, 1]] has the eigenvalues 1 ± e, and along the coordinate axes both of its moments are 1.
    #[test]
    fn what_is_off_the_diagonal_counts() {
        let off = 1e-3;
        let mut matrix = DMat3::from_diagonal(DVec3::new(1.0, 1.0, 3.0));
        matrix.x_axis.y = off;
        matrix.y_axis.x = off;
        let found = Principal::by_axes(&matrix, 0.0, [DVec3::X, DVec3::Y, DVec3::Z]);
        for (interval, exact) in found.moments.iter().zip([1.0 - off, 1.0 + off, 3.0]) {
            assert!(interval.contains(exact) && interval.width() < 4.0 * off, "{interval:?}");
        }
    }

    /// Axes that are longer by a part have moments that are larger by twice that part.
    #[test]
    fn axes_that_are_no_unit_vectors_count() {
        let [one, two, four] = [1.0, 2.0, 4.0];
        let matrix = DMat3::from_diagonal(DVec3::new(one, two, four));
        let longer = 1.0 + 1e-6;
        let found =
            Principal::by_axes(&matrix, 0.0, [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| longer * axis));
        for (interval, exact) in found.moments.iter().zip([one, two, four]) {
            assert!(interval.contains(exact) && interval.width() < 1e-4, "{interval:?}");
        }
    }

    /// Entries that are off by e turn the axes of moments 1 apart by about e.
    #[test]
    fn the_width_of_the_entries_turns_the_axes() {
        let error = 1e-4;
        let found = about(DMat3::from_diagonal(DVec3::new(1.0, 2.0, 4.0)), error);
        // The eigenvectors of [[1, e], [e, 2]] are turned by atan(2 e) / 2.
        let turned = 0.5 * (2.0 * error).atan();
        assert!(found.angles[0] >= turned && found.angles[0] < 10.0 * error, "{:?}", found.angles);
    }
}
