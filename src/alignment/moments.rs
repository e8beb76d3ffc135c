//! The principal axes of weighted points, and eigenvalues of small symmetric matrices.

use super::Samples;
use crate::sorting::sort_by_number;
use glam::{DMat3, DQuat, DVec3};

/// Sweeps of Jacobi's rotations: each squares what is off the diagonal.
const SWEEPS: usize = 12;

/// The part of the largest spread by which two may differ and still be taken for one another.
const ALIKE: f64 = 0.15;

/// The spread of points along three orthogonal axes.
pub(super) struct Principal {
    /// The rotation that lays x, y, z on the axes.
    pub(super) axes: DQuat,
    /// The variances along them, the largest first.
    pub(super) spreads: [f64; 3],
}

impl Principal {
    /// Returns the principal axes of samples. O(n).
    pub(super) fn of(samples: &Samples) -> Self {
        let mut covariance = [[0.0; 3]; 3];
        for (point, weight) in samples.points.iter().zip(&samples.weights) {
            let arm = (*point - samples.center).to_array();
            for (row, &x) in covariance.iter_mut().zip(&arm) {
                for (entry, &y) in row.iter_mut().zip(&arm) {
                    *entry += weight * x * y;
                }
            }
        }
        let (values, vectors) = eigen(covariance);
        let mut order = [0, 1, 2];
        sort_by_number(&mut order, |&axis| -values[axis]);
        let [x, y] = [0, 1].map(|k| DVec3::from_array([0, 1, 2].map(|row| vectors[row][order[k]])));
        let axes = DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y))).normalize();
        Self { axes, spreads: order.map(|k| values[k]) }
    }

    /// Returns the rotations that lay these axes on those of `other`: the four that keep the order of
    /// the axes, and others between axes of nearly equal spread.
    pub(super) fn onto(&self, other: &Self) -> Vec<DQuat> {
        let largest = self.spreads[0].max(other.spreads[0]);
        let alike = |order: &[usize; 3]| {
            (0..3).all(|k| (self.spreads[k] - other.spreads[order[k]]).abs() <= ALIKE * largest)
        };
        let rotations = right_handed().filter(|(order, _)| *order == [0, 1, 2] || alike(order));
        rotations.map(|(_, turn)| (other.axes * turn * self.axes.inverse()).normalize()).collect()
    }
}

/// Returns the 24 rotations that lay axes on axes, each with the axis of the image of every axis.
pub(super) fn right_handed() -> impl Iterator<Item = ([usize; 3], DQuat)> {
    const ORDERS: [([usize; 3], f64); 6] = [
        ([0, 1, 2], 1.0),
        ([1, 2, 0], 1.0),
        ([2, 0, 1], 1.0),
        ([0, 2, 1], -1.0),
        ([2, 1, 0], -1.0),
        ([1, 0, 2], -1.0),
    ];
    ORDERS.into_iter().flat_map(|(order, parity)| {
        [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].into_iter().map(move |[x, y]| {
            let signs = [x, y, parity * x * y];
            let columns = [0, 1, 2].map(|k| signs[k] * DVec3::AXES[order[k]]);
            let matrix = DMat3::from_cols(columns[0], columns[1], columns[2]);
            (order, DQuat::from_mat3(&matrix).normalize())
        })
    })
}

/// Returns the eigenvalues of a symmetric matrix and its eigenvectors, the columns of the second
/// matrix, by Jacobi's rotations. O(N³) a sweep.
pub(super) fn eigen<const N: usize>(mut matrix: [[f64; N]; N]) -> ([f64; N], [[f64; N]; N]) {
    let mut vectors = [[0.0; N]; N];
    for (k, row) in vectors.iter_mut().enumerate() {
        row[k] = 1.0;
    }
    for _ in 0..SWEEPS {
        for p in 0..N {
            for q in p + 1..N {
                clear(&mut matrix, &mut vectors, p, q);
            }
        }
    }
    (std::array::from_fn(|k| matrix[k][k]), vectors)
}

/// Makes the element p, q of a symmetric matrix 0 by a rotation, which is also applied to `vectors`.
fn clear<const N: usize>(matrix: &mut [[f64; N]; N], vectors: &mut [[f64; N]; N], p: usize, q: usize) {
    let off = matrix[p][q];
    if off == 0.0 {
        return;
    }
    let ratio = (matrix[q][q] - matrix[p][p]) / (2.0 * off);
    let tangent = ratio.signum() / (ratio.abs() + ratio.hypot(1.0));
    let cosine = 1.0 / tangent.hypot(1.0);
    let sine = tangent * cosine;
    let turn = |x: f64, y: f64| (cosine * x - sine * y, sine * x + cosine * y);
    for row in matrix.iter_mut().chain(vectors.iter_mut()) {
        (row[p], row[q]) = turn(row[p], row[q]);
    }
    let columns: [(f64, f64); N] = std::array::from_fn(|column| turn(matrix[p][column], matrix[q][column]));
    matrix[p] = columns.map(|(x, _)| x);
    matrix[q] = columns.map(|(_, y)| y);
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// A rotated diagonal matrix has its entries as eigenvalues.
    #[test]
    fn eigenvalues_are_those_of_the_diagonal_before_a_rotation() {
        let turn = DMat3::from_quat(DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -1.1, 2.0));
        let product = turn * DMat3::from_diagonal(DVec3::new(3.0, 1.0, 0.25)) * turn.transpose();
        let rows = [0, 1, 2].map(|row| product.row(row).to_array());
        let (mut values, _) = eigen(rows);
        values.sort_by(f64::total_cmp);
        for (found, expected) in values.iter().zip([0.25, 1.0, 3.0]) {
            assert!((found - expected).abs() < 1e-14, "{values:?}");
        }
    }

    #[test]
    fn axes_are_laid_on_axes_in_24_ways() {
        let rotations: Vec<DQuat> = right_handed().map(|(_, turn)| turn).collect();
        assert_eq!(rotations.len(), 24);
        for (index, one) in rotations.iter().enumerate() {
            assert!(rotations[..index].iter().all(|other| one.dot(*other).abs() < 0.99));
        }
    }

    #[test]
    fn a_box_of_three_lengths_has_four_poses_and_a_cube_24() {
        let corners = |sides: DVec3| {
            let points: Vec<DVec3> = (0..8)
                .map(|k| sides * DVec3::from_array([0, 1, 2].map(|axis| f64::from(k >> axis & 1))))
                .collect();
            let weights = vec![1.0; 8];
            Principal::of(&Samples::new(points, weights))
        };
        let long = corners(DVec3::new(3.0, 2.0, 1.0));
        assert_eq!(long.onto(&long).len(), 4);
        assert!(long.spreads[0] > long.spreads[1] && long.spreads[1] > long.spreads[2]);
        let cube = corners(DVec3::ONE);
        assert_eq!(cube.onto(&cube).len(), 24);
    }
}
