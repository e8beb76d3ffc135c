//! Homogeneous points and first derivatives of a patch on a grid of parameters.

use crate::bezier::basis::bernstein::{Basis, fill};
use crate::bezier::patch::evaluate::contract;
use crate::bezier::{MAX_ORDER, Patch};
use glam::DVec4;

/// The homogeneous point of a patch, `(w (x - center), w)`, with its derivatives by (s, t).
#[derive(Debug, Clone, Copy)]
pub(crate) struct HomogeneousTangents {
    /// The point.
    pub(crate) point: DVec4,
    /// Derivative by s.
    pub(crate) s: DVec4,
    /// Derivative by t.
    pub(crate) t: DVec4,
}

impl Patch<'_> {
    /// Returns the homogeneous points and derivatives at all pairs of these parameters in
    /// [0, 1], the second fastest. O(m n p + n p q) for m and n parameters.
    pub(crate) fn homogeneous_tangents(&self, [in_s, in_t]: [&[f64]; 2]) -> Vec<HomogeneousTangents> {
        let bases = |degree: usize, parameters: &[f64]| -> Vec<Basis<MAX_ORDER>> {
            let basis = |&parameter: &f64| {
                let mut basis = [[0.0; MAX_ORDER]; 3];
                fill(&mut basis, degree, parameter);
                basis
            };
            parameters.iter().map(basis).collect()
        };
        let along_t = bases(self.degree[1], in_t);
        let columns = self.degree[1] + 1;
        // Of every row of controls, the point and the derivative at each t.
        let rows: Vec<Vec<[DVec4; 2]>> = along_t
            .iter()
            .map(|basis| {
                let rows = self.controls.chunks_exact(columns);
                rows.map(|row| [contract(row, &basis[0]), contract(row, &basis[1])]).collect()
            })
            .collect();
        let mut grid = Vec::with_capacity(in_s.len() * in_t.len());
        for basis in bases(self.degree[0], in_s) {
            for rows in &rows {
                let mut sum = HomogeneousTangents { point: DVec4::ZERO, s: DVec4::ZERO, t: DVec4::ZERO };
                for (index, &[point, derivative]) in rows.iter().enumerate() {
                    sum.point += basis[0][index] * point;
                    sum.s += basis[1][index] * point;
                    sum.t += basis[0][index] * derivative;
                }
                grid.push(sum);
            }
        }
        grid
    }
}
