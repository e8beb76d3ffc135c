//! The progress and the time of one of several computations.

use crate::progress::Monitor;
use web_time::Instant;

/// The least time that a computation gets after the budget is spent: it then bounds everything once.
const LEAST_SECONDS: f64 = 1e-3;

/// Returns the seconds that are left of a budget, for the next computation.
pub(super) fn seconds_left(started: Instant, max_seconds: Option<f64>) -> Option<f64> {
    let left = max_seconds? - started.elapsed().as_secs_f64();
    Some(if left > LEAST_SECONDS { left } else { LEAST_SECONDS })
}

/// Returns whether a budget of seconds is spent.
pub(super) fn is_over(started: Instant, max_seconds: Option<f64>) -> bool {
    max_seconds.is_some_and(|most| started.elapsed().as_secs_f64() >= most)
}

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
