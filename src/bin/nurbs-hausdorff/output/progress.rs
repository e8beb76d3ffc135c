//! The progress bar.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use nurbs_hausdorff::Monitor;

/// Steps of the bar.
const STEPS: u64 = 1000;

/// The line that a search prints when it first stalls.
const STALLED: &str = "the interval has not halved over ten times the cells of the last time: the search may take \
much longer; --max-seconds, --max-cells or a larger --tolerance ends it";

/// A bar on standard error, drawn only if that is a terminal.
pub(crate) struct Bar {
    bar: ProgressBar,
    /// Whether the line about a stalled search is printed.
    has_stalled: bool,
}

impl Bar {
    pub(crate) fn new() -> Self {
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr());
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3}% {elapsed} {msg}") {
            bar.set_style(style);
        }
        Self { bar, has_stalled: false }
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
        if stalled && !self.has_stalled {
            self.has_stalled = true;
            self.bar.suspend(|| eprintln!("{STALLED}"));
        }
    }

    fn cancelled(&self) -> bool {
        false
    }
}
