//! The time of a computation, and how much of its budget is left.

use std::time::Duration;
use web_time::Instant;

/// The least time that a computation gets after the budget is spent: it then bounds everything once.
const LEAST_SECONDS: f64 = 1e-3;

/// When a computation began, with its budget of seconds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Clock {
    started: Instant,
    max_seconds: Option<f64>,
}

impl Clock {
    /// Returns the clock of a computation that begins now.
    pub(super) fn start(max_seconds: Option<f64>) -> Self {
        Self { started: Instant::now(), max_seconds }
    }

    /// Returns the seconds since the computation began.
    pub(super) fn seconds(self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    /// Returns whether the budget is spent.
    pub(super) fn is_over(self) -> bool {
        self.max_seconds.is_some_and(|most| self.seconds() >= most)
    }

    /// Returns the seconds that are left of the budget, for a computation that is a part of this one.
    pub(super) fn left(self) -> Option<f64> {
        let left = self.max_seconds? - self.seconds();
        Some(if left > LEAST_SECONDS { left } else { LEAST_SECONDS })
    }

    /// Returns the moment at which the budget is spent; `None` without a budget, and if the clock cannot represent the
    /// moment.
    pub(super) fn deadline(self) -> Option<Instant> {
        self.started.checked_add(Duration::try_from_secs_f64(self.max_seconds?).ok()?)
    }
}
