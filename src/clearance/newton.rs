//! Newton's method for two points, one of a patch each, that are nearest to each other.

use crate::bezier::{Jet, Patch};
use crate::model::RigidTransform;

/// The largest number of steps: a regular pair takes about five.
const MAX_STEPS: usize = 24;

/// The parts of the trace of the Gauss–Newton matrix that are added to its diagonal, one after
/// the other, until a step lowers the distance. The first step is that of the full Hessian.
const DAMPINGS: [Option<f64>; 6] = [None, Some(1e-12), Some(1e-6), Some(1e-3), Some(1e-1), Some(10.0)];

/// The relative decrease of the squared distance below which the iteration ends: further steps
/// gain less than rounding.
const MIN_DECREASE: f64 = 1e-14;

/// Two points by their parameters, with their squared distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pairing {
    /// (s, t) on the patch of A and (u, v) on that of B.
    pub(super) at: [f64; 4],
    pub(super) distance_squared: f64,
}

/// Two patches, the one of A moved.
#[derive(Debug, Clone, Copy)]
pub(super) struct PatchPair<'a> {
    pub(super) a: Patch<'a>,
    pub(super) b: Patch<'a>,
    pub(super) transform: &'a RigidTransform,
}

impl PatchPair<'_> {
    /// Returns the points at these parameters.
    pub(super) fn pairing(&self, at: [f64; 4]) -> Pairing {
        let [s, t, u, v] = at;
        let a = self.transform.apply(self.a.point([s, t]));
        Pairing { at, distance_squared: a.distance_squared(self.b.point([u, v])) }
    }

    /// Brings two points together.
    ///
    /// Guarantee: both lie on the patches, not farther apart than at the start. Steps are those of
    /// Newton where the Hessian is positive definite, else damped steps of Gauss and Newton; a
    /// parameter at the end of its range is kept while the gradient pushes it outwards. O(p q) a step.
    pub(super) fn minimize(&self, start: [f64; 4]) -> Pairing {
        let mut now = self.pairing(start);
        for _ in 0..MAX_STEPS {
            let system = System::new(self, now.at);
            let steps = DAMPINGS.iter().filter_map(|&damping| system.step(now.at, damping));
            let next = steps
                .map(|step| std::array::from_fn(|k| (now.at[k] + step[k]).clamp(0.0, 1.0)))
                .map(|at| self.pairing(at))
                .find(|next| next.distance_squared < now.distance_squared);
            let Some(next) = next else { break };
            let decrease = now.distance_squared - next.distance_squared;
            let is_settled = decrease <= MIN_DECREASE * now.distance_squared;
            now = next;
            if is_settled {
                break;
            }
        }
        now
    }
}

/// Returns the point and the derivatives after a motion.
pub(super) fn moved(jet: &Jet, transform: &RigidTransform) -> Jet {
    let rotate = |vector| transform.rotate(vector);
    Jet {
        point: transform.apply(jet.point),
        s: rotate(jet.s),
        t: rotate(jet.t),
        ss: rotate(jet.ss),
        st: rotate(jet.st),
        tt: rotate(jet.tt),
    }
}

/// Derivatives of half the squared distance by the four parameters.
struct System {
    gradient: [f64; 4],
    /// Products of first derivatives: the Hessian without the curvature of the patches.
    products: [[f64; 4]; 4],
    hessian: [[f64; 4]; 4],
}

impl System {
    fn new(pair: &PatchPair<'_>, [s, t, u, v]: [f64; 4]) -> Self {
        let (a, b) = (moved(&pair.a.jet([s, t]), pair.transform), pair.b.jet([u, v]));
        let residual = a.point - b.point;
        let first = [a.s, a.t, -b.s, -b.t];
        let products = first.map(|row| first.map(|column| row.dot(column)));
        let mut hessian = products;
        for (offset, sign, jet) in [(0, 1.0, &a), (2, -1.0, &b)] {
            let [ss, st, tt] = [jet.ss, jet.st, jet.tt].map(|second| sign * residual.dot(second));
            hessian[offset][offset] += ss;
            hessian[offset][offset + 1] += st;
            hessian[offset + 1][offset] += st;
            hessian[offset + 1][offset + 1] += tt;
        }
        Self { gradient: first.map(|derivative| residual.dot(derivative)), products, hessian }
    }

    /// Returns the step with this damping; `None` where its matrix is not positive definite.
    fn step(&self, at: [f64; 4], damping: Option<f64>) -> Option<[f64; 4]> {
        let mut matrix = if damping.is_some() { self.products } else { self.hessian };
        let trace: f64 = (0..4).map(|k| self.products[k][k]).sum();
        let mut right = self.gradient.map(|derivative| -derivative);
        for k in 0..4 {
            matrix[k][k] += damping.map_or(0.0, |part| part * trace);
            let pushes_out = if right[k] < 0.0 { at[k] <= 0.0 } else { at[k] >= 1.0 };
            if pushes_out || right[k] == 0.0 {
                matrix[k] = [0.0; 4];
                matrix.iter_mut().for_each(|row| row[k] = 0.0);
                (matrix[k][k], right[k]) = (1.0, 0.0);
            }
        }
        solve(matrix, right)
    }
}

/// Solves a symmetric positive definite system by Cholesky's method; `None` for other matrices.
fn solve(mut matrix: [[f64; 4]; 4], mut right: [f64; 4]) -> Option<[f64; 4]> {
    for k in 0..4 {
        for j in 0..k {
            let factor = matrix[k][j];
            for row in &mut matrix[k..] {
                row[k] -= row[j] * factor;
            }
        }
        if !(matrix[k][k] > 0.0) {
            return None;
        }
        let root = matrix[k][k].sqrt();
        for row in &mut matrix[k..] {
            row[k] /= root;
        }
    }
    for k in 0..4 {
        let known: f64 = (0..k).map(|j| matrix[k][j] * right[j]).sum();
        right[k] = (right[k] - known) / matrix[k][k];
    }
    for k in (0..4).rev() {
        let known: f64 = (k + 1..4).map(|j| matrix[j][k] * right[j]).sum();
        right[k] = (right[k] - known) / matrix[k][k];
    }
    right.iter().all(|value| value.is_finite()).then_some(right)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn a_positive_definite_system_is_solved_and_others_are_refused() {
        let rows = [[4.0, 1.0, 0.0, 0.5], [1.0, 3.0, -1.0, 0.0], [0.0, -1.0, 5.0, 1.0], [0.5, 0.0, 1.0, 2.0]];
        let expected = [1.0, -2.0, 0.5, 3.0];
        let right = rows.map(|row| row.iter().zip(expected).map(|(a, b)| a * b).sum::<f64>());
        let found = solve(rows, right).unwrap_or_default();
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?}");
        let mut indefinite = rows;
        indefinite[2][2] = -1.0;
        assert_eq!(solve(indefinite, right), None);
    }
}
