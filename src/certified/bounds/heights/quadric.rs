//! Functions of second and of third order in space.

use crate::certified::rounding::gamma;
use glam::{DMat3, DVec3};

/// Roundings of a norm.
const NORM_ROUNDINGS: f64 = 16.0;

/// The function `l·Y + Y·M Y`, M symmetric.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quadric {
    /// l.
    pub(super) linear: DVec3,
    /// M.
    pub(super) form: DMat3,
}

/// A quadric with `C[Y, Y, Y]` added, C symmetric.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cubic {
    pub(super) quadric: Quadric,
    /// The matrices `C[e_i, ·, ·]`.
    pub(super) forms: [DMat3; 3],
}

impl Quadric {
    /// The function `l·Y`.
    pub(super) fn of_plane(linear: DVec3) -> Self {
        Self { linear, form: DMat3::ZERO }
    }

    /// Its value at a point.
    pub(super) fn at(&self, y: DVec3) -> f64 {
        y.dot(self.linear + self.form * y)
    }

    /// Whether it is linear.
    pub(super) fn is_linear(&self) -> bool {
        self.form == DMat3::ZERO
    }

    /// The Frobenius norm of M, an upper bound on its operator norm and on that of its absolute values.
    pub(super) fn size(&self) -> f64 {
        norm(&[self.form])
    }
}

impl Cubic {
    /// The quadric alone.
    pub(super) fn of(quadric: Quadric) -> Self {
        Self { quadric, forms: [DMat3::ZERO; 3] }
    }

    /// The Frobenius norm of C, an upper bound on its norm and on that of its absolute values.
    pub(super) fn size(&self) -> f64 {
        norm(&self.forms)
    }

    /// The Frobenius norm of `C[n, ·, ·]`.
    pub(super) fn size_along(&self, n: DVec3) -> f64 {
        norm(&[self.forms[0] * n.x + self.forms[1] * n.y + self.forms[2] * n.z])
            + gamma(NORM_ROUNDINGS) * self.size()
    }

    /// The same function with `share (a·Y) (b·Y)` added.
    pub(super) fn add_product(&mut self, share: f64, a: DVec3, b: DVec3) {
        self.quadric.form += symmetric_product(a, b) * share;
    }

    /// The same function with `share (a·Y) (b·Y) (c·Y)` added.
    pub(super) fn add_triple_product(&mut self, share: f64, a: DVec3, b: DVec3, c: DVec3) {
        let [bc, ac, ab] = [symmetric_product(b, c), symmetric_product(a, c), symmetric_product(a, b)];
        for axis in 0..3 {
            self.forms[axis] += (bc * a[axis] + ac * b[axis] + ab * c[axis]) * (share / 3.0);
        }
    }
}

/// The Frobenius norm of a list of matrices.
fn norm(matrices: &[DMat3]) -> f64 {
    let squares = matrices.iter().flat_map(|matrix| [matrix.x_axis, matrix.y_axis, matrix.z_axis]);
    (1.0 + gamma(NORM_ROUNDINGS)) * squares.map(DVec3::length_squared).sum::<f64>().sqrt()
}

/// The symmetric matrix S with `Y·S Y = (a·Y) (b·Y)`.
pub(super) fn symmetric_product(a: DVec3, b: DVec3) -> DMat3 {
    let columns = [0, 1, 2].map(|axis| 0.5 * (b[axis] * a + a[axis] * b));
    DMat3::from_cols(columns[0], columns[1], columns[2])
}
