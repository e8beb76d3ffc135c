//! The carrier that all of the other boundary near a piece lies on or nearly so.

use crate::overlap::carrier::{Carrier, EXACT, Form};
use crate::overlap::piece::{Piece, Whole};
use crate::overlap::separation::normal;
use crate::rounding::upper_max;
use glam::DVec3;
use std::sync::Arc;

/// The least length of the mean of normals that counts as one.
const MIN_AGREEMENT: f64 = 0.7;

/// A carrier with the range of its values on all of the other boundary that is near a piece.
#[derive(Debug, Clone)]
pub(in crate::overlap) struct Level {
    carrier: Arc<Carrier>,
    low: f64,
    high: f64,
}

impl Level {
    /// Returns the carrier of pieces about a place; that of the piece that this one is a part of where it fits well.
    pub(in crate::overlap) fn around(
        near: &[(&Whole, &Piece)],
        piece: &Piece,
        before: Option<&Self>,
    ) -> Option<Self> {
        if let Some(level) = before.filter(|level| level.high - level.low <= EXACT * piece.radius) {
            return Some(level.clone());
        }
        let mut sum = DVec3::ZERO;
        let mut sizes = 0.0;
        for &piece in near {
            // A strip has hardly a normal.
            let size = if piece.0.is_strip { 0.0 } else { piece.1.radius * piece.1.radius };
            let normal = normal(piece) * size;
            sum += if normal.dot(sum) < 0.0 { -normal } else { normal };
            sizes += size;
        }
        if !(sum.length() >= MIN_AGREEMENT * sizes && sizes > 0.0) {
            return None;
        }
        let carrier = Carrier::of(near, piece.middle, sum.normalize(), piece.radius)?;
        let mut level = Self { carrier: Arc::new(carrier), low: f64::INFINITY, high: f64::NEG_INFINITY };
        for &(whole, piece) in near {
            let [low, high] = Form::new(&level.carrier, whole, piece).range();
            level.low = -upper_max(-level.low, -low);
            level.high = upper_max(level.high, high);
        }
        (level.high - level.low).is_finite().then_some(level)
    }

    /// Returns the values above and below which points of a piece are off the near boundary, which is off by `margin`.
    pub(in crate::overlap) fn levels(&self, piece: &Piece, margin: f64) -> [f64; 2] {
        let reach = self.carrier.slope(piece.middle, piece.radius + margin) * margin;
        [(self.high + reach).next_up(), (self.low - reach).next_down()]
    }

    /// Returns the values on a piece.
    pub(in crate::overlap) fn form(&self, whole: &Whole, piece: &Piece) -> Form {
        Form::new(&self.carrier, whole, piece)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::overlap::BoundarySide;
    use crate::overlap::piece::Patches;
    use crate::shapes;

    fn ball(radius: f64) -> Patches {
        let model = shapes::sphere(DVec3::ZERO, radius).unwrap();
        Patches::new(&extract(&model).patches, std::iter::empty(), None, |_| BoundarySide::Outward)
    }

    /// Next to a sphere f is about the height, so that it may be larger by the margin within that of the surface.
    #[test]
    fn levels_have_all_values_within_the_margin() {
        let patches = ball(2.0);
        let margin = 0.01;
        for whole in patches.faces() {
            let near = (whole, &whole.root);
            let level = Level::around(&[near], &whole.root, None).unwrap();
            let [above, below] = level.levels(&whole.root, margin);
            let mut most = 0.0_f64;
            for &point in &whole.corners(&whole.root) {
                for moved in [2.0 - margin, 2.0 + margin] {
                    let value = level.carrier.at(point.normalize() * moved);
                    assert!(below < value && value < above);
                    most = most.max(value.abs() / above.min(-below));
                }
            }
            assert!(most > 0.2, "{most} of the level");
        }
    }

    /// The level of a part is that of the whole where it fits well, and another one where it does not.
    #[test]
    fn a_level_that_fits_is_kept() {
        let patches = ball(2.0);
        let whole = patches.faces().next().unwrap();
        let piece = whole.halves(&whole.root).unwrap()[0];
        let level = Level::around(&[(whole, &whole.root)], &whole.root, None).unwrap();
        let again = Level::around(&[(whole, piece)], piece, Some(&level)).unwrap();
        assert!(Arc::ptr_eq(&again.carrier, &level.carrier));
        let wide = Level { high: 0.5, ..level.clone() };
        let other = Level::around(&[(whole, piece)], piece, Some(&wide)).unwrap();
        assert!(!Arc::ptr_eq(&other.carrier, &level.carrier) && other.high < 1e-9);
    }

    /// Two spheres near a piece: the range has both.
    #[test]
    fn a_level_has_all_pieces_in_its_range() {
        let (one, other) = (ball(2.0), ball(2.1));
        let near: Vec<_> =
            [&one, &other].map(|patches| &patches.wholes[0]).map(|whole| (whole, &whole.root)).into();
        for order in [[0, 1], [1, 0]] {
            let near = order.map(|index| near[index]);
            let level = Level::around(&near, near[0].1, None).unwrap();
            for &(whole, piece) in &near {
                for point in whole.corners(piece) {
                    let value = level.carrier.at(point);
                    assert!(level.low <= value && value <= level.high);
                }
            }
            assert!(level.high - level.low > 0.05);
        }
    }
}
