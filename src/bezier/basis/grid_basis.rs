//! First derivatives of many patches on one grid of parameters.

use crate::bezier::basis::bernstein::{Basis, fill};
use crate::bezier::patch::evaluate::contract;
use crate::bezier::{MAX_ORDER, Patch};
use glam::{DVec3, DVec4, Vec4Swizzles};

/// The Bernstein polynomials in s and t at N parameters each.
#[derive(Debug)]
pub(crate) struct GridBasis<const N: usize>([[Basis<MAX_ORDER>; N]; 2]);

impl<const N: usize> GridBasis<N> {
    /// Evaluates the polynomials of these degrees at `parameter(0)` to
    /// `parameter(N - 1)` in both directions. O(N (p² + q²)).
    pub(crate) fn new(degree: [usize; 2], parameter: impl Fn(usize) -> f64) -> Self {
        let mut bases = [[[[0.0; MAX_ORDER]; 3]; N]; 2];
        for (bases, degree) in bases.iter_mut().zip(degree) {
            for (index, basis) in bases.iter_mut().enumerate() {
                fill(basis, degree, parameter(index));
            }
        }
        Self(bases)
    }
}

impl Patch<'_> {
    /// Returns the first derivatives by s and t, as [`Patch::jet`] does, on the
    /// grid of `basis`, which must be of the patch's degrees: entry `i N + j`
    /// belongs to the i-th s and the j-th t. O(N p q + N² p).
    pub(crate) fn tangents<const N: usize>(&self, GridBasis(bases): &GridBasis<N>) -> Vec<[DVec3; 2]> {
        let columns = self.degree[1] + 1;
        let mut tangents = vec![[DVec3::ZERO; 2]; N * N];
        // The points and the derivatives by t of every row of controls.
        let mut rows = [[DVec4::ZERO; MAX_ORDER]; 2];
        for (j, in_t) in bases[1].iter().enumerate() {
            for (index, row) in self.controls.chunks_exact(columns).enumerate() {
                for order in 0..2 {
                    rows[order][index] = contract(row, &in_t[order]);
                }
            }
            let [points, derivatives] = rows.each_ref().map(|row| &row[..=self.degree[0]]);
            for (i, in_s) in bases[0].iter().enumerate() {
                let point = contract(points, &in_s[0]);
                let derivatives = [contract(points, &in_s[1]), contract(derivatives, &in_s[0])];
                let local = point.xyz() / point.w;
                tangents[i * N + j] =
                    [0, 1].map(|axis| (derivatives[axis].xyz() - derivatives[axis].w * local) / point.w);
            }
        }
        tangents
    }
}
