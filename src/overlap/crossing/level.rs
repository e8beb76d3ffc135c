//! The carrier that all of the other boundary near a piece lies on or nearly so.

use crate::overlap::carrier::{Carrier, EXACT, Form};
use crate::overlap::piece::{Piece, Whole};
use crate::overlap::separation::normal;
use crate::rounding::upper_max;
use crate::sorting::sort_by_number;
use glam::DVec3;
use std::sync::Arc;

/// The least length of the mean of normals that counts as one.
const MIN_AGREEMENT: f64 = 0.7;

/// The largest number of pieces that a carrier is fitted to: others are near these.
const MAX_FITTED: usize = 12;

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
        (whole, piece): (&Whole, &Piece),
        before: Option<&Self>,
    ) -> Option<Self> {
        if lie_on((whole, piece), near) {
            return None;
        }
        if let Some(level) = before.filter(|level| level.high - level.low <= EXACT * piece.radius) {
            return Some(level.clone());
        }
        let mut sum = DVec3::ZERO;
        let mut sizes = 0.0;
        for &piece in near {
            let normal = normal(piece);
            // A strip has hardly a normal.
            let has_none = piece.0.is_strip || normal == DVec3::ZERO;
            let size = if has_none { 0.0 } else { piece.1.radius * piece.1.radius };
            let normal = normal * size;
            sum += if normal.dot(sum) < 0.0 { -normal } else { normal };
            sizes += size;
        }
        if !(sum.length() >= MIN_AGREEMENT * sizes && sizes > 0.0) {
            return None;
        }
        let carrier = Carrier::of(&largest(near), piece.middle, sum.normalize(), piece.radius)?;
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

/// Returns whether pieces lie on the carrier of a piece as far as that tells: none of them can be decided from others.
fn lie_on((whole, piece): (&Whole, &Piece), near: &[(&Whole, &Piece)]) -> bool {
    let own = normal((whole, piece));
    // Where they cross at an angle no carrier is needed to tell that they do.
    if near.first().is_none_or(|&near| normal(near).dot(own).abs() < MIN_AGREEMENT) {
        return false;
    }
    let Some(fitted) = whole.carrier(piece) else { return false };
    near.iter().all(|(whole, piece)| {
        whole.corners(piece).iter().all(|&corner| fitted.carrier.at(corner).abs() <= fitted.reach)
    })
}

/// Returns the largest of pieces.
fn largest<'a>(near: &[(&'a Whole, &'a Piece)]) -> Vec<(&'a Whole, &'a Piece)> {
    let mut pieces: Vec<_> = near.iter().copied().filter(|(whole, _)| !whole.is_strip).collect();
    if pieces.len() > MAX_FITTED {
        sort_by_number(&mut pieces, |(_, piece)| -piece.radius);
        pieces.truncate(MAX_FITTED);
    }
    pieces
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
        for (whole, inner) in patches.faces().zip(ball(1.9).faces()) {
            let near = (whole, &whole.root);
            let level = Level::around(&[near], (inner, &inner.root), None).unwrap();
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
        let (patches, inner) = (ball(2.0), ball(1.9));
        let whole = patches.faces().next().unwrap();
        let piece = whole.halves(&whole.root).unwrap()[0];
        let of = (&inner.wholes[0], &inner.wholes[0].root);
        let level = Level::around(&[(whole, &whole.root)], of, None).unwrap();
        let again = Level::around(&[(whole, piece)], of, Some(&level)).unwrap();
        assert!(Arc::ptr_eq(&again.carrier, &level.carrier));
        let wide = Level { high: 0.5, ..level.clone() };
        let other = Level::around(&[(whole, piece)], of, Some(&wide)).unwrap();
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
            let level = Level::around(&near, near[0], None).unwrap();
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
