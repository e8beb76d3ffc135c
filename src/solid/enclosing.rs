//! The shells about a point.

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
    fn shells_of_different_solids_are_no_voids_of_each_other() {
        let alone = SourceSolid::Alone;
        let pairs = [
            (alone(None), alone(Some(0))),
            (alone(Some(1)), SourceSolid::Several),
            (alone(None), alone(None)),
        ];
        assert_eq!(pairs.map(|(one, other)| one.may_be_of(other)), [false, true, true]);
    }
}
