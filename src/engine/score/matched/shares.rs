//! The share of pieces with a property where some pieces are undecided, and the choice of the pieces to halve.

use crate::interval::Interval;
use crate::normals::Likeness;
use crate::sorting::sort_by_number;

/// The part of the permitted width that pieces which are not halved may have.
const KEPT_PART: f64 = 0.75;

/// Sizes of the pieces that are alike, that are not, and of the others.
pub(super) struct Shares {
    pub(super) alike: Interval,
    pub(super) unlike: Interval,
    pub(super) open: Interval,
}

impl Shares {
    /// Sums the sizes of pieces, each with the ends of the share of it that is alike.
    pub(super) fn of(pieces: impl Iterator<Item = (Interval, [f64; 2])>) -> Self {
        let zero = Interval::exactly(0.0);
        // Most are of one kind: nothing of a size is added without a rounding.
        let part = |sum: Interval, size: Interval, share: f64| match share {
            0.0 => sum,
            1.0 => sum + size,
            _ => sum + size * share,
        };
        pieces.fold(Self { alike: zero, unlike: zero, open: zero }, |sums, (size, [least, most])| Self {
            alike: part(sums.alike, size, least),
            unlike: part(sums.unlike, size, 1.0 - most),
            open: part(sums.open, size, most - least),
        })
    }

    /// Returns the share of those that are alike; it rises with the size of pieces that are, and falls with that of
    /// the others. The open ones may be alike, may not be, or may not count at all.
    pub(super) fn part(&self) -> Interval {
        let share = |of: f64, rest: [f64; 2]| {
            let of = Interval::exactly(of).not_negative();
            if rest == [0.0; 2] && of.lower > 0.0 {
                return Interval::exactly(1.0);
            }
            of.over(of + Interval::exactly(rest[0]) + Interval::exactly(rest[1]))
        };
        let least = share(self.alike.lower, [self.unlike.upper, self.open.upper]);
        let others = share(self.unlike.lower, [self.alike.upper, self.open.upper]);
        // 1 less 1 is 0 without a rounding.
        let upper = if others.lower < 1.0 { (Interval::exactly(1.0) - others).upper } else { 0.0 };
        Interval { lower: least.lower, upper }.within(Interval { lower: 0.0, upper: 1.0 })
    }
}

/// Returns the ends of the share of a piece that is alike; `beyond` has those of the share beyond the threshold.
pub(super) fn share(likeness: Likeness, beyond: impl FnOnce() -> [f64; 2]) -> [f64; 2] {
    match likeness {
        Likeness::Alike => [1.0; 2],
        Likeness::Unlike => [0.0; 2],
        Likeness::Open => [0.0, 1.0],
        Likeness::ByDistance => {
            let [least, most] = beyond();
            [1.0 - most, 1.0 - least]
        }
    }
}

/// Returns an upper bound on what is not known of a piece: the size of its open share, and the width of its size.
pub(super) fn unknown(size: Interval, [least, most]: [f64; 2]) -> f64 {
    (most - least) * size.upper + size.width()
}

/// Returns the pieces of the largest sizes that are not known, at most `room`: the others have less than the `permitted`
/// size together.
pub(super) fn largest_open(open: impl Iterator<Item = f64>, permitted: f64, room: usize) -> Vec<usize> {
    let mut open: Vec<(f64, usize)> = open.zip(0..).filter(|(size, _)| *size > 0.0).collect();
    sort_by_number(&mut open, |one| -one.0);
    let mut left: f64 = open.iter().map(|(size, _)| size).sum();
    let kept = KEPT_PART * permitted;
    let needed = open.into_iter().take_while(|(size, _)| {
        let is_needed = left > kept;
        left -= size;
        is_needed
    });
    needed.map(|(_, index)| index).take(room).collect()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// A third of a piece by distance is beyond the threshold, or half of it.
    fn part(sizes: &[([f64; 2], Likeness)]) -> [f64; 2] {
        let share = |likeness| share(likeness, || [1.0 / 3.0, 0.5]);
        let sizes =
            sizes.iter().map(|&([lower, upper], likeness)| (Interval { lower, upper }, share(likeness)));
        let Interval { lower, upper } = Shares::of(sizes).part();
        [lower, upper]
    }

    /// Ends are attained where sizes are at the ends of their intervals.
    #[test]
    fn shares_are_between_the_least_and_the_largest() {
        let near = |found: [f64; 2], expected: [f64; 2]| {
            assert!(found[0] <= expected[0] && expected[0] - found[0] < 1e-14, "{found:?} {expected:?}");
            assert!(found[1] >= expected[1] && found[1] - expected[1] < 1e-14, "{found:?} {expected:?}");
        };
        let all =
            [([2.0, 3.0], Likeness::Alike), ([1.0, 2.0], Likeness::Unlike), ([4.0, 5.0], Likeness::Open)];
        near(part(&all), [2.0 / 9.0, 1.0 - 1.0 / 9.0]);
        near(part(&all[..2]), [0.5, 0.75]);
        near(part(&all[2..]), [0.0, 1.0]);
        // Of one kind only, all is known, however little is known of the sizes.
        assert_eq!(part(&all[..1]), [1.0, 1.0]);
        assert_eq!(part(&all[1..2]), [0.0, 0.0]);
        assert_eq!(part(&[]), [0.0, 1.0]);
        near(part(&[([6.0, 6.0], Likeness::ByDistance)]), [0.5, 2.0 / 3.0]);
        near(part(&[([6.0, 6.0], Likeness::ByDistance), ([6.0, 6.0], Likeness::Alike)]), [0.75, 5.0 / 6.0]);
    }

    #[test]
    fn the_largest_open_pieces_are_halved_until_little_is_left() {
        let chosen = |permitted, room| largest_open([0.0, 1.0, 3.0, 1.0].into_iter(), permitted, room);
        assert_eq!(chosen(1e-3, 9), [2, 1, 3]);
        assert_eq!(chosen(2.0 / KEPT_PART, 9), [2]);
        assert_eq!(chosen(1e-3, 1), [2]);
        assert!(chosen(5.0 / KEPT_PART, 9).is_empty());
    }
}
