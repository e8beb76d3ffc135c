//! The progress bar.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use nurbs_hausdorff::Monitor;

/// Steps of the bar.
const STEPS: u64 = 1000;

/// A bar on standard error, drawn only if that is a terminal.
pub(crate) struct Bar(ProgressBar);

impl Bar {
    pub(crate) fn new() -> Self {
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr());
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3}% {elapsed} {msg}") {
            bar.set_style(style);
        }
        Self(bar)
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

impl Monitor for Bar {
    fn progress(&mut self, fraction: f64) {
        self.0.set_position((fraction * STEPS as f64) as u64);
    }

    fn interval(&mut self, lower: f64, upper: f64) {
        self.0.set_message(format!("[{lower:.6e}, {upper:.6e}]"));
    }

    fn cancelled(&self) -> bool {
        false
    }
}
