//! The progress bar.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use nurbs_hausdorff::Monitor;
use std::time::{Duration, Instant};

/// Steps of the bar.
const STEPS: u64 = 1000;

/// The line that a search prints when it first stalls.
const STALLED: &str = "the interval has not halved over ten times the cells of the last time: the search may take \
much longer; --max-seconds, --max-cells or a larger --tolerance ends it";

/// The time before which a search that stalls is not worth a line: it may end before it is read.
const PATIENCE: Duration = Duration::from_secs(5);

/// A bar on standard error, drawn only if that is a terminal.
pub(crate) struct Bar {
    bar: ProgressBar,
    started: Instant,
    /// Whether the line about a stalled search is printed.
    has_stalled: bool,
}

impl Bar {
    pub(crate) fn new() -> Self {
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr());
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3}% {elapsed} {msg}") {
            bar.set_style(style);
        }
        Self { bar, started: Instant::now(), has_stalled: false }
    }

    /// Returns whether the line about a stalled search is to be printed, which is once.
    fn is_told(&mut self, stalled: bool, after: Duration) -> bool {
        let is_told = stalled && !self.has_stalled && after >= PATIENCE;
        self.has_stalled |= is_told;
        is_told
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl Monitor for Bar {
    fn progress(&mut self, fraction: f64) {
        self.bar.set_position((fraction * STEPS as f64) as u64);
    }

    fn interval(&mut self, lower: f64, upper: f64) {
        self.bar.set_message(format!("[{lower:.6e}, {upper:.6e}]"));
    }

    fn stalled(&mut self, stalled: bool) {
        if self.is_told(stalled, self.started.elapsed()) {
            self.bar.suspend(|| eprintln!("{STALLED}"));
        }
    }

    fn cancelled(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_that_stalls_is_told_of_once_and_not_before_its_time() {
        let mut bar = Bar::new();
        let times = [4.9, 5.0, 5.1].map(Duration::from_secs_f64);
        assert!(!bar.is_told(true, times[0]) && !bar.is_told(false, times[1]));
        assert!(bar.is_told(true, times[1]) && !bar.is_told(true, times[2]));
    }
}
