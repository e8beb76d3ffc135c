//! Whether a search still gains: how its interval narrows with its cells.

use crate::interval::Interval;

/// The factor by which an interval narrows at a gain.
const GAIN: f64 = 2.0;

/// The cells, relative to those of the last gain, over which a search that gains
/// nothing has stalled. Halving all cells along both sides takes four times as
/// many, after which each bound of first order or better has halved.
const PATIENCE: usize = 10;

/// Cells that count as those of the first gain: the interval of a search that has
/// only begun is that of whole models.
const FIRST_CELLS: usize = 1024;

/// The last gain of a search.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gains {
    width: f64,
    cells: usize,
}

impl Gains {
    pub(crate) fn new(first: Interval) -> Self {
        Self { width: width(first), cells: FIRST_CELLS }
    }

    /// Records the interval after `cells` cells, and returns whether the
    /// search has stalled: its interval is more than half as wide as at the last
    /// gain, which took less than a tenth of the cells.
    pub(crate) fn has_stalled(&mut self, interval: Interval, cells: usize) -> bool {
        if GAIN * width(interval) <= self.width {
            *self = Self { width: width(interval), cells: cells.max(FIRST_CELLS) };
        }
        cells > PATIENCE * self.cells
    }
}

fn width(interval: Interval) -> f64 {
    interval.upper - interval.lower
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    fn interval(width: f64) -> Interval {
        Interval { lower: 1.0, upper: 1.0 + width }
    }

    #[test]
    fn a_search_that_halves_its_interval_in_time_does_not_stall() {
        let mut gains = Gains::new(interval(1.0));
        for step in 1..12 {
            let (width, cells) = (0.5_f64.powi(step), FIRST_CELLS * 9_usize.pow(step as u32));
            assert!(!gains.has_stalled(interval(1.9 * width), cells - 1), "{step}");
            assert!(!gains.has_stalled(interval(width), cells), "{step}");
        }
    }

    #[test]
    fn it_stalls_after_ten_times_the_cells_of_the_last_gain_until_the_next() {
        let mut gains = Gains::new(interval(1.0));
        assert!(!gains.has_stalled(interval(0.25), 50_000));
        assert!(!gains.has_stalled(interval(0.126), 500_000));
        assert!(gains.has_stalled(interval(0.126), 500_001));
        assert!(!gains.has_stalled(interval(0.125), 600_000));
        assert!(gains.has_stalled(interval(0.125), 6_000_001));
    }

    #[test]
    fn the_first_cells_are_no_gain() {
        let mut gains = Gains::new(interval(1.0));
        assert!(!gains.has_stalled(interval(0.9), PATIENCE * FIRST_CELLS));
        assert!(gains.has_stalled(interval(0.9), PATIENCE * FIRST_CELLS + 1));
    }
}
