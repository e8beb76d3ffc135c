//! Patches of B that a climb has met, so that steps need not look at all of them.

use glam::DVec3;

/// Patches remembered: more than are about equally near to most points.
const MOST_MET: usize = 128;

/// How near patches were to points about.
///
/// Lemma. A patch that is m away from x is at least `m - |x' - x|` from x'.
///
/// As m is what Newton's method expects of one start, that bounds nothing, and
/// only chooses where to look.
pub(super) struct Met {
    /// A patch, a point and their distance, at the patch's index modulo the size.
    list: Vec<(u32, DVec3, f64)>,
}

impl Met {
    pub(super) fn new() -> Self {
        Self { list: vec![(0, DVec3::ZERO, f64::NEG_INFINITY); MOST_MET] }
    }

    pub(super) fn add(&mut self, patch: u32, point: DVec3, distance: f64) {
        self.list[patch as usize % MOST_MET] = (patch, point, distance);
    }

    /// At most the patch's distance to a point, as far as that is known.
    pub(super) fn least(&self, patch: u32, point: DVec3) -> f64 {
        let (met, at, distance) = self.list[patch as usize % MOST_MET];
        if met == patch { distance - at.distance(point) } else { f64::NEG_INFINITY }
    }
}
