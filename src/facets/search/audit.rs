//! An audit of the search, for tests, fuzzing and benchmarks: sampled points of what a bound drops are
//! compared with all facets of B one by one, which knows nothing of covers, cuts and boxes.

use super::super::{Facet, FacetTarget};
use super::part::TrianglePart;
use crate::rounding::lower_min;
use crate::threads::locked;
use glam::DVec3;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock};

/// The weights of the corners at sampled points: corners, points of the edges and of the interior.
const WEIGHTS: [[f64; 3]; 12] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.5, 0.5, 0.0],
    [0.0, 0.25, 0.75],
    [0.61, 0.0, 0.39],
    [0.34, 0.33, 0.33],
    [0.92, 0.05, 0.03],
    [0.06, 0.9, 0.04],
    [0.02, 0.07, 0.91],
    [0.48, 0.17, 0.35],
    [0.21, 0.58, 0.21],
];

/// The points along each side of a triangle for its mean by a rule, and of the rule whose difference is its error.
pub(super) const RULES: [usize; 2] = [6, 3];

/// The error of the finer rule, in differences of both.
const RULE_DIFFERENCES: f64 = 4.0;

/// The steps of an additive sequence of low discrepancy in the square: powers of the inverse of the plastic number
/// (Roberts 2018).
const SEQUENCE: [f64; 2] = [0.754_877_666_246_693, 0.569_840_290_998_053];

/// The weights of corners and of `further` points: an additive sequence of low discrepancy, folded into the triangle.
pub(super) fn places(further: usize) -> impl Iterator<Item = [f64; 3]> {
    let inner = (1..=further).map(|index| {
        let [s, t] = SEQUENCE.map(|step| (index as f64 * step).fract());
        let [s, t] = if s + t > 1.0 { [1.0 - s, 1.0 - t] } else { [s, t] };
        [1.0 - s - t, s, t]
    });
    WEIGHTS[..3].iter().copied().chain(inner)
}

/// The weights of the middles of the triangles in which one is divided.
pub(super) fn middles(count: usize) -> impl Iterator<Item = [f64; 3]> {
    let of = move |row: usize, column: usize, third: f64| {
        let [s, t] = [row, column].map(|step| (step as f64 + third) / count as f64);
        [1.0 - s - t, s, t]
    };
    (0..count * count).map(move |index| {
        let (row, column) = (index / count, index % count);
        // Those of the square on this side of its diagonal, and the halves beyond theirs folded back.
        if row + column < count {
            of(row, column, 1.0 / 3.0)
        } else {
            of(count - 1 - row, count - 1 - column, 2.0 / 3.0)
        }
    })
}

/// The error of the finer of both rules, where distances are in a range of this width: a step between nearest facets
/// is the share of a row of triangles.
pub(super) fn rule_error(fine: f64, coarse: f64, range: f64) -> f64 {
    RULE_DIFFERENCES * (fine - coarse).abs() + range / (RULES[0] * RULES[0]) as f64
}

/// The most facets below a node of A's tree that are sampled.
const MAX_SAMPLED: usize = 8;

/// The parts of A that bounds dropped, and what refutes them.
#[derive(Debug, Default)]
pub struct Audit {
    parts: AtomicU64,
    points: AtomicU64,
    refuted: Mutex<Vec<String>>,
}

static OF_ALL: OnceLock<Arc<Audit>> = OnceLock::new();

/// Audits every search over facets of this process that starts from now on, which takes long, and
/// returns what is found.
pub fn audit_facet_searches() -> Arc<Audit> {
    Arc::clone(OF_ALL.get_or_init(Arc::default))
}

/// Returns the audit of all searches, if there is one.
pub(super) fn of_all() -> Option<Arc<Audit>> {
    OF_ALL.get().cloned()
}

impl Audit {
    /// Returns the numbers of parts and of points compared.
    #[must_use]
    pub fn counts(&self) -> [u64; 2] {
        [&self.parts, &self.points].map(|count| count.load(Ordering::Relaxed))
    }

    /// Returns the bounds that a point is beyond, by the point and its distance.
    #[must_use]
    pub fn refuted(&self) -> Vec<String> {
        locked(&self.refuted).clone()
    }

    /// Compares points of a triangle that none of the kept parts has with a bound on their distance.
    pub(super) fn part(
        &self,
        b: &FacetTarget,
        corners: &[DVec3; 3],
        kept: &[Option<TrianglePart>],
        bound: f64,
        rounding: f64,
    ) {
        let points = WEIGHTS.map(|weights| Facet::Triangle(*corners).point(weights));
        let is_kept = |point: DVec3| {
            let of = |part: &TrianglePart| Facet::Triangle(part.corners).nearest(point).distance_squared;
            kept.iter().flatten().any(|part| of(part) <= rounding * rounding)
        };
        self.points(b, points.into_iter().filter(|&point| !is_kept(point)), bound, rounding);
    }

    /// Compares points of facets, moved, with a bound on the distance of all of them.
    pub(super) fn facets(
        &self,
        b: &FacetTarget,
        facets: impl ExactSizeIterator<Item = [DVec3; 3]>,
        bound: f64,
        rounding: f64,
    ) {
        let step = facets.len().div_ceil(MAX_SAMPLED).max(1);
        let points = facets
            .step_by(step)
            .flat_map(|corners| [0, 1, 2, 6].map(|sample| Facet::Triangle(corners).point(WEIGHTS[sample])));
        self.points(b, points, bound, rounding);
    }

    fn points(&self, b: &FacetTarget, points: impl Iterator<Item = DVec3>, bound: f64, rounding: f64) {
        self.parts.fetch_add(1, Ordering::Relaxed);
        for point in points {
            self.points.fetch_add(1, Ordering::Relaxed);
            let squares = (0..b.len() as u32).map(|facet| b.distance_squared(facet, point));
            let distance = squares.fold(f64::INFINITY, lower_min).sqrt();
            if !(distance <= bound + rounding) {
                locked(&self.refuted)
                    .push(format!("{point} is {distance:e} away, beyond the bound {bound:e}"));
            }
        }
    }
}
