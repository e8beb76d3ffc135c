//! The points of a cell at which its bound is looked at, and what refutes it.

use super::super::nearest::{Foot, NearestPoint};
use super::super::rounding::{point_error, rounded_up};
use super::super::{Cell, Pair};
use super::{AuditReport, Lemma};
use crate::closest::closest_above;

/// The width of a certified distance, relative to the bound that it is compared with: a bound that is too small by
/// less is not refuted.
const CERTIFICATE_PART: f64 = 1e-3;

/// A cell's middle and its corners, by their places in it.
pub(in crate::certified) const REGULAR: [[f64; 2]; 5] =
    [[0.0, 0.0], [-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]];

/// The steps of an additive sequence of low discrepancy in the square: powers of the inverse of the plastic number
/// (Roberts 2018).
const SEQUENCE: [f64; 2] = [0.754_877_666_246_693, 0.569_840_290_998_053];

/// A bound on a cell that a search relied on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::certified) struct CellBound {
    pub(in crate::certified) cell: Cell,
    pub(in crate::certified) upper: f64,
    pub(in crate::certified) lemma: Lemma,
    /// A foot near the cell, where the nearest point of its points is first looked for.
    pub(in crate::certified) foot: Foot,
}

/// A point of a cell that is certainly farther from B than the cell's bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Refutation {
    pub(crate) lemma: Lemma,
    pub(crate) patch: u32,
    pub(crate) parameters: [f64; 2],
    /// The bound, and the least distance of the point.
    pub(crate) upper: f64,
    pub(crate) distance: f64,
}

/// What looks at points.
#[derive(Clone, Copy)]
pub(in crate::certified) struct Auditor<'a> {
    pub(in crate::certified) pair: &'a Pair<'a>,
    pub(in crate::certified) nearest: &'a NearestPoint<'a>,
    /// What rounding may add to an upper bound and take off a lower one.
    pub(in crate::certified) rounding: f64,
}

/// Places within a cell besides the regular ones.
pub(in crate::certified) fn inner(count: usize) -> impl Iterator<Item = [f64; 2]> {
    (0..count).map(|index| SEQUENCE.map(|step| 2.0 * ((index + 1) as f64 * step).fract() - 1.0))
}

/// The patches of a model that are looked at.
const PATCHES: usize = 16;

/// The points of each of them besides its middle and its corners.
const FURTHER: usize = 3;

/// Looks at points of all of A, none of which is farther from B than `upper` by this lemma.
pub(crate) fn audit_whole(pair: &Pair<'_>, upper: f64, lemma: Lemma) -> (AuditReport, Option<Refutation>) {
    let nearest = NearestPoint::new(pair.b);
    let auditor = Auditor { pair, nearest: &nearest, rounding: point_error(pair) };
    let mut report = AuditReport::default();
    let count = pair.a.patches().len();
    for patch in (0..count as u32).step_by(count.div_ceil(PATCHES).max(1)) {
        report.count(lemma, Auditor::count(FURTHER));
        let bound = CellBound { cell: Cell::whole(patch), upper, lemma, foot: Foot::start(0, [0.5; 2]) };
        if let Some(refutation) = auditor.cell(&bound, FURTHER) {
            report.strike(lemma);
            return (report, Some(refutation));
        }
    }
    (report, None)
}

impl Auditor<'_> {
    /// Looks at the corners of a cell, its middle and `further` points of it. O(points) closest points.
    pub(in crate::certified) fn cell(&self, bound: &CellBound, further: usize) -> Option<Refutation> {
        REGULAR.into_iter().chain(inner(further)).find_map(|place| self.point(bound, bound.cell.at(place)))
    }

    /// The number of points that [`Self::cell`] looks at.
    pub(in crate::certified) fn count(further: usize) -> usize {
        REGULAR.len() + further
    }

    /// Looks at one point of a cell's patch: refuted where no point of B is as near as the bound says.
    ///
    /// Points of B are those of plain patches, by Newton's method, and what is far from all of them is proved by
    /// the certified closest point. The bound has used neither.
    fn point(&self, bound: &CellBound, parameters: [f64; 2]) -> Option<Refutation> {
        let CellBound { cell: Cell { patch, .. }, upper, lemma, foot } = *bound;
        let point = self.pair.point_of_a(patch, parameters);
        let most = rounded_up(upper) + self.rounding;
        if !most.is_finite() {
            return None;
        }
        let near = self.nearest.on_patch(point, foot.patch, foot.parameters);
        if near.distance() <= most {
            return None;
        }
        let known = Some((near.patch, near.parameters));
        let closest = closest_above(self.pair.b.target, point, CERTIFICATE_PART * most, known, most, None)?;
        let distance = closest.lower - self.rounding;
        (distance > most).then_some(Refutation { lemma, patch, parameters, upper, distance })
    }
}
