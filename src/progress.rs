//! Progress out, cancelling in.

use crate::error::{Error, Result};
use web_time::{Duration, Instant};

/// What a caller is told, and asked, while a distance is computed.
pub trait Monitor {
    /// The work done so far, from 0 to 1, never falling.
    fn progress(&mut self, fraction: f64);

    /// The interval so far of methods `certified` and `hierarchy`, never widening while one
    /// direction is in work.
    fn interval(&mut self, _lower: f64, _upper: f64) {}

    /// Whether to stop; asked between chunks of work.
    fn cancelled(&self) -> bool;
}

/// A monitor that hears nothing and never cancels.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoMonitor;

impl Monitor for NoMonitor {
    fn progress(&mut self, _fraction: f64) {}

    fn cancelled(&self) -> bool {
        false
    }
}

/// Time between two looks at the monitor: a frame of a display, so that a
/// page stays responsive, and rare enough to cost nothing.
const INTERVAL: Duration = Duration::from_millis(15);

/// The part of the progress that one step of the work fills.
pub(crate) struct Progress<'a> {
    monitor: &'a mut dyn Monitor,
    /// The part of the whole that the direction in work fills.
    direction: [f64; 2],
    /// The part of the direction that the step in work fills.
    section: [f64; 2],
    /// The most reported, which stays while work begun on a lost device is repeated.
    reported: f64,
    last: Instant,
}

impl<'a> Progress<'a> {
    /// For one direction or two.
    pub(crate) fn new(monitor: &'a mut dyn Monitor, symmetric: bool) -> Self {
        let length = if symmetric { 0.5 } else { 1.0 };
        Self { monitor, direction: [0.0, length], section: [0.0, 1.0], reported: 0.0, last: Instant::now() }
    }

    /// The direction that follows is the second.
    pub(crate) fn second_half(&mut self) {
        self.direction = [0.5, 0.5];
    }

    /// The steps that follow fill [start, start + length] of the direction.
    pub(crate) fn section(&mut self, start: f64, length: f64) {
        self.section = [start, length];
    }

    /// Whether the next checkpoint will look at the monitor.
    pub(crate) fn is_due(&self) -> bool {
        self.last.elapsed() >= INTERVAL
    }

    /// Reports that `fraction` of the section is done and lets the caller's
    /// event loop run, at most every [`INTERVAL`], first when that has passed:
    /// short work is not interrupted.
    ///
    /// # Errors
    /// [`Error::Cancelled`] if the monitor says so.
    pub(crate) async fn checkpoint(&mut self, fraction: f64) -> Result<()> {
        if self.is_due() {
            give_way().await;
            let of_direction = self.section[0] + self.section[1] * fraction;
            let of_whole = self.direction[0] + self.direction[1] * of_direction;
            self.reported = of_whole.max(self.reported).min(1.0);
            self.monitor.progress(self.reported);
            self.last = Instant::now();
        }
        if self.monitor.cancelled() { Err(Error::Cancelled) } else { Ok(()) }
    }

    /// Passes the interval on.
    pub(crate) fn interval(&mut self, lower: f64, upper: f64) {
        self.monitor.interval(lower, upper);
    }

    /// Reports that everything is done.
    pub(crate) fn finish(&mut self) {
        self.monitor.progress(1.0);
    }
}

/// Lets messages and events in, natively nothing.
#[cfg(not(target_arch = "wasm32"))]
async fn give_way() {}

/// Lets messages and events in: one turn of the event loop, by a message to
/// itself. A timer of 0 ms would wait for 1 ms in Node and for 4 ms in browsers.
#[cfg(target_arch = "wasm32")]
async fn give_way() {
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
