//! Computations without Python's lock, which report to Python and end by its signals.

use crate::failure;
use nurbs_hausdorff::{Error, Monitor, Result};
use pyo3::prelude::*;
use rayon::ThreadPoolBuilder;
use std::sync::OnceLock;

/// The Python side of a running computation.
pub(crate) struct Caller {
    /// Receives the fraction done and the interval, and returns whether to stop.
    report: Option<Py<PyAny>>,
    interval: Option<[f64; 2]>,
    /// An exception of a signal's handler, such as `KeyboardInterrupt`, or of `report`.
    raised: Option<PyErr>,
    cancelled: bool,
}

impl Caller {
    fn ask(&mut self, py: Python<'_>, fraction: f64) -> PyResult<bool> {
        py.check_signals()?;
        let Some(report) = &self.report else { return Ok(false) };
        let interval = self.interval.map(|[lower, upper]| (lower, upper));
        report.bind(py).call1((fraction, interval))?.is_truthy()
    }
}

impl Monitor for Caller {
    fn progress(&mut self, fraction: f64) {
        if self.cancelled {
            return;
        }
        match Python::attach(|py| self.ask(py, fraction)) {
            Ok(stop) => self.cancelled = stop,
            Err(raised) => (self.raised, self.cancelled) = (Some(raised), true),
        }
    }

    fn interval(&mut self, lower: f64, upper: f64) {
        self.interval = Some([lower, upper]);
    }

    fn cancelled(&self) -> bool {
        self.cancelled
    }
}

/// Runs a computation on this thread without Python's lock, and asks the caller about every
/// 15 ms whether to go on.
///
/// `is_cancelled` is true for results that a cancelled computation returns.
///
/// # Errors
/// The exception of a signal's handler or of `report`, with the cancellation as its cause;
/// `CANCELLED` with the interval reached; the computation's own errors.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    report: Option<Py<PyAny>>,
    compute: impl FnOnce(&mut Caller) -> Result<T> + Send,
    is_cancelled: impl FnOnce(&T) -> bool,
) -> PyResult<T> {
    let mut caller = Caller { report, interval: None, raised: None, cancelled: false };
    // What is cancelled already does not begin, however short it is.
    caller.progress(0.0);
    let result = if caller.cancelled {
        Err(Error::Cancelled)
    } else {
        py.detach(|| on_live_threads(|| compute(&mut caller)))?
    };
    let cancelled = || failure::exception(py, Error::Cancelled.code(), "cancelled", caller.interval);
    if let Some(raised) = caller.raised.take() {
        raised.set_cause(py, Some(cancelled()));
        return Err(raised);
    }
    match result {
        Ok(result) if is_cancelled(&result) => Err(cancelled()),
        Err(Error::Cancelled) => Err(cancelled()),
        Err(error) => Err(failure::of_error(py, &error)),
        Ok(result) => Ok(result),
    }
}

/// Runs a computation with threads that exist.
///
/// A process that was forked, as Python's `multiprocessing` does on some systems, has none of
/// its parent's threads, so that the shared pool would never answer. There every call has a
/// pool of its own: one shared by calls could run one call within another that holds a lock.
///
/// # Errors
/// Python's `OSError` if the system has no more threads.
pub(crate) fn on_live_threads<T: Send>(compute: impl FnOnce() -> T + Send) -> PyResult<T> {
    static FIRST_PROCESS: OnceLock<u32> = OnceLock::new();
    let process = std::process::id();
    if *FIRST_PROCESS.get_or_init(|| process) == process {
        return Ok(compute());
    }
    let pool = ThreadPoolBuilder::new().build().map_err(std::io::Error::other)?;
    Ok(pool.install(compute))
}
