//! The shells about a point, and the side that follows from them.

use super::Side;
use std::collections::BTreeMap;

/// The largest number of shells about a point whose relations are asked for: 28 pairs, each a search.
const MAX_RELATED: usize = 8;

/// How the first of two shells lies to the second one, of which both enclose some point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Relation {
    /// Their boundaries are certainly apart, and the first one lies within the second.
    Within,
    /// The same, and the second one lies within the first.
    About,
    /// The boundaries have points as near to each other as their coordinates tell.
    Meeting,
    /// None of these is known.
    Unknown,
}

/// What the faces of a shell bound in their source.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SourceSolid {
    /// One solid by its number, or none.
    Alone(Option<u32>),
    /// More than one, or one and none: their edges were joined.
    Several,
}

impl SourceSolid {
    /// Returns whether the shells of two may be voids of each other.
    pub(crate) fn may_be_of(self, other: Self) -> bool {
        self == other || self == Self::Several || other == Self::Several
    }
}

/// The shells that enclose a point: those that a ray from it crosses an odd number of times, in
/// order.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Enclosing(Vec<u32>);

impl Enclosing {
    /// Counts one more crossing of a shell.
    pub(super) fn cross(&mut self, shell: u32) {
        match self.0.binary_search(&shell) {
            Ok(place) => _ = self.0.remove(place),
            Err(place) => self.0.insert(place, shell),
        }
    }

    /// Returns the shells about a point from which a segment to a point that these enclose has these
    /// crossings.
    pub(super) fn across(mut self, crossed: &Self) -> Self {
        crossed.0.iter().for_each(|&shell| self.cross(shell));
        self
    }

    /// Returns whether a shell encloses the point.
    pub(crate) fn has(&self, shell: u32) -> bool {
        self.0.binary_search(&shell).is_ok()
    }

    /// Returns the shells, in order.
    pub(crate) fn shells(&self) -> &[u32] {
        &self.0
    }

    /// Returns these shells by what of the source they bound: a shell of one part is no void of another one. All are one
    /// part where one of them has faces of several.
    pub(crate) fn by_solids(&self, solid: impl Fn(u32) -> SourceSolid) -> Vec<Self> {
        let mut parts: BTreeMap<Option<u32>, Self> = BTreeMap::new();
        for &shell in &self.0 {
            match solid(shell) {
                SourceSolid::Several => return vec![self.clone()],
                SourceSolid::Alone(solid) => parts.entry(solid).or_default().0.push(shell),
            }
        }
        parts.into_values().collect()
    }

    /// Returns the side of the points that these shells enclose, by the rule of docs/solids.md,
    /// section 2. `relation` is asked for pairs of shells.
    pub(crate) fn side(&self, mut relation: impl FnMut([u32; 2]) -> Relation) -> Side {
        let count = self.0.len();
        match count {
            0 => return Side::Outside,
            1 => return Side::Inside,
            _ if count > MAX_RELATED => return Side::Undecided,
            _ => {}
        }
        let mut are_apart = true;
        let (mut meetings, mut may_be_void) = (vec![0; count], vec![false; count]);
        for (b, &other) in self.0.iter().enumerate() {
            for (a, &one) in self.0[..b].iter().enumerate() {
                let found = relation([one, other]);
                are_apart &= matches!(found, Relation::Within | Relation::About);
                may_be_void[a] |= matches!(found, Relation::Within | Relation::Unknown);
                may_be_void[b] |= matches!(found, Relation::About | Relation::Unknown);
                if found == Relation::Meeting {
                    meetings[a] += 1;
                    meetings[b] += 1;
                }
            }
        }
        let voids = may_be_void.into_iter().filter(|&may_be| may_be).count();
        if meetings.contains(&(count - 1)) || voids < count - voids {
            Side::Inside
        } else if are_apart {
            if count % 2 == 1 { Side::Inside } else { Side::Outside }
        } else {
            Side::Undecided
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    fn of(crossings: &[u32]) -> Enclosing {
        let mut shells = Enclosing::default();
        crossings.iter().for_each(|&shell| shells.cross(shell));
        shells
    }

    #[test]
    fn shells_that_are_crossed_twice_do_not_enclose() {
        assert_eq!(of(&[3, 1, 3, 2, 1, 1]), of(&[1, 2]));
        assert_eq!(of(&[1, 4]).across(&of(&[4, 2])), of(&[1, 2]));
    }

    #[test]
    fn shells_are_parted_by_their_solids() {
        let around = of(&[1, 4, 6]);
        let alone = SourceSolid::Alone;
        assert_eq!(around.by_solids(|shell| alone(Some(shell % 2))), [of(&[4, 6]), of(&[1])]);
        assert_eq!(around.by_solids(|shell| alone((shell < 5).then_some(3))), [of(&[6]), of(&[1, 4])]);
        let several = |shell| if shell == 4 { SourceSolid::Several } else { alone(Some(shell)) };
        assert_eq!(around.by_solids(several), std::slice::from_ref(&around));
        assert_eq!(of(&[]).by_solids(|_| SourceSolid::Several), []);
        let pairs = [
            (alone(None), alone(Some(0))),
            (alone(Some(1)), SourceSolid::Several),
            (alone(None), alone(None)),
        ];
        assert_eq!(pairs.map(|(one, other)| one.may_be_of(other)), [false, true, true]);
    }

    /// The pairs named meet or are not known; of the others the later one lies within the earlier.
    fn side(count: u32, meeting: &[[u32; 2]], unknown: &[[u32; 2]]) -> Side {
        of(&(0..count).collect::<Vec<_>>()).side(|pair| {
            if meeting.contains(&pair) {
                Relation::Meeting
            } else if unknown.contains(&pair) {
                Relation::Unknown
            } else {
                Relation::About
            }
        })
    }

    #[test]
    fn of_shells_apart_every_second_space_is_inside() {
        use Side::{Inside, Outside, Undecided};
        let sides = [0, 1, 2, 3, 8].map(|count| side(count, &[], &[]));
        assert_eq!(sides, [Outside, Inside, Outside, Inside, Outside]);
        assert_eq!(side(9, &[], &[]), Undecided);
        assert_eq!(of(&[2, 5]).side(|_| Relation::Within), Outside);
    }

    /// A void is apart from the shell about it, so that a shell that meets all others has none here.
    #[test]
    fn a_shell_that_meets_all_others_has_the_point_inside() {
        use Side::{Inside, Undecided};
        assert_eq!(side(2, &[[0, 1]], &[]), Inside);
        assert_eq!(side(4, &[[0, 3], [1, 3], [2, 3]], &[[1, 2], [0, 1], [0, 2]]), Inside);
        assert_eq!(side(2, &[], &[[0, 1]]), Undecided);
    }

    /// A void belongs to one body: where two have the point, one that is within both leaves one of them.
    #[test]
    fn more_bodies_than_voids_have_the_point_inside() {
        use Side::{Inside, Undecided};
        assert_eq!(side(3, &[[0, 1]], &[]), Inside);
        // Two within one, and two within two.
        assert_eq!(side(3, &[[1, 2]], &[]), Undecided);
        assert_eq!(side(4, &[[0, 1], [2, 3]], &[]), Undecided);
        assert_eq!(side(3, &[[0, 1]], &[[1, 2]]), Undecided);
    }
}
