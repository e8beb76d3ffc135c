//! The rounding of the points of a model's patches.

use crate::bvh::Aabb;
use crate::rounding::gamma;

/// Upper bounds on the distance between a point computed on a patch of a model and
/// the exact point of the same parameters: the sum of lemmas R3 (extraction), R4
/// (halving) and R5 (evaluation) of docs/rounding.md, the largest over all patches.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PointError {
    /// On patches as extracted.
    uncut: f64,
    /// The error that the new centre of a piece adds.
    recentring: f64,
    /// The error that every halving adds.
    halving: f64,
    /// The distance between the patches and the model that they stand for.
    deviation: f64,
}

impl PointError {
    /// Makes the bounds hold for a patch of these degrees, too. `radius` is the
    /// largest distance from its centre of the control points of its NURBS surface,
    /// `center` the centre's distance from the origin.
    pub(in crate::bezier) fn include(&mut self, [p, q]: [usize; 2], radius: f64, center: f64) {
        let (degrees, largest) = ((p + q) as f64, p.max(q) as f64);
        // R3: 12(p + q) + 8; R5: 8(p + q) + 8, and the rounding of the centre's addition.
        let uncut = gamma(20.0 * degrees + 16.0) * radius + gamma(2.0) * center;
        // R4: 8, and one of the new centre. Its radius may be √3 times as large in R5.
        let recentring = gamma(8.0 * degrees + 17.0) * radius + gamma(1.0) * center;
        self.uncut = self.uncut.max(uncut);
        self.recentring = self.recentring.max(recentring);
        self.halving = self.halving.max(gamma(2.0 * largest) * radius);
    }

    /// Makes the bounds hold where `other` holds, too.
    pub(in crate::bezier) fn include_all(&mut self, other: &Self) {
        self.uncut = self.uncut.max(other.uncut);
        self.recentring = self.recentring.max(other.recentring);
        self.halving = self.halving.max(other.halving);
        self.deviation = self.deviation.max(other.deviation);
    }

    /// Makes the bounds hold for a model whose Hausdorff distance from the one so far is
    /// at most `deviation`: every interval is widened by the bounds on both
    /// sides, so it contains the distance of those models too.
    pub(crate) fn include_deviation(&mut self, deviation: f64) {
        self.deviation += deviation;
    }

    /// Returns bounds for all patches of degrees up to `degree` in a box, by its
    /// diagonal and its distance from the origin.
    pub(crate) fn within(degree: usize, control_box: &Aabb) -> Self {
        let mut error = Self::default();
        error.include([degree; 2], control_box.diagonal(), control_box.farthest_from_origin());
        error
    }

    /// Returns the bound for pieces after at most `halvings` halvings of a patch.
    #[must_use]
    pub fn after(&self, halvings: u32) -> f64 {
        let recentring = if halvings > 0 { self.recentring } else { 0.0 };
        self.deviation + self.uncut + recentring + f64::from(halvings) * self.halving
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::rounding::UNIT_ROUNDOFF;

    /// Lemmas R3, R4 and R5 for degrees (3, 2), where only the radius, only the centre or
    /// only the deviation counts.
    #[test]
    fn errors_are_those_of_the_lemmas() {
        let after = |radius: f64, center: f64, halvings: u32| {
            let mut error = PointError::default();
            error.include([3, 2], radius, center);
            error.after(halvings) / UNIT_ROUNDOFF
        };
        let [extraction, evaluation] = [12.0 * 5.0 + 8.0, 8.0 * 5.0 + 8.0];
        for (found, lemma) in [
            (after(2.0, 0.0, 0), 2.0 * (extraction + evaluation)),
            (after(2.0, 0.0, 8), 2.0 * (extraction + 2.0 * evaluation + 2.0 * 8.0 * 3.0 + 9.0)),
            (after(0.0, 2.0, 0), 2.0 * 2.0),
            (after(0.0, 2.0, 1), 2.0 * 3.0),
        ] {
            assert!((lemma..=1.02 * lemma).contains(&found), "{found} and {lemma}");
        }
    }

    #[test]
    fn the_larger_errors_and_all_deviations_count() {
        let mut large = PointError::default();
        large.include([3, 3], 2.0, 1.0);
        let mut both = PointError::default();
        both.include([1, 1], 1.0, 0.5);
        let small = both;
        both.include_all(&large);
        assert_eq!(both, large);
        large.include_all(&small);
        assert_eq!(both, large);
        both.include_deviation(0.25);
        both.include_deviation(0.5);
        assert_eq!(both.after(3), large.after(3) + 0.75);
    }
}
