//! Searches for nearest points, on which no bound depends.

use super::Lifted;
use glam::DVec3;

/// The Gauss-Newton steps towards a nearest point.
const NEAREST_STEPS: usize = 3;

/// Stop when a step is below this fraction of the range.
const SMALL_STEP: f64 = 1e-8;

/// Part of a range over which a difference quotient is taken.
const DIFFERENCE: f64 = 1e-6;

/// Returns the parameter of a point of a curve near `target`, by Gauss-Newton steps within a
/// range from the nearer one of two starts. `jet` returns a point and the derivative.
pub(super) fn nearest(
    target: DVec3,
    starts: [f64; 2],
    range: [f64; 2],
    jet: impl Fn(f64) -> [DVec3; 2],
) -> f64 {
    let [low, high] = [range[0].min(range[1]), range[0].max(range[1])];
    let distance = |at: f64| target.distance_squared(jet(at)[0]);
    let other = starts[1].clamp(low, high);
    let is_nearer = starts[0] != other && distance(other) < distance(starts[0]);
    let mut nearest = if is_nearer { other } else { starts[0] };
    let (mut least, mut found) = (f64::INFINITY, nearest);
    for _ in 0..=NEAREST_STEPS {
        let [point, tangent] = jet(nearest);
        let difference = target - point;
        let distance = difference.length();
        if distance < least {
            (least, found) = (distance, nearest);
        }
        let step = difference.dot(tangent) / tangent.length_squared();
        if !step.is_finite() {
            break;
        }
        nearest = (nearest + step).clamp(low, high);
        if step.abs() <= SMALL_STEP * (high - low) {
            return nearest;
        }
    }
    found
}

impl Lifted<'_> {
    /// Returns the parameter of the edge that an affine map of the ranges assigns to one of the
    /// curve: most curves have the parameters of their edges.
    pub(super) fn corresponding(&self, t: f64) -> f64 {
        let ([t0, t1], [s0, s1]) = (self.range, self.edge_range);
        s0 + (s1 - s0) * ((t - t0) / (t1 - t0))
    }

    /// Returns the parameter of a point of the edge near a point of the curve, from `s`.
    pub(super) fn nearest(&self, t: f64, s: f64, range: [f64; 2]) -> f64 {
        let jet = |s: f64| {
            let [point, tangent] = self.edge.jet(s);
            [self.edge_location.transform_point3(point), self.edge_location.transform_vector3(tangent)]
        };
        nearest(self.on_surface(t), [s, self.corresponding(t)], range, jet)
    }

    /// Returns the parameter of a point of the curve near a point of the edge, from `t`.
    pub(super) fn nearest_on_curve(&self, s: f64, t: f64, [low, high]: [f64; 2]) -> f64 {
        let ([t0, t1], [s0, s1]) = (self.range, self.edge_range);
        let other = t0 + (t1 - t0) * ((s - s0) / (s1 - s0));
        let jet = |t: f64| {
            let beside = t + DIFFERENCE * (if t - low < high - t { high } else { low } - t);
            let point = self.on_surface(t);
            [point, (self.on_surface(beside) - point) / (beside - t)]
        };
        nearest(self.on_edge(s), [t, other], [low, high], jet)
    }
}
