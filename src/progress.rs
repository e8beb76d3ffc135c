//! Progress reports and cancellation.

use crate::error::{Error, Result};
use web_time::{Duration, Instant};

/// `Send` natively, so that computations may move between threads; nothing on the web, where
/// functions of JavaScript stay on theirs.
#[cfg(not(target_arch = "wasm32"))]
pub use Send as MaybeSend;

/// `Send` natively, so that computations may move between threads; nothing on the web, where
/// functions of JavaScript stay on theirs.
#[cfg(target_arch = "wasm32")]
pub trait MaybeSend {}

#[cfg(target_arch = "wasm32")]
impl<T> MaybeSend for T {}

/// The caller's side of a running computation: it receives progress and may cancel. It must
/// not wait for another computation of the same engine, which would wait for this one.
pub trait Monitor: MaybeSend {
    /// Receives the fraction of the work done, from 0 to 1, never falling.
    fn progress(&mut self, fraction: f64);

    /// Receives the current interval of methods `certified` and `hierarchy`, which
    /// never widens within one direction.
    fn interval(&mut self, _lower: f64, _upper: f64) {}

    /// Receives, with every interval, whether the search of method `certified` has
    /// stalled: its interval has not halved over ten times the cells that it took
    /// to the last halving. It then ends by a budget, by cancelling, or after
    /// much longer than so far; false once it has halved again.
    fn stalled(&mut self, _stalled: bool) {}

    /// Receives, after every step of a best fit, its number and the root mean square of the distances.
    fn step(&mut self, _step: usize, _rms: f64) {}

    /// Returns whether to stop; called between chunks of work.
    fn cancelled(&self) -> bool;
}

/// A monitor that ignores progress and never cancels.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoMonitor;

impl Monitor for NoMonitor {
    fn progress(&mut self, _fraction: f64) {}

    fn cancelled(&self) -> bool {
        false
    }
}

/// The time between two reports to the monitor: about one frame of a display, so
/// that a page stays responsive, and rare enough to cost nothing.
const INTERVAL: Duration = Duration::from_millis(15);

/// The progress of a computation that consists of directions and their sections.
pub(crate) struct Progress<'a> {
    monitor: &'a mut dyn Monitor,
    /// Start and length of the current direction within the whole.
    direction: [f64; 2],
    /// Start and length of the current section within the direction.
    section: [f64; 2],
    /// The largest fraction reported, which stays while work on a lost device is repeated.
    reported: f64,
    last: Instant,
}

impl<'a> Progress<'a> {
    /// Starts the progress of one direction, or of two.
    pub(crate) fn new(monitor: &'a mut dyn Monitor, symmetric: bool) -> Self {
        let length = if symmetric { 0.5 } else { 1.0 };
        Self { monitor, direction: [0.0, length], section: [0.0, 1.0], reported: 0.0, last: Instant::now() }
    }

    /// Returns the caller's side, for a computation that is a part of this one.
    pub(crate) fn monitor(&mut self) -> &mut dyn Monitor {
        self.monitor
    }

    /// Begins the second direction.
    pub(crate) fn second_half(&mut self) {
        self.direction = [0.5, 0.5];
    }

    /// Begins a section that covers [start, start + length] of the direction.
    pub(crate) fn section(&mut self, start: f64, length: f64) {
        self.section = [start, length];
    }

    /// Returns whether the next checkpoint will report to the monitor.
    pub(crate) fn is_due(&self) -> bool {
        self.last.elapsed() >= INTERVAL
    }

    /// Reports that `fraction` of the section is done and lets the caller's
    /// event loop run, at most every [`INTERVAL`], first when that has passed:
    /// short work is not interrupted.
    ///
    /// # Errors
    /// [`Error::Cancelled`] if the monitor requests it.
    pub(crate) async fn checkpoint(&mut self, fraction: f64) -> Result<()> {
        if self.is_due() {
            yield_to_event_loop().await;
            let in_direction = self.section[0] + self.section[1] * fraction;
            let overall = self.direction[0] + self.direction[1] * in_direction;
            self.reported = overall.max(self.reported).min(1.0);
            self.monitor.progress(self.reported);
            self.last = Instant::now();
        }
        if self.monitor.cancelled() { Err(Error::Cancelled) } else { Ok(()) }
    }

    /// Reports the interval, and whether the search has stalled.
    pub(crate) fn interval(&mut self, lower: f64, upper: f64, stalled: bool) {
        self.monitor.interval(lower, upper);
        self.monitor.stalled(stalled);
    }

    /// Reports a step of a best fit.
    pub(crate) fn step(&mut self, step: usize, rms: f64) {
        self.monitor.step(step, rms);
    }

    /// Reports that everything is done.
    pub(crate) fn finish(&mut self) {
        self.monitor.progress(1.0);
    }
}

/// Lets the event loop run; does nothing natively.
#[cfg(not(target_arch = "wasm32"))]
async fn yield_to_event_loop() {}

/// Lets the event loop run for one turn, by a message to itself. A timer of 0 ms
/// would wait for 1 ms in Node and for 4 ms in browsers.
#[cfg(target_arch = "wasm32")]
async fn yield_to_event_loop() {
    let Ok(channel) = web_sys::MessageChannel::new() else { return };
    let (here, there) = (channel.port1(), channel.port2());
    let turn = js_sys::Promise::new(&mut |resolve, _reject| {
        here.set_onmessage(Some(&resolve));
        // The undefined value can be copied, so that this does not fail.
        let _ = there.post_message(&wasm_bindgen::JsValue::UNDEFINED);
    });
    // The promise is never rejected, and its value has no meaning.
    let _ = wasm_bindgen_futures::JsFuture::from(turn).await;
    // An open port would keep Node's process alive.
    here.close();
}
