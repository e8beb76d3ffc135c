//! Areas of patches, faces and models, as intervals that contain them.
//!
//! The area of a patch is the integral of a density whose square is a rational function, and of a plane one that of
//! the flux along its normal, which is one itself.
//! Chebyshev series prove complex ellipses in which the density is analytic, and the bound
//! there proves the error of Gauss's rule; parts for which that fails, as at poles, are
//! halved. Lemmas and proofs are in docs/area.md.

mod cell;
mod collapsed;
pub(crate) mod density;
mod ellipse;
pub(crate) mod gauss;
mod normal_cone;
mod planar;

use crate::axis::Axis;
use crate::bezier::{Patch, PatchSet};
use crate::param_box::ParamBox;
use crate::rounding::gamma;
use crate::sorting::ordered_by;
use cell::{Cell, part_size};
use density::Density;
pub(crate) use normal_cone::{is_to_side, normal_cone};
use serde::Serialize;
use std::collections::BinaryHeap;
use std::ops::Add;

/// The width of an area that is aimed at, relative to it: two digits more than the samples of
/// a field give, so that a lost sliver is seen.
const MAX_RELATIVE_WIDTH: f64 = 1e-6;

/// The parts of it for the quadrature and for parts that are not narrow enough.
const QUADRATURE_SHARE: f64 = 0.5;
const OPEN_SHARE: f64 = 0.5;

/// The largest number of parts of a face, and for each of its patches: a patch with a pole
/// takes 150, one that folds thousands. Where they do not suffice, the interval is wider.
const MAX_CELLS: usize = 1024;
const MAX_CELLS_PER_PATCH: usize = 256;

/// The least budget of parts for a rectangle of a patch: a small one that is not narrow, as at a pole, is halved a few
/// times here before the search halves it.
const MIN_CELLS_OF_PART: usize = 8;

/// The largest number of products that the parts of a face take beyond its patches: about a second, for
/// surfaces of high degrees that fold.
const MAX_WORK: usize = 1 << 29;

/// An interval that contains an area, in squares of the model unit.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
#[non_exhaustive]
pub struct Area {
    /// A lower bound on the area.
    pub lower: f64,
    /// An upper bound on the area.
    pub upper: f64,
}

impl Add for Area {
    type Output = Self;

    /// Returns the interval of the sum, with its rounding.
    fn add(self, other: Self) -> Self {
        let rounding = gamma(1.0);
        Self {
            lower: (self.lower + other.lower) * (1.0 - rounding),
            upper: (self.upper + other.upper) * (1.0 + rounding),
        }
    }
}

/// Returns the area of the patches of a face, within [`MAX_RELATIVE_WIDTH`] of it unless that
/// takes too many parts or float64 does not resolve it.
///
/// O(patches degree⁴) where all patches are regular, and as much for each further part.
pub(crate) fn area<'a>(patches: impl Iterator<Item = Patch<'a>>) -> Area {
    let patches: Vec<Patch<'a>> = patches.collect();
    let densities: Vec<Density<'_>> = patches.iter().map(Density::new).collect();
    let mut parts = Parts::default();
    for density in &densities {
        parts.add(density, Cell::new(density, ParamBox::UNIT));
    }
    parts.narrowed(patches.len(), MAX_CELLS + MAX_CELLS_PER_PATCH * patches.len(), MAX_WORK, 0.0)
}

/// Returns the area of a rectangle of a patch in its parameters in [0, 1]². As [`area`] of one patch, with the
/// rectangle's share of the parts and of `negligible`, a width of the whole patch's area that is narrow enough: the
/// rectangles that a patch is divided into take about as many parts as it does.
pub(crate) fn area_of_part(patch: &Patch<'_>, range: ParamBox, negligible: f64) -> Area {
    let density = Density::new(patch);
    let mut parts = Parts::default();
    parts.add(&density, Cell::new(&density, range));
    let share = part_size(range);
    let max_cells = ((share * MAX_CELLS_PER_PATCH as f64) as usize).max(MIN_CELLS_OF_PART);
    parts.narrowed(1, max_cells, (share * MAX_WORK as f64) as usize, share * negligible)
}

/// Returns a width of one patch's area that is narrow enough: with it the area of all patches is known to
/// [`MAX_RELATIVE_WIDTH`]. That area is estimated by the middles of the patches, as the width decides only how many parts
/// are made. O(patches degree²).
pub(crate) fn negligible_width(patches: &PatchSet) -> f64 {
    let density = |patch: Patch<'_>| {
        let middle = patch.jet(ParamBox::UNIT.middle());
        middle.s.cross(middle.t).length()
    };
    MAX_RELATIVE_WIDTH * patches.iter().map(density).sum::<f64>() / patches.len() as f64
}

/// The parts of a face.
#[derive(Default)]
struct Parts<'a> {
    /// The area of the parts that are narrow enough.
    closed: Area,
    /// The other parts, the widest area on top.
    open: BinaryHeap<Open<'a>>,
    /// The sum of their widths, up to rounding: it decides only when to end.
    open_width: f64,
}

impl<'a> Parts<'a> {
    fn add(&mut self, density: &'a Density<'a>, cell: Cell) {
        match cell.halve {
            None => self.closed = self.closed + cell.area,
            Some(axis) => {
                self.open_width += cell.width();
                self.open.push(Open { density, cell, axis });
            }
        }
    }

    /// Halves the parts whose areas have the widest bounds, until the sum is narrow, relative to itself or to
    /// `negligible`, or there are `max_cells` parts or they took `max_work` products, and returns the sum. `count` is
    /// the number of parts at first.
    fn narrowed(mut self, mut count: usize, max_cells: usize, max_work: usize, negligible: f64) -> Area {
        let mut work = 0;
        while count < max_cells
            && work < max_work
            && self.open_width > negligible
            && self.open_width > OPEN_SHARE * MAX_RELATIVE_WIDTH * self.closed.lower
            && let Some(Open { density, cell, axis }) = self.take()
        {
            for half in cell.part.halves(axis) {
                self.add(density, Cell::new(density, half));
                count += 1;
                work += density.work();
            }
        }
        self.sum()
    }

    /// Takes the part of the widest area.
    fn take(&mut self) -> Option<Open<'a>> {
        let widest = self.open.pop()?;
        self.open_width -= widest.cell.width();
        Some(widest)
    }

    fn sum(&self) -> Area {
        self.open.iter().fold(self.closed, |sum, open| sum + open.cell.area)
    }
}

/// A part that may be halved, ordered by the width of its area.
struct Open<'a> {
    density: &'a Density<'a>,
    cell: Cell,
    axis: Axis,
}

ordered_by!(Open<'_>, |open| open.cell.width());

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use glam::DVec3;

    /// The normal of (s², t², s t) vanishes at a corner, so that the area is that of many small parts. Beside larger patches
    /// fewer of them suffice, and rectangles take their share of the width.
    #[test]
    fn areas_are_as_narrow_as_the_width_that_is_negligible() {
        let point = |i: usize, k: usize| {
            DVec3::new(if i == 2 { 1.0 } else { 0.0 }, if k == 2 { 1.0 } else { 0.0 }, (i * k) as f64 / 4.0)
        };
        let controls: Vec<_> = (0..3).flat_map(|i| (0..3).map(move |k| point(i, k).extend(1.0))).collect();
        let patch = Patch::whole([2, 2], DVec3::ZERO, &controls);
        const STEPS: u32 = 1000;
        let middle = |k: u32| (f64::from(k) + 0.5) / f64::from(STEPS);
        let density = |s: f64, t: f64| {
            let jet = patch.jet([s, t]);
            jet.s.cross(jet.t).length()
        };
        let sum: f64 = (0..STEPS)
            .flat_map(|i| (0..STEPS).map(move |k| [i, k]))
            .map(|[i, k]| density(middle(i), middle(k)))
            .sum();
        let expected = sum / f64::from(STEPS * STEPS);
        let mut before = f64::INFINITY;
        for negligible in [1e-1, 1e-2, 1e-3] {
            let whole = area_of_part(&patch, ParamBox::UNIT, negligible);
            let halves = ParamBox::UNIT.halves(Axis::U).map(|half| area_of_part(&patch, half, negligible));
            for Area { lower, upper } in [whole, halves[0] + halves[1]] {
                assert!(lower <= expected && expected <= upper, "{lower} {expected} {upper}");
                assert!(upper - lower <= negligible, "{lower} {upper} {negligible}");
            }
            let width = whole.upper - whole.lower;
            assert!(width < before, "{width} {before}");
            before = width;
        }
    }
}
