//! Rational Bézier curves: edges of patches and parts of them.

use glam::{DVec3, DVec4, Vec4Swizzles};

/// The number of parts at whose ends the search for a closest point starts.
const STARTS: usize = 8;

/// The largest number of steps of the search for a closest point.
const MAX_STEPS: usize = 16;

/// A rational Bézier curve: `center + (x, y, z) / w` with the Bernstein sum of the controls.
#[derive(Debug, Clone)]
pub(super) struct Curve {
    pub(super) center: DVec3,
    pub(super) controls: Vec<DVec4>,
}

impl Curve {
    /// Returns the point at `t` in [0, 1].
    pub(super) fn point(&self, t: f64) -> DVec3 {
        let sum = casteljau(&self.controls, t, |_, _| {});
        self.center + sum.xyz() / sum.w
    }

    /// Returns the control points.
    pub(super) fn points(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.controls.iter().map(|control| self.center + control.xyz() / control.w)
    }

    /// Returns the two ends.
    pub(super) fn ends(&self) -> [DVec3; 2] {
        [self.point(0.0), self.point(1.0)]
    }

    /// Returns the parts on both sides of `t`, which join in one control.
    pub(super) fn split(&self, t: f64) -> [Self; 2] {
        let [low, high] = split(&self.controls, t);
        [Self { center: self.center, controls: low }, Self { center: self.center, controls: high }]
    }

    /// Returns the same curve from its other end.
    pub(super) fn reversed(mut self) -> Self {
        self.controls.reverse();
        self
    }

    /// Returns the parameter of a point near `target`, and their distance: an estimate of the
    /// closest one.
    pub(super) fn closest(&self, target: DVec3) -> (f64, f64) {
        let at = |k: usize| k as f64 / STARTS as f64;
        let distance = |t: f64| self.point(t).distance(target);
        let nearest = (0..=STARTS).map(|k| (at(k), distance(at(k))));
        let (mut t, mut best) =
            nearest.fold((0.0, f64::INFINITY), |least, next| if next.1 < least.1 { next } else { least });
        let mut step = 0.5 / STARTS as f64;
        for _ in 0..MAX_STEPS {
            let next = self.step(t, target);
            let newton = if next.is_nan() { t } else { next };
            let tries = [newton, t + step, t - step].map(|t| t.clamp(0.0, 1.0));
            let next = tries.map(|t| (t, distance(t)));
            let next =
                next.into_iter().fold((t, best), |least, next| if next.1 < least.1 { next } else { least });
            if next.0 == t {
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

/// Evaluates a curve; `last` receives the two controls of the last step but one.
fn casteljau(controls: &[DVec4], t: f64, mut last: impl FnMut(DVec4, DVec4)) -> DVec4 {
    let mut values = [DVec4::ZERO; crate::bezier::MAX_ORDER];
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
