//! A bound for cells whose nearest patch changes inside, however many compete.
//!
//! Lemma. For weights `λ_k >= 0` of sum 1 and maps φ_k of the cell into patches
//! of B, `d(a, B)² <= Σ λ_k |A - B∘φ_k|²` at every point a of the cell.
//!
//! Proof. Each `|A - B∘φ_k|²` is at least d(a, B)², and so is their mean. ∎
//!
//! Where the distance has a maximum at which several patches are equally near,
//! their squared distances have gradients with 0 in their convex hull. With
//! those weights the mean has no slope, and its bound is of second order where
//! that of every single patch is of first. Two parameters need three patches at
//! most (Carathéodory).

use super::Operand;
use super::balance::{Plane, balance, plane_of_distance};
use super::cell_bounds::CellBounds;
use super::certify::{Facing, Followed};
use super::feet::{Feet, Foot};
use super::foot_map::FootMap;
use super::nearest::foot_on;
use super::quadratic::largest;
use super::region::Cell;
use crate::bezier::Jet;
use glam::DVec3;

/// At least the distance to B of every point of the cell, by the feet of its
/// centre on different patches; infinite where one of them alone does best, and
/// no number where that cannot be told.
pub(super) fn blend(
    cell: &Cell,
    a: &Jet,
    a_bounds: &CellBounds<'_>,
    b: &Operand<'_>,
    feet: &Feet,
    prune_threshold: f64,
) -> f64 {
    let feet = feet.all();
    if feet.len() == 1 {
        return f64::INFINITY;
    }
    let mut planes = Vec::with_capacity(feet.len());
    for foot in feet {
        planes.push(plane(cell, a, b.patch(foot.patch).point(foot.parameters)));
    }
    let weights = balance(&planes).weights;
    if weights.iter().any(|(_, weight)| *weight == 1.0) {
        return f64::INFINITY;
    }
    let mut facings = Vec::with_capacity(weights.len());
    for (index, weight) in weights {
        if weight > 0.0 {
            facings.push((Facing::new(cell, a, a_bounds, b, &feet[index]), weight));
        }
    }
    let mut terms = Vec::with_capacity(facings.len());
    for (facing, weight) in &facings {
        let followed = facing.follow(&facing.linear().unwrap_or(FootMap::CONSTANT));
        terms.push((followed.quadratic.length_squared(), *weight, followed));
    }
    // The root of the largest weighted mean of `(|Q| + rest)²`.
    let bound = |rest: fn(&Followed<'_>) -> f64| {
        let mut mean = [[0.0_f64; 5]; 5];
        for (squares, weight, followed) in &terms {
            let rest = rest(followed);
            let more = rest * (2.0 * largest(squares).sqrt() + rest);
            for (mean, square) in mean.iter_mut().flatten().zip(squares.iter().flatten()) {
                *mean += weight * (square + more);
            }
        }
        largest(&mean).sqrt()
    };
    let whole = bound(|followed| followed.rest(false));
    let close_may_suffice = || bound(|_| 0.0) <= prune_threshold;
    if whole > prune_threshold && close_may_suffice() { bound(|followed| followed.rest(true)) } else { whole }
}

/// The centre's feet on those of the listed patches that carry the balance over
/// the cell, and the one known.
pub(super) fn carrying_feet(cell: &Cell, a: &Jet, b: &Operand<'_>, known: Foot) -> Feet {
    let mut feet = Feet::of(known);
    let Some(about) = b.candidates.as_ref().filter(|about| about.center.distance(a.point) < about.margin())
    else {
        return feet;
    };
    let mut planes = Vec::with_capacity(about.list.len() + 1);
    for candidate in &about.list {
        planes.push(plane(cell, a, candidate.point));
    }
    planes.push(plane(cell, a, b.patch(known.patch).point(known.parameters)));
    for (index, weight) in balance(&planes).weights {
        if let Some(candidate) = about.list.get(index).filter(|_| weight > 0.0)
            && candidate.patch != known.patch
        {
            feet.add(foot_on(b, a.point, candidate.patch, candidate.parameters));
        }
    }
    feet
}

/// The squared distance to a point over the cell, to first order.
fn plane(cell: &Cell, a: &Jet, point: DVec3) -> Plane {
    plane_of_distance(a, point, cell.half.map(|half| -half), cell.half)
}
