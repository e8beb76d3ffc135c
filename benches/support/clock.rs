//! Time that other processes do not lengthen.

use std::time::Instant;

/// Measures seconds since its start.
///
/// On Linux with a software adapter, whose threads belong to this process,
/// these are the seconds that the process's threads ran, divided by the number
/// of CPUs. Otherwise they are wall-clock seconds.
pub(crate) struct Stopwatch {
    wall: Instant,
    spent: Option<f64>,
}

impl Stopwatch {
    pub(crate) fn start(on_cpu: bool) -> Self {
        Self { wall: Instant::now(), spent: if on_cpu { spent() } else { None } }
    }

    pub(crate) fn seconds(&self) -> f64 {
        match (self.spent, spent()) {
            (Some(start), Some(now)) => (now - start) / cpus(),
            _ => self.wall.elapsed().as_secs_f64(),
        }
    }

    /// Returns the seconds that all threads ran; wall-clock seconds where these are not known.
    pub(crate) fn cpu_seconds(&self) -> f64 {
        match (self.spent, spent()) {
            (Some(start), Some(now)) => now - start,
            _ => self.wall.elapsed().as_secs_f64(),
        }
    }
}

fn cpus() -> f64 {
    std::thread::available_parallelism().map_or(1.0, |count| count.get() as f64)
}

/// Seconds that the process's threads have run, according to the scheduler.
fn spent() -> Option<f64> {
    let of = |task: std::fs::DirEntry| {
        let text = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse::<u64>().ok()
    };
    let nanoseconds: u64 = std::fs::read_dir("/proc/self/task").ok()?.flatten().filter_map(of).sum();
    (nanoseconds > 0).then_some(nanoseconds as f64 * 1e-9)
}
