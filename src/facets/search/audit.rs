//! An audit of the search, for tests, fuzzing and benchmarks: sampled points of what a bound drops are
//! compared with all facets of B one by one, which knows nothing of covers, cuts and boxes.

use super::super::{Facet, FacetTarget};
use super::part::TrianglePart;
use super::sampled::WEIGHTS;
use crate::rounding::lower_min;
use crate::threads::locked;
use glam::DVec3;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock};

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
