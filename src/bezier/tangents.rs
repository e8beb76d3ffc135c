//! Tangents of a patch on a grid.

use super::basis::{Basis, fill};
use super::{MAX_ORDER, Patch};
use crate::both::both;
use glam::{DVec3, DVec4, Vec4Swizzles};

/// The Bernstein polynomials in s and t at N parameters.
#[derive(Debug)]
pub(crate) struct GridBasis<const N: usize>([[Basis<MAX_ORDER>; N]; 2]);

impl<const N: usize> GridBasis<N> {
    /// Of these degrees. O(N (p^2 + q^2)).
    pub(crate) fn new(degree: [usize; 2], at: impl Fn(usize) -> f64) -> Self {
        let mut bases = [[[[0.0; MAX_ORDER]; 3]; N]; 2];
        for (bases, degree) in bases.iter_mut().zip(degree) {
            for (index, basis) in bases.iter_mut().enumerate() {
                fill(basis, degree, at(index));
            }
        }
        Self(bases)
    }
}

impl Patch<'_> {
    /// The first derivatives by s and t on the grid of parameters of `basis`,
    /// which must be of the patch's degrees: of the i-th and the j-th in place
    /// `i N + j`, as of [`Patch::jet`]. O(N p q + N^2 p).
    pub(crate) fn tangents<const N: usize>(&self, GridBasis(bases): &GridBasis<N>) -> Vec<[DVec3; 2]> {
        let columns = self.degree[1] + 1;
        let mut tangents = vec![[DVec3::ZERO; 2]; N * N];
        // By row: the point and the derivative by t.
        let mut rows = [[DVec4::ZERO; 2]; MAX_ORDER];
        for (j, in_t) in bases[1].iter().enumerate() {
            for (row, controls) in rows.iter_mut().zip(self.controls.chunks_exact(columns)) {
                *row = both(|order| sum(controls.iter().copied(), &in_t[order]));
            }
            for (i, in_s) in bases[0].iter().enumerate() {
                let along = |order: usize| rows[..=self.degree[0]].iter().map(move |row| row[order]);
                let point = sum(along(0), &in_s[0]);
                let derivatives = [sum(along(0), &in_s[1]), sum(along(1), &in_s[0])];
                let local = point.xyz() / point.w;
                tangents[i * N + j] =
                    both(|axis| (derivatives[axis].xyz() - derivatives[axis].w * local) / point.w);
            }
        }
        tangents
    }
}

fn sum(controls: impl Iterator<Item = DVec4>, basis: &[f64]) -> DVec4 {
    controls.zip(basis).fold(DVec4::ZERO, |sum, (control, &value)| sum + value * control)
}
