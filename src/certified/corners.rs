//! A bound for cells whose nearest patch changes inside.
//!
//! Lemma. Let the vertices x_k of a convex polygon of a cell have feet b_k on
//! one and the same patch P. Then every point of the polygon is within
//! `max |a_k - b_k| + δ_A + δ_B` of P, with
//! `δ = ⅛ (Δ_u² M_uu + 2 Δ_u Δ_v M_uv + Δ_v² M_vv)` over the cell, and over the
//! (u, v) box of the feet.
//!
//! Proof. Write x = Σ λ_k x_k. A(x) differs from Σ λ_k a_k by at most δ_A, and
//! the point of P at Σ λ_k (u, v)_k from Σ λ_k b_k by at most δ_B (the error of
//! linear interpolation over a polygon of these extents); and
//! |Σ λ_k (a_k - b_k)| is at most the largest |a_k - b_k|. ∎
//!
//! A cell whose corners prefer two patches is cut in two polygons where both
//! are about equally near. That is second order for any kind of join, with no
//! knowledge of how the patches meet.

use super::Operand;
use super::feet::{Foot, Sample};
use super::nearest::{foot_on, nearest_within};
use super::region::Cell;
use crate::bezier::{DerivativeBounds, Patch};
use crate::model::RigidTransform;
use glam::DVec3;

/// Secant steps towards the place where two patches are equally near. Where
/// they stop is as valid as any place.
const SECANT_STEPS: usize = 6;

/// Part of δ_A that two distances may differ by for more steps to be of no use.
const CLOSE: f64 = 0.05;

/// Part of the bracket that a secant step takes at least, so that the bracket shrinks.
const MIN_STEP: f64 = 1e-3;

/// The cell's corners in [-1, 1]^2, around it.
const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// A place of a polygon's vertex in [-1, 1]^2, with feet on both patches.
type Vertex = ([f64; 2], [Foot; 2]);

/// The moved patch of A that the cell lies on, against B.
pub(super) struct Corners<'a> {
    pub(super) cell: Cell,
    pub(super) patch: Patch<'a>,
    pub(super) bounds: &'a DerivativeBounds,
    pub(super) transform: &'a RigidTransform,
    pub(super) b: &'a Operand<'a>,
}

impl Corners<'_> {
    /// Whether the bound can be expected to be at most `prune_threshold`, given the
    /// foot of a corner, than which it is at least δ_A more, or that of the
    /// centre, than which the farthest corner is seldom much nearer.
    pub(super) fn may_suffice(&self, foot: &Foot, prune_threshold: f64) -> bool {
        foot.distance() + self.of_cell() <= prune_threshold
    }

    /// The lemma's bound, or infinity where feet are taken on more than two
    /// patches or a corner is too far for `prune_threshold`; the farthest point met goes
    /// to `farthest`.
    ///
    /// Feet are valid on any patch, so none is looked for while one is near enough.
    pub(super) fn bound(&self, center: &Foot, prune_threshold: f64, farthest: &mut Sample) -> f64 {
        let mut own = CORNERS.map(|corner| self.foot(corner, center));
        let mut other: Option<Foot> = None;
        for (&corner, own) in CORNERS.iter().zip(&mut own) {
            let mut foot = other.map_or(*own, |other| nearer(*own, self.foot(corner, &other)));
            if !self.may_suffice(&foot, prune_threshold) {
                foot = nearest_within(self.b, self.point(corner), foot, 0.0);
            }
            self.offer(corner, foot, farthest);
            if !self.may_suffice(&foot, prune_threshold) {
                return f64::INFINITY;
            }
            if foot.patch == own.patch {
                *own = foot;
            } else if other.is_some_and(|other| other.patch != foot.patch) {
                return f64::INFINITY;
            } else {
                other = Some(foot);
            }
        }
        let Some(other) = other else { return self.polygon(&own) };
        let others = CORNERS.map(|corner| self.foot(corner, &other));
        let at = |index: usize| (CORNERS[index], [own[index], others[index]]);
        let side = |[own, other]: &[Foot; 2]| usize::from(own.distance_squared > other.distance_squared);
        let mut polygons: [Vec<Foot>; 2] = [Vec::with_capacity(6), Vec::with_capacity(6)];
        let mut crossings = 0;
        for index in 0..CORNERS.len() {
            let (here, next) = (at(index), at((index + 1) % CORNERS.len()));
            let [from, to] = [side(&here.1), side(&next.1)];
            polygons[from].push(here.1[from]);
            if from != to {
                crossings += 1;
                let (place, feet) = self.crossing(here, next);
                let near = nearer(feet[0], feet[1]);
                self.offer(place, near, farthest);
                if !self.may_suffice(&near, prune_threshold) {
                    return f64::INFINITY;
                }
                for (polygon, foot) in polygons.iter_mut().zip(feet) {
                    polygon.push(foot);
                }
            }
        }
        // More crossings do not leave two convex polygons.
        if crossings > 2 {
            return f64::INFINITY;
        }
        self.polygon(&polygons[0]).max(self.polygon(&polygons[1]))
    }

    /// The foot of a place on a patch, from a foot on it near by.
    fn foot(&self, place: [f64; 2], near: &Foot) -> Foot {
        foot_on(self.b, self.point(place), near.patch, near.parameters)
    }

    fn point(&self, place: [f64; 2]) -> DVec3 {
        self.transform.apply(self.patch.point(self.cell.at(place)))
    }

    fn offer(&self, place: [f64; 2], foot: Foot, farthest: &mut Sample) {
        if foot.distance_squared > farthest.foot.distance_squared {
            *farthest = Sample { parameters: self.cell.at(place), foot };
        }
    }

    /// A place between two corners that are nearer to one of two patches each,
    /// with feet on both that are about equally far: a safeguarded secant on
    /// the difference.
    fn crossing(&self, from: Vertex, to: Vertex) -> Vertex {
        let at = |x: f64| [0, 1].map(|axis| (1.0 - x) * from.0[axis] + x * to.0[axis]);
        // Of distances, not squares: on overlapping sheets these grow linearly from the join.
        let difference = |[own, other]: &[Foot; 2]| own.distance() - other.distance();
        let (mut low, mut high) = (0.0, 1.0);
        let (mut at_low, mut at_high) = (difference(&from.1), difference(&to.1));
        let mut vertex = to;
        for _ in 0..SECANT_STEPS {
            let fraction = at_low / (at_low - at_high);
            let inside = if fraction.is_finite() { fraction.clamp(MIN_STEP, 1.0 - MIN_STEP) } else { 0.5 };
            let x = low + inside * (high - low);
            let place = at(x);
            vertex = (place, vertex.1.map(|foot| self.foot(place, &foot)));
            let difference = difference(&vertex.1);
            if difference.abs() <= CLOSE * self.of_cell() {
                break;
            }
            if (difference < 0.0) == (at_low < 0.0) {
                (low, at_low) = (x, difference);
            } else {
                (high, at_high) = (x, difference);
            }
        }
        vertex
    }

    /// The lemma for one polygon, which may be none.
    fn polygon(&self, feet: &[Foot]) -> f64 {
        if feet.is_empty() {
            return 0.0;
        }
        let (mut farthest, mut patch) = (0.0_f64, 0);
        let mut low = [1.0_f64; 2];
        let mut high = [0.0_f64; 2];
        for foot in feet {
            farthest = farthest.max(foot.distance_squared);
            patch = foot.patch;
            for axis in 0..2 {
                low[axis] = low[axis].min(foot.parameters[axis]);
                high[axis] = high[axis].max(foot.parameters[axis]);
            }
        }
        let extent = [0, 1].map(|axis| (high[axis] - low[axis]).max(0.0));
        farthest.sqrt() + self.of_cell() + interpolation_error(&self.b.bounds(patch, low, high), extent)
    }

    /// δ_A.
    fn of_cell(&self) -> f64 {
        interpolation_error(self.bounds, self.cell.half.map(|half| 2.0 * half))
    }
}

fn nearer(one: Foot, other: Foot) -> Foot {
    if other.distance_squared < one.distance_squared { other } else { one }
}

/// δ of the lemma over an extent of the parameters.
fn interpolation_error(bounds: &DerivativeBounds, [u, v]: [f64; 2]) -> f64 {
    let [uu, uv, vv] = bounds.second;
    (u * u * uu + 2.0 * u * v * uv + v * v * vv) / 8.0
}
