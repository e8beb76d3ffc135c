//! Time that other work on the machine does not lengthen.

use std::time::Instant;

/// Started at a moment; tells the seconds since.
///
/// On Linux with a software adapter, whose threads are ours, these are seconds
/// of all processors together: what the process's threads have spent on them,
/// over their number. Else they are seconds of the clock on the wall.
pub(crate) struct Stopwatch {
    wall: Instant,
    spent: Option<f64>,
}

impl Stopwatch {
    pub(crate) fn start(on_processor: bool) -> Self {
        Self { wall: Instant::now(), spent: if on_processor { spent() } else { None } }
    }

    pub(crate) fn seconds(&self) -> f64 {
        match (self.spent, spent()) {
            (Some(before), Some(now)) => (now - before) / processors(),
            _ => self.wall.elapsed().as_secs_f64(),
        }
    }
}

fn processors() -> f64 {
    std::thread::available_parallelism().map_or(1.0, |count| count.get() as f64)
}

/// Seconds that the process's threads have spent on a processor, as the scheduler knows.
fn spent() -> Option<f64> {
    let of = |task: std::fs::DirEntry| {
        let text = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse::<u64>().ok()
    };
    let nanoseconds: u64 = std::fs::read_dir("/proc/self/task").ok()?.flatten().filter_map(of).sum();
    (nanoseconds > 0).then_some(nanoseconds as f64 * 1e-9)
}
