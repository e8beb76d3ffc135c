//! The progress of one of several computations.

use crate::progress::Monitor;

/// The monitor of a computation that is a part of another one.
pub(super) struct Section<'a> {
    pub(super) whole: &'a mut dyn Monitor,
    /// Start and length of the part within the whole.
    pub(super) part: [f64; 2],
}

impl Monitor for Section<'_> {
    fn progress(&mut self, fraction: f64) {
        self.whole.progress(self.part[1].mul_add(fraction, self.part[0]));
    }

    fn cancelled(&self) -> bool {
        self.whole.cancelled()
    }
}
