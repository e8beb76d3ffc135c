//! The weight of a residual in the sum: least squares, or one that leaves out what lies far off.

use crate::sorting::sort_by_number;
use serde::Deserialize;

/// The ratio of the standard deviation of normal errors to the median of their sizes.
const DEVIATION_OF_MEDIAN: f64 = 1.4826;

/// Tukey's constant, in standard deviations: 95 % of the efficiency of least squares for normal errors.
const TUKEY: f64 = 4.685;

/// The distance, in standard deviations, at which Geman's and McClure's weight is a quarter.
const GEMAN_MCCLURE: f64 = 3.0;

/// The standard deviations by which the share of outliers among some samples may exceed that among all.
const SHARE_DEVIATIONS: f64 = 2.0;

/// The largest share of outliers among some samples.
const MAX_SHARE: f64 = 0.99;

/// The largest share of the samples that is left out: what counts determines a pose still.
pub(crate) const MAX_OUTLIERS: f64 = 0.95;

/// The part of the samples that counts for the median: all.
const HALF: f64 = 0.5;

/// The rule by which points far from the other model lose their weight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Robust {
    /// Least squares of all points.
    #[default]
    None,
    /// The share of the farthest points that the options name is left out.
    Trimmed,
    /// Tukey's biweight: points farther than 4.685 standard deviations have no weight.
    Tukey,
    /// Geman's and McClure's weight, which falls with the fourth power of the distance.
    GemanMcclure,
}

/// A rule with the share of outliers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Loss {
    pub(crate) robust: Robust,
    /// The share of the samples that is left out, from 0 to below 1.
    pub(crate) outliers: f64,
    /// The distance beyond which a sample is left out, whatever the share, unless the rule is to leave out none.
    pub(crate) max_distance: Option<f64>,
}

impl Loss {
    /// Returns the rule for `count` of all samples. A larger share of them may be outliers, and one that is not left out
    /// adds so much to the residual that it hides how well the others lie.
    pub(crate) fn of_some(self, count: usize, all: usize) -> Self {
        if count >= all {
            return self;
        }
        let deviation = (self.outliers * (1.0 - self.outliers) / count as f64).sqrt();
        Self { outliers: (self.outliers + SHARE_DEVIATIONS * deviation).min(MAX_SHARE), ..self }
    }

    /// Returns the distance beyond which a sample counts as left out, at least `least`. It is the quantile of the share that
    /// is kept, or a multiple of the standard deviation that the median of the kept half gives. If a largest distance is set,
    /// it is that distance, but at least the twentieth part of the samples is kept. O(n log n).
    pub(super) fn scale(self, distances: &[f64], weights: &[f64], least: f64) -> f64 {
        let kept = 1.0 - self.outliers;
        let deviation = || DEVIATION_OF_MEDIAN * quantile(distances, weights, HALF * kept);
        let scale = match (self.robust, self.max_distance) {
            (Robust::None, _) => f64::INFINITY,
            (_, Some(most)) => most.max(quantile(distances, weights, 1.0 - MAX_OUTLIERS)),
            (Robust::Trimmed, None) => quantile(distances, weights, kept),
            (Robust::Tukey, None) => TUKEY * deviation(),
            (Robust::GemanMcclure, None) => GEMAN_MCCLURE * deviation(),
        };
        if scale > least { scale } else { least }
    }

    /// Returns the weight of a residual in the normal equations.
    pub(super) fn weight(self, distance: f64, scale: f64) -> f64 {
        let ratio = distance / scale;
        match self.robust {
            Robust::None => 1.0,
            Robust::Trimmed => f64::from(distance <= scale),
            Robust::Tukey if ratio < 1.0 => (1.0 - ratio * ratio).powi(2),
            Robust::Tukey => 0.0,
            Robust::GemanMcclure => (1.0 + ratio * ratio).powi(-2),
        }
    }

    /// Returns the part of a residual in the sum that the fit lowers: half its derivative over the
    /// distance is [`Self::weight`], and it is the square where that is 1.
    pub(super) fn cost(self, distance: f64, scale: f64) -> f64 {
        let square = distance * distance;
        let ratio = square / (scale * scale);
        match self.robust {
            Robust::None => square,
            Robust::Trimmed if distance <= scale => square,
            Robust::Trimmed => scale * scale,
            Robust::Tukey if ratio < 1.0 => scale * scale * (1.0 - (1.0 - ratio).powi(3)) / 3.0,
            Robust::Tukey => scale * scale / 3.0,
            Robust::GemanMcclure => square / (1.0 + ratio),
        }
    }
}

/// Returns the least distance that this share of the weight does not exceed, 0 without samples.
fn quantile(distances: &[f64], weights: &[f64], share: f64) -> f64 {
    let mut order: Vec<usize> = (0..distances.len()).collect();
    sort_by_number(&mut order, |&index| distances[index]);
    let total: f64 = weights.iter().sum();
    let mut sum = 0.0;
    for &index in &order {
        sum += weights[index];
        if sum >= share * total {
            return distances[index];
        }
    }
    order.last().map_or(0.0, |&last| distances[last])
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    const ALL: [Robust; 4] = [Robust::None, Robust::Trimmed, Robust::Tukey, Robust::GemanMcclure];

    #[test]
    fn the_scale_is_the_distance_of_the_share_that_is_kept() {
        let distances = [4.0, 1.0, 2.0, 3.0, 100.0];
        let of = |robust, outliers| Loss { robust, outliers, max_distance: None };
        let scale = |robust, outliers| of(robust, outliers).scale(&distances, &[1.0; 5], 0.0);
        assert_eq!(scale(Robust::Trimmed, 0.2), 4.0);
        assert_eq!(scale(Robust::Trimmed, 0.4), 3.0);
        assert_eq!(scale(Robust::None, 0.4), f64::INFINITY);
        assert_eq!(scale(Robust::Tukey, 0.2), 4.685 * 1.4826 * 2.0);
        let loss = of(Robust::Trimmed, 0.2);
        assert_eq!(loss.scale(&distances, &[1.0; 5], 7.0), 7.0);
    }

    /// The largest distance takes the place of the share, but for the nearest twentieth.
    #[test]
    fn the_scale_is_the_largest_distance_where_one_is_stated() {
        let distances: Vec<f64> = (1..=100).map(f64::from).collect();
        let scale = |robust, most| {
            let loss = Loss { robust, outliers: 0.5, max_distance: Some(most) };
            loss.scale(&distances, &[1.0; 100], 0.0)
        };
        assert_eq!(ALL.map(|robust| scale(robust, 30.0)), [f64::INFINITY, 30.0, 30.0, 30.0]);
        assert!((5.0..=6.0).contains(&scale(Robust::Trimmed, 0.1)));
    }

    /// Of a hundred samples the share of outliers has a standard deviation of a twentieth, if half of all are outliers.
    #[test]
    fn a_larger_share_of_few_samples_is_left_out() {
        let loss = Loss { robust: Robust::Tukey, outliers: 0.5, max_distance: None };
        assert_eq!(loss.of_some(100, 10_000), Loss { outliers: 0.6, ..loss });
        assert_eq!(loss.of_some(100, 100), loss);
        assert_eq!(Loss { outliers: 0.0, ..loss }.of_some(1, 2).outliers, 0.0);
        assert_eq!(Loss { outliers: 0.95, ..loss }.of_some(10, 20).outliers, MAX_SHARE);
    }

    /// The weight is half the slope of the cost over the distance, by central differences.
    #[test]
    fn the_weight_is_the_slope_of_the_cost() {
        const STEP: f64 = 1e-6;
        for robust in ALL {
            let loss = Loss { robust, outliers: 0.1, max_distance: None };
            for distance in [0.1, 0.7, 1.3, 1.9, 2.6] {
                let slope =
                    (loss.cost(distance + STEP, 2.0) - loss.cost(distance - STEP, 2.0)) / (2.0 * STEP);
                let expected = 2.0 * distance * loss.weight(distance, 2.0);
                assert!((slope - expected).abs() < 1e-8, "{robust:?} at {distance}: {slope} {expected}");
            }
        }
    }
}
