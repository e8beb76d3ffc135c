//! The points of one model that are laid on another, with their weights.

use crate::model::RigidTransform;
use crate::sorting::sort_by_number;
use glam::DVec3;

/// The rounds in which the centre of the nearest points and these points follow from each other.
const KEPT_ROUNDS: usize = 3;

/// Weighted points; the weights sum to 1.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Samples {
    pub(crate) points: Vec<DVec3>,
    pub(crate) weights: Vec<f64>,
    /// The weighted mean of the points.
    pub(crate) center: DVec3,
    /// The root mean square of their distances from it: the unit of angles; 1 if that is 0.
    pub(crate) gyration: f64,
}

impl Samples {
    /// Returns points with the areas that they stand for; equal weights if all areas are 0. O(n).
    pub(crate) fn new(points: Vec<DVec3>, mut weights: Vec<f64>) -> Self {
        let total: f64 = weights.iter().sum();
        if total > 0.0 && total.is_finite() {
            weights.iter_mut().for_each(|weight| *weight /= total);
        } else {
            weights.fill(1.0 / points.len().max(1) as f64);
        }
        let weighted = || points.iter().zip(&weights);
        let center: DVec3 = weighted().map(|(&point, &weight)| weight * point).sum();
        let square: f64 =
            weighted().map(|(&point, &weight)| weight * (point - center).length_squared()).sum();
        let gyration = if square > 0.0 { square.sqrt() } else { 1.0 };
        Self { points, weights, center, gyration }
    }

    /// Returns at most `count` of the points, of equal weight: those at equal steps of the sum of
    /// weights, so that large areas keep their share. O(n).
    pub(crate) fn thinned(&self, count: usize) -> Self {
        if self.points.len() <= count {
            return self.clone();
        }
        let mut chosen = Vec::with_capacity(count);
        let mut sum = 0.0;
        for (&point, weight) in self.points.iter().zip(&self.weights) {
            sum += weight;
            while chosen.len() < count && sum * count as f64 >= chosen.len() as f64 + 0.5 {
                chosen.push(point);
            }
        }
        let weights = vec![1.0; chosen.len()];
        Self::new(chosen, weights)
    }

    /// Returns the samples without this share of them, which are farthest from where most are: points far off would
    /// shift the centre and stretch the gyration. O(n log n).
    pub(crate) fn without_farthest(&self, share: f64) -> Self {
        if share == 0.0 {
            return self.clone();
        }
        let count = ((1.0 - share) * self.points.len() as f64).round() as usize;
        let round = |center: DVec3| {
            let mut order: Vec<usize> = (0..self.points.len()).collect();
            sort_by_number(&mut order, |&index| self.points[index].distance_squared(center));
            order.truncate(count);
            let of = |index: &usize| (self.points[*index], self.weights[*index]);
            let (points, weights) = order.iter().map(of).unzip();
            Self::new(points, weights)
        };
        let first = round(DVec3::from_array([0, 1, 2].map(|axis| self.median(axis))));
        (1..KEPT_ROUNDS).fold(first, |kept, _| round(kept.center))
    }

    fn median(&self, axis: usize) -> f64 {
        let mut values: Vec<f64> = self.points.iter().map(|point| point[axis]).collect();
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(0.0)
    }

    /// Returns the middle of the box of the points under a motion; `None` without points.
    pub(crate) fn middle(&self, motion: &RigidTransform) -> Option<DVec3> {
        let images = || self.points.iter().map(|&point| motion.apply(point));
        Some(0.5 * (images().reduce(DVec3::min)? + images().reduce(DVec3::max)?))
    }

    /// Returns the largest distance of a point from the centre.
    pub(crate) fn extent(&self) -> f64 {
        let squares = self.points.iter().map(|point| (*point - self.center).length_squared());
        squares.fold(0.0, f64::max).sqrt()
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn thinned_samples_keep_the_share_of_every_area() {
        // Ten points share 9 tenths of the area, ninety the rest.
        let points: Vec<DVec3> = (0..100).map(|k| DVec3::X * f64::from(k)).collect();
        let weights = (0..100).map(|k| if k < 10 { 9.0 } else { 1.0 / 9.0 }).collect();
        let samples = Samples::new(points, weights);
        let thinned = samples.thinned(50);
        assert_eq!(thinned.points.len(), 50);
        let few = thinned.points.iter().filter(|point| point.x < 9.5).count();
        assert_eq!(few, 45);
        assert!((thinned.weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_centre_and_the_gyration_are_weighted() {
        let samples = Samples::new(vec![DVec3::ZERO, DVec3::X * 4.0], vec![3.0, 1.0]);
        assert_eq!(samples.center, DVec3::X);
        // 3/4 at the distance 1, 1/4 at 3: the mean square is 3.
        assert!((samples.gyration - 3.0_f64.sqrt()).abs() < 1e-15);
        assert_eq!(samples.extent(), 3.0);
    }

    /// Of the corners of a square and two points far to one side, the corners stay, whichever comes first.
    #[test]
    fn points_far_off_do_not_shift_the_centre() {
        let far = [DVec3::new(9.0, 1.0, 4.0), DVec3::new(8.0, 1.0, -3.0)];
        let corners = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
        let corners = corners.map(|[x, y]| DVec3::new(x, y, 0.0));
        for points in [[&far[..], &corners].concat(), [&corners[..], &far].concat()] {
            let kept = Samples::new(points, vec![1.0; 6]).without_farthest(1.0 / 3.0);
            assert_eq!((kept.points.len(), kept.center), (4, DVec3::ZERO));
            assert!((kept.gyration - 2.0_f64.sqrt()).abs() < 1e-15);
        }
        let all = Samples::new(corners.to_vec(), vec![1.0; 4]);
        assert_eq!(all.without_farthest(0.0), all);
    }

    #[test]
    fn points_without_area_weigh_the_same() {
        let samples = Samples::new(vec![DVec3::ZERO, DVec3::X], vec![0.0, 0.0]);
        assert_eq!(samples.weights, [0.5, 0.5]);
    }
}
