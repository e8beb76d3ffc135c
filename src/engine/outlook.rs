//! Whether a search may reach the width that is asked for.

/// How much quicker than lately a width may come to fall, as a power: where parts are as large as what they are compared
/// with it falls late.
const HOPE: f64 = 2.0;

/// Looks at the width of a search each time its work has doubled. Whatever it says is a matter of time, and of no bound.
#[derive(Debug, Clone, Copy)]
pub(super) struct Outlook {
    /// The work at which the width is looked at next.
    next: usize,
    /// The width at the last look.
    last: f64,
    is_hopeless: bool,
}

impl Outlook {
    /// `patience` is the work before the first look.
    pub(super) fn new(patience: usize) -> Self {
        Self { next: patience, last: f64::INFINITY, is_hopeless: false }
    }

    /// Returns whether a search was found hopeless.
    pub(super) fn has_given_up(&self) -> bool {
        self.is_hopeless
    }

    /// Returns whether a search that has done some `work` and has a `width` is not to be expected to reach the `goal` by
    /// as much work in all as `most`: not even if each doubling took the square of what the last one took of the width. It
    /// stays so.
    pub(super) fn is_hopeless(&mut self, work: usize, width: f64, [goal, most]: [f64; 2]) -> bool {
        if work >= self.next {
            let remainder = if self.last < f64::INFINITY { width / self.last } else { 0.0 };
            let doublings = (most / work as f64).log2();
            self.is_hopeless |= width * remainder.powf(HOPE * doublings) > goal;
            (self.next, self.last) = (2 * work, width);
        }
        self.is_hopeless
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// A width that falls as one over a power of the work, from 1 at a work of 1, looked at until it is over.
    fn work(power: f64, goal: f64) -> usize {
        let mut outlook = Outlook::new(64);
        let at = |work: usize| (work as f64).powf(-power);
        (1..=4096)
            .find(|&work| at(work) <= goal || outlook.is_hopeless(work, at(work), [goal, 4096.0]))
            .unwrap_or(4097)
    }

    #[test]
    fn a_search_that_gets_nowhere_ends_and_one_that_converges_goes_on() {
        // At the second look, where nothing was won.
        assert_eq!(work(0.0, 0.5), 128);
        // It ends at the goal: 1/256 after 256, and 1/64 after 4096.
        assert_eq!(work(1.0, 1.0 / 256.0), 256);
        assert_eq!(work(0.5, 1.0 / 64.0), 4096);
        // A width that falls as the root does not reach 1/4096, not even as 1/x.
        assert_eq!(work(0.5, 1.0 / 8192.0), 128);
        assert_eq!(work(0.5, f64::NAN), 4097);
    }
}
