//! Rational Bézier curves: edges of patches and parts of them.

use crate::bezier::MAX_ORDER;
use glam::{DVec3, DVec4, Vec4Swizzles};

/// The number of parts, for each degree, whose ends are compared before the search for a closest point:
/// a curve turns at most about as often as its degree.
const PARTS_PER_DEGREE: usize = 4;

/// The largest number of steps of the search for a closest point from one start.
const MAX_STEPS: usize = 16;

/// The step of the iteration, in parameters, up to which a point with no nearer one beside it is the closest one but for
/// rounding.
const STATIONARY: f64 = 1e-12;

/// A rational Bézier curve: `center + (x, y, z) / w` with the Bernstein sum of the controls.
#[derive(Debug, Clone)]
pub(crate) struct Curve {
    pub(crate) center: DVec3,
    pub(crate) controls: Vec<DVec4>,
}

impl Curve {
    /// Returns the point at `t` in [0, 1].
    pub(crate) fn point(&self, t: f64) -> DVec3 {
        let sum = casteljau(&self.controls, t, |_, _| {});
        self.center + sum.xyz() / sum.w
    }

    /// Returns the control points.
    pub(crate) fn points(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.controls.iter().map(|control| self.center + control.xyz() / control.w)
    }

    /// Returns the length of the control polygon, an upper bound on that of the curve, as cutting corners
    /// makes no polygon longer.
    pub(crate) fn polygon(&self) -> f64 {
        self.points().zip(self.points().skip(1)).map(|(a, b)| a.distance(b)).sum()
    }

    /// Returns the two ends.
    pub(crate) fn ends(&self) -> [DVec3; 2] {
        let end = |control: Option<&DVec4>| control.map_or(DVec3::NAN, |end| self.center + end.xyz() / end.w);
        [end(self.controls.first()), end(self.controls.last())]
    }

    /// Returns the parts on both sides of `t`, which join in one control.
    pub(crate) fn split(&self, t: f64) -> [Self; 2] {
        let [low, high] = split(&self.controls, t);
        [Self { center: self.center, controls: low }, Self { center: self.center, controls: high }]
    }

    /// Returns the same curve from its other end.
    pub(super) fn reversed(mut self) -> Self {
        self.controls.reverse();
        self
    }

    /// Returns the parameter of a point near `target`, and their distance: an estimate of the
    /// closest one. Of a closed curve, points before its end are as good as those after its start.
    pub(crate) fn closest(&self, target: DVec3) -> (f64, f64) {
        let parts = PARTS_PER_DEGREE * (self.controls.len() - 1).max(1);
        let at = |k: usize| k as f64 / parts as f64;
        let distances: Vec<f64> = (0..=parts).map(|k| self.point(at(k)).distance(target)).collect();
        let is_least = |&k: &usize| {
            let is_less = |other: Option<&f64>| other.is_some_and(|&other| other < distances[k]);
            !is_less(distances.get(k + 1)) && !is_less(k.checked_sub(1).map(|before| &distances[before]))
        };
        let starts = (0..=parts).filter(is_least);
        let found = starts.map(|k| self.descended((at(k), distances[k]), target, 0.5 / parts as f64));
        found.fold((0.0, f64::INFINITY), |least, next| if next.1 < least.1 { next } else { least })
    }

    /// Returns a parameter at which the distance from `target` is less, from one with its distance.
    fn descended(&self, (mut t, mut best): (f64, f64), target: DVec3, mut step: f64) -> (f64, f64) {
        for _ in 0..MAX_STEPS {
            let next = self.step(t, target);
            let newton = if next.is_nan() { t } else { next };
            let tries = [newton, t + step, t - step].map(|t| t.clamp(0.0, 1.0));
            let next = tries.map(|t| (t, self.point(t).distance(target)));
            let next =
                next.into_iter().fold((t, best), |least, next| if next.1 < least.1 { next } else { least });
            if next.0 == t {
                if (newton - t).abs() <= STATIONARY {
                    break;
                }
                step *= 0.25;
            }
            (t, best) = next;
        }
        (t, best)
    }

    /// Returns the next parameter of the iteration of Gauss and Newton toward the point closest to
    /// `target`; NaN at a cusp.
    pub(super) fn step(&self, t: f64, target: DVec3) -> f64 {
        let degree = (self.controls.len() - 1) as f64;
        let mut last = [DVec4::ZERO; 2];
        let sum = casteljau(&self.controls, t, |low, high| last = [low, high]);
        let derivative = degree * (last[1] - last[0]);
        let offset = sum.xyz() / sum.w;
        let slope = (derivative.xyz() - derivative.w * offset) / sum.w;
        t + (target - self.center - offset).dot(slope) / slope.length_squared()
    }
}

/// The number of controls of a conic and of a cubic at most: most edges have no more, and a small array takes less time to
/// fill than one for the largest order.
const FEW_CONTROLS: usize = 4;

/// Evaluates a curve; `last` receives the two controls of the last step but one.
fn casteljau(controls: &[DVec4], t: f64, last: impl FnMut(DVec4, DVec4)) -> DVec4 {
    if controls.len() <= FEW_CONTROLS {
        casteljau_in::<FEW_CONTROLS>(controls, t, last)
    } else {
        casteljau_in::<MAX_ORDER>(controls, t, last)
    }
}

/// As [`casteljau`], of at most `N` controls.
fn casteljau_in<const N: usize>(controls: &[DVec4], t: f64, mut last: impl FnMut(DVec4, DVec4)) -> DVec4 {
    let mut values = [DVec4::ZERO; N];
    values[..controls.len()].copy_from_slice(controls);
    for level in (1..controls.len()).rev() {
        if level == 1 {
            last(values[0], values[1]);
        }
        for index in 0..level {
            values[index] = (1.0 - t) * values[index] + t * values[index + 1];
        }
    }
    values[0]
}

/// Returns the controls of the parts of a curve on both sides of `t`.
pub(super) fn split(controls: &[DVec4], t: f64) -> [Vec<DVec4>; 2] {
    let (mut low, mut high) = (controls.to_vec(), controls.to_vec());
    for (level, end) in low.iter_mut().enumerate().skip(1) {
        for index in 0..controls.len() - level {
            high[index] = (1.0 - t) * high[index] + t * high[index + 1];
        }
        *end = high[0];
    }
    [low, high]
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// A closed curve, y = 0 at both ends, where it is smooth or has a corner; points of it just before
    /// its end are nearest to its end and to its start among the points compared at first.
    #[test]
    fn points_on_both_sides_of_the_seam_of_a_closed_curve_are_found() {
        let points = [[0.0, 0.0], [3.0, 1.0], [1.0, 5.0], [-4.0, 4.0], [-3.0, -1.0], [0.0, 0.0]];
        let controls = points.map(|[x, y]| DVec3::new(x, y, 0.0).extend(1.0)).to_vec();
        let curve = Curve { center: DVec3::ZERO, controls };
        for t in [1e-4, 3e-3, 0.02, 0.1, 0.37, 0.5, 0.77, 0.9, 0.98, 1.0 - 3e-3, 1.0 - 1e-4] {
            let (found, distance) = curve.closest(curve.point(t));
            assert!((found - t).abs() < 1e-9 && distance < 1e-9, "{found} for {t}: {distance:e}");
        }
    }

    /// The wave of a curve of degree 14: each of its points is found.
    #[test]
    fn points_of_a_curve_of_high_degree_are_found() {
        let control = |k: usize| DVec4::new(0.1 * k as f64, [3.0, -3.0][k % 2], [2.0, -1.0, 1.0][k % 3], 1.0);
        let curve = Curve { center: DVec3::ZERO, controls: (0..=14).map(control).collect() };
        for index in 0..=1000 {
            let (_, distance) = curve.closest(curve.point(f64::from(index) / 1000.0));
            assert!(distance < 1e-9, "{index}: {distance:e}");
        }
    }
}
