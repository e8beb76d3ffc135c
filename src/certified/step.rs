//! Stage `step`: where a climb goes next.

use super::Operand;
use super::balance::{Balance, balance, plane_of_distance};
use super::feet::Feet;
use super::foot_map::FootMap;
use crate::bezier::Jet;
use glam::{DMat2, DVec2};

/// A step from parameters of A, in each of at most `reach`, and by how much it
/// promises to raise the squared distance; `None` at a corner that is the
/// highest place about.
///
/// To the highest place under the planes of all feet ([`balance`]): where three
/// patches are equally near, that is Newton's method for it. Where one patch or
/// two carry the place, their curvature tells more: Newton's step to the
/// highest place of the one, or of the ridge where both are equally far.
pub(super) fn step(
    b: &Operand<'_>,
    at: [f64; 2],
    jet: &Jet,
    feet: &Feet,
    reach: f64,
) -> Option<(DVec2, f64)> {
    let low = [0, 1].map(|axis| (-at[axis]).max(-reach));
    let high = [0, 1].map(|axis| (1.0 - at[axis]).min(reach));
    let mut planes = Vec::with_capacity(feet.all().len());
    for foot in feet.all() {
        planes.push(plane_of_distance(jet, b.patch(foot.patch).point(foot.parameters), low, high));
    }
    let Balance { weights, place, height } = balance(&planes);
    let [low, high] = [low, high].map(DVec2::from_array);
    let nearest = feet.nearest().distance_squared;
    let hill = |index: usize| {
        let foot = &feet.all()[index];
        Hill::new(jet, &b.patch(foot.patch).jet(foot.parameters))
    };
    let [(first, of_first), (second, _), (_, of_third)] = weights;
    // The nearest patch's is the first plane.
    if of_first == 1.0 && first == 0 {
        let hill = hill(0);
        let step = hill.ascent(at, reach, jet)?.max(low).min(high);
        return Some((step, 2.0 * step.dot(hill.gradient)));
    }
    if of_first < 1.0 && of_third == 0.0 {
        let (step, value) = ridge(hill(first), hill(second));
        if step == step.max(low).min(high) {
            return Some((step, 2.0 * value - nearest));
        }
    }
    let place = DVec2::from_array(place);
    Some((0.5 * (low + high + place * (high - low)), height - nearest))
}

/// Half the squared distance to a patch, to second order in A's parameters.
#[derive(Debug, Clone, Copy)]
struct Hill {
    value: f64,
    gradient: DVec2,
    hessian: DMat2,
}

impl Hill {
    /// Between a point and its foot.
    ///
    /// The gradient is `(a - b)·A_s`, the foot's own change adding nothing as it
    /// is stationary; the Hessian is `A_s·A_s + (a - b)·A_ss` less what the foot
    /// gains by following, `A_s·(B_u p_u + B_v p_v)` with p its derivative.
    fn new(a: &Jet, b: &Jet) -> Self {
        let way = a.point - b.point;
        let FootMap { p, q, .. } =
            FootMap::linearised(b, -way, [a.s, a.t], [false; 2]).unwrap_or(FootMap::CONSTANT);
        let s = a.s - p.x * b.s - p.y * b.t;
        let t = a.t - q.x * b.s - q.y * b.t;
        let [ss, st, tt] =
            [a.s.dot(s) + way.dot(a.ss), a.s.dot(t) + way.dot(a.st), a.t.dot(t) + way.dot(a.tt)];
        let gradient = DVec2::new(way.dot(a.s), way.dot(a.t));
        let hessian = DMat2::from_cols_array(&[ss, st, st, tt]);
        Self { value: 0.5 * way.length_squared(), gradient, hessian }
    }

    /// Newton's step to the highest place, along an edge where the patch of A
    /// ends, else one uphill that goes as far as `reach`.
    fn ascent(&self, at: [f64; 2], reach: f64, a: &Jet) -> Option<DVec2> {
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
                    let along = if axis == 0 { a.s } else { a.t };
                    let slope = gradient[axis] / along.length_squared().max(f64::MIN_POSITIVE);
                    if free[axis] { slope } else { 0.0 }
                }));
                uphill * (reach / uphill.abs().max_element().max(f64::MIN_POSITIVE))
            }
        };
        step.is_finite().then_some(step)
    }
}

/// Newton's step to the highest place of the ridge on which two hills are
/// equally high, and how high that is; no number where the ridge has none.
///
/// To first order the ridge is a line. Along it both hills rise alike, and bend
/// like their mean with the weights for which its gradient is least: 0 at a
/// maximum of the lower one, where the way the ridge itself turns does not count.
fn ridge(one: Hill, two: Hill) -> (DVec2, f64) {
    let across = one.gradient - two.gradient;
    let length_squared = across.length_squared();
    let weight = (-two.gradient.dot(across) / length_squared).clamp(0.0, 1.0);
    let gradient = two.gradient + weight * across;
    let hessian = two.hessian + (one.hessian - two.hessian) * weight;
    let onto = across * ((two.value - one.value) / length_squared);
    let along = across.perp();
    // Without a highest place it is infinitely far.
    let bend = along.dot(hessian * along).min(0.0);
    let step = onto - along * ((gradient + hessian * onto).dot(along) / bend);
    (step, one.value + step.dot(one.gradient + 0.5 * (hessian * step)))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::closest::{Target, closest};
    use crate::shapes::shape;

    /// A hill about another place.
    fn moved(hill: Hill, step: DVec2) -> Hill {
        let Hill { value, gradient, hessian } = hill;
        let value = value + step.dot(gradient + 0.5 * (hessian * step));
        Hill { value, gradient: gradient + hessian * step, hessian }
    }

    /// Newton's steps from ridge to ridge end at the highest place under two
    /// hills, which is the lowest of their weighted means' tops.
    #[test]
    fn steps_along_a_ridge_lead_to_its_highest_place() {
        let random = &mut fastrand::Rng::with_seed(3);
        let (mut ridges, mut reached) = (0, 0);
        for _ in 0..300 {
            let mut number = || 2.0 * random.f64() - 1.0;
            let mut hill = || {
                let root = DMat2::from_cols_array(&[(); 4].map(|()| number()));
                let hessian = -(root * root.transpose() + 0.3 * DMat2::IDENTITY);
                Hill { value: number(), gradient: DVec2::new(number(), number()), hessian }
            };
            let (one, two) = (hill(), hill());
            let top = |weight: f64| {
                let gradient = weight * one.gradient + (1.0 - weight) * two.gradient;
                let hessian = one.hessian * weight + two.hessian * (1.0 - weight);
                let rise = -0.5 * gradient.dot(hessian.inverse() * gradient);
                weight * one.value + (1.0 - weight) * two.value + rise
            };
            let lowest =
                (0..=1_000).map(|k| (top(f64::from(k) * 1e-3), k)).min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((expected, weight)) = lowest else { unreachable!() };
            if !(50..=950).contains(&weight) {
                continue;
            }
            let (mut first, mut second) = (one, two);
            for _ in 0..30 {
                let (step, _) = ridge(first, second);
                let step = step.clamp_length_max(1.0);
                (first, second) = (moved(first, step), moved(second, step));
            }
            // A grid of weights tells the lowest top to about 1e-6 of the hills' size.
            ridges += 1;
            reached += usize::from((first.value.min(second.value) - expected).abs() < 1e-5);
        }
        // Steps are not shortened here where they lead lower, as a climb's are.
        assert!(ridges > 100 && reached * 20 > ridges * 19, "{reached} of {ridges}");
    }

    /// As central differences of the certified distance have it.
    #[test]
    fn hills_are_the_squared_distance_to_second_order() {
        let random = &mut fastrand::Rng::with_seed(8);
        let (Ok(a), Ok(b)) = (shape("wavy-sheet"), shape("torus")) else { unreachable!() };
        let (a, b) = (extract(&a).patches, Target::new(extract(&b).patches));
        let side = Operand::new(&b, &[]);
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
            // A hill is of one patch, inside it.
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
            let hill = Hill::new(&patch.jet(at), &side.patch(foot.patch as u32).jet(foot.parameters));
            let size = hill.hessian.x_axis.length() + hill.hessian.y_axis.length() + gradient.length();
            assert!((hill.gradient - gradient).length() < 1e-4 * size, "{hill:?} {gradient}");
            let hessian = DMat2::from_cols_array(&[ss, mixed, mixed, tt]);
            assert!((hill.hessian - hessian).abs_diff_eq(DMat2::ZERO, 1e-3 * size), "{hill:?} {hessian}");
            compared += 1;
        }
        assert!(compared > 20, "{compared}");
    }
}
