//! Patches of B that a climb has met, so that steps need not look at all of them.

use glam::DVec3;

/// Patches remembered: more than are about equally near to most points.
const MAX_MET: usize = 128;

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
        Self { list: vec![(0, DVec3::ZERO, f64::NEG_INFINITY); MAX_MET] }
    }

    pub(super) fn add(&mut self, patch: u32, point: DVec3, distance: f64) {
        self.list[patch as usize % MAX_MET] = (patch, point, distance);
    }

    /// At most the patch's distance to a point, as far as that is known.
    pub(super) fn least(&self, patch: u32, point: DVec3) -> f64 {
        let (met, at, distance) = self.list[patch as usize % MAX_MET];
        if met == patch { distance - at.distance(point) } else { f64::NEG_INFINITY }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// Of balls, whose distance is known: what is remembered is never more than it.
    #[test]
    fn a_patch_is_no_nearer_than_remembered() {
        let random = &mut fastrand::Rng::with_seed(5);
        let mut met = Met::new();
        let mut remembered = 0;
        for _ in 0..5000 {
            // Two of them share a place in the list.
            let ball = random.u32(0..3) * MAX_MET as u32 / 2;
            let center = DVec3::splat(f64::from(ball));
            let mut point = || DVec3::from_array([0; 3].map(|_| 10.0 * random.f64()));
            let (before, now) = (point(), point());
            if ball.is_multiple_of(2) {
                met.add(ball, before, before.distance(center) - 1.0);
            }
            let least = met.least(ball, now);
            assert!(least <= now.distance(center) - 1.0 + 1e-12);
            remembered += usize::from(least > f64::NEG_INFINITY);
        }
        assert!(remembered > 1000);
    }
}
