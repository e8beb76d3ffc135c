//! The patches of B near the incumbent's witness, around which the last cells lie.

use crate::closest::{NearbyPatches, Target, nearest_control, newton};
use glam::DVec3;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Patch queries after which a list pays: making one costs about as many.
const MIN_QUERIES: usize = 64;

/// Extent of a list beyond the witness's distance, in radii of a cell. Cell
/// corners lie within two radii of the witness, and moving a point by r changes
/// each distance by at most r: 2 + 2.
const MARGIN_IN_RADII: f64 = 4.0;

/// Bound on that extent relative to the distance: of a longer list, few patches
/// would ever be queried.
const MAX_RELATIVE_MARGIN: f64 = 0.03;

/// The largest number of Newton steps to a start on a patch; any point of it is one.
const MAX_ITERATIONS: u32 = 16;

/// A list of nearby patches, and the queries since it was made.
#[derive(Debug, Default)]
pub(super) struct Shortlist {
    pub(super) listed: Option<Listed>,
    queries: AtomicUsize,
}

/// Nearby patches with starts on them.
#[derive(Debug)]
pub(super) struct Listed {
    pub(super) nearby: NearbyPatches,
    /// The parameters (s, t) of a point of each listed patch near the centre.
    pub(super) starts: Vec<[f64; 2]>,
}

impl Listed {
    fn new(target: &Target, center: DVec3, radius: f64) -> Self {
        let nearby = NearbyPatches::new(target, center, radius);
        let start = |patch: u32| {
            let patch = target.patches.patch(patch as usize);
            newton(&patch, center, nearest_control(&patch, center), MAX_ITERATIONS).parameters
        };
        let starts = nearby.list.iter().map(|candidate| start(candidate.patch)).collect();
        Self { nearby, starts }
    }
}

impl Shortlist {
    /// Counts the query of one patch.
    pub(super) fn count_query(&self) {
        self.queries.fetch_add(1, Ordering::Relaxed);
    }

    /// Forgets the queries: those for large cells do not call for a list.
    pub(super) fn reset_queries(&mut self) {
        *self.queries.get_mut() = 0;
    }

    /// Lists the patches around a witness at this distance from B, for cells of
    /// this radius, where the number of queries made it worth it and the
    /// present list is not about a point within a radius.
    pub(super) fn update(&mut self, target: &Target, witness: DVec3, distance: f64, radius: f64) {
        let is_stale = |listed: &Listed| listed.nearby.center.distance(witness) > radius;
        if *self.queries.get_mut() >= MIN_QUERIES && self.listed.as_ref().is_none_or(is_stale) {
            self.reset_queries();
            let margin = (MARGIN_IN_RADII * radius).min(MAX_RELATIVE_MARGIN * distance);
            self.listed = Some(Listed::new(target, witness, distance + margin));
        }
    }
}
