//! The measured speed of kernels, from which the size of dispatches follows.

use crate::gpu::kernel::Kernel;
use crate::threads::locked;
use std::sync::Mutex;

/// Seconds that a submission may be expected to take: browsers kill work that
/// lasts for seconds, and progress and cancelling are handled between submissions.
pub(crate) const MAX_SECONDS: f64 = 0.2;

/// Units a second assumed of a kernel that has not run yet: so slow that its
/// first dispatch stays short on a software adapter.
const INITIAL_THROUGHPUT: f64 = 2e4;

/// A throughput changes by at most this factor per submission, which limits
/// the effect of one unusual measurement.
const MAX_THROUGHPUT_CHANGE: f64 = 8.0;

/// Units of work a second of every kernel, as measured.
#[derive(Debug, Default)]
pub(crate) struct Throughput(Mutex<Vec<(Kernel, f64)>>);

impl Throughput {
    /// The measured throughput, or the initial one.
    pub(crate) fn units_per_second(&self, kernel: Kernel) -> f64 {
        let rates = locked(&self.0);
        rates.iter().find(|(other, _)| *other == kernel).map_or(INITIAL_THROUGHPUT, |&(_, rate)| rate)
    }

    /// The units of work of this kernel that fill a submission; 1 or more.
    pub(crate) fn chunk(&self, kernel: Kernel) -> usize {
        (self.units_per_second(kernel) * MAX_SECONDS).max(1.0) as usize
    }

    /// Corrects the kernel's throughput after it was expected to run for
    /// `expected` seconds and took `measured`.
    pub(crate) fn correct(&self, kernel: Kernel, expected: f64, measured: f64) {
        let factor = (expected / measured).clamp(1.0 / MAX_THROUGHPUT_CHANGE, MAX_THROUGHPUT_CHANGE);
        let mut rates = locked(&self.0);
        match rates.iter_mut().find(|(other, _)| *other == kernel) {
            Some((_, rate)) => *rate *= factor,
            None => rates.push((kernel, INITIAL_THROUGHPUT * factor)),
        }
    }
}
