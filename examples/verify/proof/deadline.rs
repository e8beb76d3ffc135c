//! An end of a proof, in seconds that this process ran.

#[allow(dead_code, reason = "shared with the benchmarks, which measure wall-clock seconds too")]
#[path = "../../../benches/support/clock.rs"]
mod clock;

use clock::Stopwatch;
use std::cell::Cell;

/// The number of questions for one look at the clock, which takes as long as some dozens of steps.
const QUESTIONS: u32 = 64;

/// The end of a proof: its CPU seconds, which other processes do not shorten.
pub(crate) struct Deadline {
    start: Stopwatch,
    seconds: f64,
    questions: Cell<u32>,
    is_over: Cell<bool>,
}

impl Deadline {
    pub(crate) fn after(seconds: f64) -> Self {
        let start = Stopwatch::start(true);
        Self { start, seconds, questions: Cell::new(0), is_over: Cell::new(false) }
    }

    /// Returns whether the seconds are over.
    pub(crate) fn is_over(&self) -> bool {
        let question = self.questions.get().wrapping_add(1);
        self.questions.set(question);
        if question.is_multiple_of(QUESTIONS) && self.spent() > self.seconds {
            self.is_over.set(true);
        }
        self.is_over.get()
    }

    /// The CPU seconds since the start.
    pub(crate) fn spent(&self) -> f64 {
        self.start.cpu_seconds()
    }
}
