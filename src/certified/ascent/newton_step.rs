//! One step of the ascent.

use super::super::Operand;
use super::super::maximin::{Maximin, linearized_distance_squared, maximin};
use super::super::nearest::Feet;
use super::super::reparametrization::Reparametrization;
use crate::bezier::Jet;
use glam::{DMat2, DVec2};

/// A step in A's parameters and the increase of the squared distance that its
/// model predicts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Step {
    pub(super) step: DVec2,
    pub(super) predicted_gain: f64,
}

/// The step from a point of A, at most `radius` in each parameter; `None` at a
/// corner of the patch that is a local maximum.
///
/// The trust region problem is the maximum of the minimum of the squared
/// distances to all known feet. To first order that is a [`maximin`]; where
/// three patches are equally near, its solution is Newton's method for the
/// maximum. Where the nearest patch alone carries it, second derivatives count:
/// the step is Newton's for its distance.
pub(super) fn newton_step(
    b: &Operand<'_>,
    at: [f64; 2],
    jet: &Jet,
    feet: &Feet,
    radius: f64,
) -> Option<Step> {
    let low = [0, 1].map(|axis| (-at[axis]).max(-radius));
    let high = [0, 1].map(|axis| (1.0 - at[axis]).min(radius));
    let to_first_order = feet
        .all()
        .iter()
        .map(|foot| linearized_distance_squared(jet, b.patch(foot.patch).point(foot.parameters), low, high));
    let Maximin { multipliers, argmax, value } = maximin(&to_first_order.collect::<Vec<_>>());
    let [low, high] = [low, high].map(DVec2::from_array);
    let nearest = feet.nearest().distance_squared;
    let (first, of_first) = multipliers[0];
    // The nearest patch's function is the first.
    if of_first == 1.0 && first == 0 {
        let foot = feet.nearest();
        let model = LocalModel::new(jet, &b.patch(foot.patch).jet(foot.parameters));
        let step = model.ascent_step(at, radius, jet)?.max(low).min(high);
        return Some(Step { step, predicted_gain: 2.0 * step.dot(model.gradient) });
    }
    let step = 0.5 * (low + high + DVec2::from_array(argmax) * (high - low));
    Some(Step { step, predicted_gain: value - nearest })
}

/// Half the squared distance to a patch, to second order in A's parameters.
#[derive(Debug, Clone, Copy)]
struct LocalModel {
    gradient: DVec2,
    hessian: DMat2,
}

impl LocalModel {
    /// The model at a point of A with a foot on B.
    ///
    /// The gradient is `(a - b)·A_s`, as the foot is stationary; the Hessian is
    /// `A_s·A_s + (a - b)·A_ss` less `A_s·(B_u p_u + B_v p_v)` with p the
    /// derivative of the foot.
    fn new(a: &Jet, b: &Jet) -> Self {
        let residual = a.point - b.point;
        let Reparametrization { p, q } = Reparametrization::linearized(b, -residual, [a.s, a.t], [false; 2])
            .unwrap_or(Reparametrization::CONSTANT);
        let s = a.s - p.x * b.s - p.y * b.t;
        let t = a.t - q.x * b.s - q.y * b.t;
        let [ss, st, tt] = [
            a.s.dot(s) + residual.dot(a.ss),
            a.s.dot(t) + residual.dot(a.st),
            a.t.dot(t) + residual.dot(a.tt),
        ];
        let gradient = DVec2::new(residual.dot(a.s), residual.dot(a.t));
        let hessian = DMat2::from_cols_array(&[ss, st, st, tt]);
        Self { gradient, hessian }
    }

    /// Newton's step to the maximum, along an edge where the patch of A ends;
    /// where the model has none, the direction of steepest ascent up to `radius`.
    fn ascent_step(&self, at: [f64; 2], radius: f64, a: &Jet) -> Option<DVec2> {
        let Self { gradient, hessian, .. } = *self;
        let free = [0, 1].map(|axis| {
            !((at[axis] <= 0.0 && gradient[axis] < 0.0) || (at[axis] >= 1.0 && gradient[axis] > 0.0))
        });
        let step = match free {
            [false, false] => return None,
            [true, true] if hessian.x_axis.x < 0.0 && hessian.determinant() > 0.0 => {
                hessian.inverse() * -gradient
            }
            [true, false] if hessian.x_axis.x < 0.0 => DVec2::new(-gradient.x / hessian.x_axis.x, 0.0),
            [false, true] if hessian.y_axis.y < 0.0 => DVec2::new(0.0, -gradient.y / hessian.y_axis.y),
            _ => {
                let uphill = DVec2::from_array([0, 1].map(|axis| {
                    let tangent = if axis == 0 { a.s } else { a.t };
                    let slope = gradient[axis] / tangent.length_squared().max(f64::MIN_POSITIVE);
                    if free[axis] { slope } else { 0.0 }
                }));
                uphill * (radius / uphill.abs().max_element().max(f64::MIN_POSITIVE))
            }
        };
        step.is_finite().then_some(step)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::closest::{Target, closest};
    use crate::shapes::shape;

    /// Compares with central differences of the certified distance.
    #[test]
    fn local_models_are_the_squared_distance_to_second_order() {
        let random = &mut fastrand::Rng::with_seed(8);
        let (Ok(a), Ok(b)) = (shape("wavy-sheet"), shape("torus")) else { unreachable!() };
        let (a, b) = (extract(&a).patches, Target::new(extract(&b).patches));
        let operand = Operand::new(&b, &[]);
        let mut compared = 0;
        for _ in 0..60 {
            let patch = a.patch(random.usize(..a.len()));
            let at = [0.1 + 0.8 * random.f64(), 0.1 + 0.8 * random.f64()];
            let nearest = |step: [f64; 2]| {
                let Some(found) = closest(&b, patch.point([0, 1].map(|axis| at[axis] + step[axis])), 1e-13)
                else {
                    unreachable!()
                };
                found
            };
            const STEP: f64 = 1e-3;
            let of = |i: i32, j: i32| {
                let found = nearest([f64::from(i) * STEP, f64::from(j) * STEP]);
                (found.patch, 0.5 * found.upper * found.upper)
            };
            let around: Vec<(usize, f64)> = (0..9).map(|k| of(k / 3 - 1, k % 3 - 1)).collect();
            // A model is of one patch, inside it.
            let foot = nearest([0.0; 2]);
            if around.iter().any(|(patch, _)| *patch != foot.patch)
                || foot.parameters.iter().any(|&parameter| !(0.01..=0.99).contains(&parameter))
            {
                continue;
            }
            let value = |k: usize| around[k].1;
            let gradient = DVec2::new(value(7) - value(1), value(5) - value(3)) / (2.0 * STEP);
            let mixed = (value(8) - value(6) - value(2) + value(0)) / (4.0 * STEP * STEP);
            let [ss, tt] =
                [[7, 1], [5, 3]].map(|[k, l]| (value(k) - 2.0 * value(4) + value(l)) / (STEP * STEP));
            let model =
                LocalModel::new(&patch.jet(at), &operand.patch(foot.patch as u32).jet(foot.parameters));
            let size = model.hessian.x_axis.length() + model.hessian.y_axis.length() + gradient.length();
            assert!((model.gradient - gradient).length() < 1e-4 * size, "{model:?} {gradient}");
            let hessian = DMat2::from_cols_array(&[ss, mixed, mixed, tt]);
            assert!((model.hessian - hessian).abs_diff_eq(DMat2::ZERO, 1e-3 * size), "{model:?} {hessian}");
            compared += 1;
        }
        assert!(compared > 20, "{compared}");
    }
}
