//! The maximum over a square of the minimum of several affine functions: a
//! linear program in two variables, solved with its dual multipliers.

use crate::bezier::Jet;
use glam::DVec3;

/// `(v, s, t)`: `v + σ s + τ t` over (σ, τ) in [-1, 1]^2.
pub(super) type AffineFunction = DVec3;

/// `|A - point|²` to first order over the steps from `low` to `high` in A's
/// parameters, given A's jet.
pub(super) fn linearized_distance_squared(
    a: &Jet,
    point: DVec3,
    low: [f64; 2],
    high: [f64; 2],
) -> AffineFunction {
    let residual = a.point - point;
    let [s, t] = [residual.dot(a.s), residual.dot(a.t)];
    DVec3::new(
        residual.length_squared() + s * (high[0] + low[0]) + t * (high[1] + low[1]),
        s * (high[0] - low[0]),
        t * (high[1] - low[1]),
    )
}

/// The solution of the linear program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Maximin {
    /// Up to three functions and their multipliers, which have sum 1; unused
    /// ones are 0. The convex combination of these functions exceeds `value`
    /// nowhere on the square.
    pub(super) multipliers: [(usize, f64); 3],
    /// (σ, τ).
    pub(super) argmax: [f64; 2],
    pub(super) value: f64,
}

/// Bound on the exchanges: a few suffice, and any multipliers are valid.
const MAX_EXCHANGES: usize = 16;

/// Rounding of a value, relative to it: the minimum at the maximizer of the
/// active set may be lower by so much and the set still be optimal.
const VALUE_ROUNDING: f64 = 1e-14;

/// Solves the program for at least one function.
///
/// Exchange algorithm: the solution for a few functions is their convex
/// combination of least maximum ([`solve_active`]); the function that is lowest
/// at its maximizer joins those with positive multipliers.
pub(super) fn maximin(functions: &[AffineFunction]) -> Maximin {
    let mut active = vec![lowest(functions, [0.0; 2]).0];
    let mut best = solve_active(functions, &active);
    for _ in 1..MAX_EXCHANGES {
        let (index, value) = lowest(functions, best.argmax);
        if active.contains(&index) || value >= best.value - VALUE_ROUNDING * best.value.abs() {
            break;
        }
        active.clear();
        active.extend(best.multipliers.iter().filter(|(_, weight)| *weight > 0.0).map(|(index, _)| index));
        active.push(index);
        best = solve_active(functions, &active);
    }
    best
}

/// The function that is lowest at a place, and its value there.
fn lowest(functions: &[AffineFunction], [s, t]: [f64; 2]) -> (usize, f64) {
    let mut lowest = (0, f64::INFINITY);
    for (index, function) in functions.iter().enumerate() {
        let value = function.dot(DVec3::new(1.0, s, t));
        if value < lowest.1 {
            lowest = (index, value);
        }
    }
    lowest
}

/// A coordinate of the maximizer that the sign of the combination's slope decides.
const FREE: f64 = f64::NAN;

/// The solution for a few functions, by all vertices of the dual.
///
/// By duality of linear programs the maximin is the least of
/// `Σ λ v + |Σ λ s| + |Σ λ t|` over multipliers λ, which is attained by one
/// function, by two whose combination has one slope 0, or by three whose
/// combination has both slopes 0.
fn solve_active(functions: &[AffineFunction], active: &[usize]) -> Maximin {
    let first = active[0];
    let alone = [(first, 1.0), (first, 0.0), (first, 0.0)];
    let mut best = Maximin { multipliers: alone, argmax: [0.0; 2], value: f64::INFINITY };
    for (place, &i) in active.iter().enumerate() {
        let one = functions[i];
        best.improve(functions, [(i, 1.0), (i, 0.0), (i, 0.0)], [FREE; 2]);
        for (next, &j) in active.iter().enumerate().skip(place + 1) {
            let two = functions[j];
            let difference = one - two;
            for axis in 0..2 {
                let [along, across] = [1 + axis, 2 - axis];
                let weight = -two[along] / difference[along];
                let side = (weight * one[across] + (1.0 - weight) * two[across]).signum();
                let level = -(difference.x + difference[across] * side) / difference[along];
                let argmax = [0, 1].map(|a| if a == axis { level } else { FREE });
                best.improve(functions, [(i, weight), (j, 1.0 - weight), (i, 0.0)], argmax);
            }
            for &l in active.iter().skip(next + 1) {
                let three = functions[l];
                // The three functions are equal where both differences vanish.
                let [p, q] = [one - three, two - three];
                let meeting = p.cross(q);
                let of_one = (three.z * q.y - three.y * q.z) / meeting.x;
                let of_two = (three.y * p.z - three.z * p.y) / meeting.x;
                let argmax = [meeting.y / meeting.x, meeting.z / meeting.x];
                best.improve(functions, [(i, of_one), (j, of_two), (l, 1.0 - of_one - of_two)], argmax);
            }
        }
    }
    best
}

impl Maximin {
    /// Takes these multipliers if they are feasible and their combination has a smaller maximum.
    fn improve(&mut self, functions: &[AffineFunction], multipliers: [(usize, f64); 3], argmax: [f64; 2]) {
        let mut combination = DVec3::ZERO;
        let mut feasible = true;
        for (index, weight) in multipliers {
            combination += weight * functions[index];
            feasible &= weight >= 0.0;
        }
        let value = combination.x + combination.y.abs() + combination.z.abs();
        if feasible && value < self.value {
            let slope = [combination.y, combination.z];
            let argmax =
                [0, 1].map(|axis| if argmax[axis].is_nan() { slope[axis].signum() } else { argmax[axis] });
            *self = Self { multipliers, argmax, value };
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// Compares with a grid: no point is higher under all functions, the
    /// combination never exceeds the value, and the maximizer attains it.
    #[test]
    fn maximin_is_the_maximum_of_the_minimum() {
        let random = &mut fastrand::Rng::with_seed(5);
        let mut with_three = 0;
        for _ in 0..500 {
            let mut number = || 2.0 * random.f64() - 1.0;
            let count = 1 + (15.0 * number().abs()) as usize;
            let functions: Vec<AffineFunction> =
                (0..count).map(|_| DVec3::new(number(), number(), number())).collect();
            let evaluate =
                |function: &AffineFunction, [s, t]: [f64; 2]| function.x + s * function.y + t * function.z;
            let least = |place| {
                functions.iter().map(|function| evaluate(function, place)).fold(f64::INFINITY, f64::min)
            };
            let Maximin { multipliers, argmax, value } = maximin(&functions);
            assert!(argmax.iter().all(|x| x.abs() <= 1.0 + 1e-9), "{argmax:?}");
            assert!((least(argmax) - value).abs() < 1e-9, "{functions:?}");
            assert!((multipliers.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-12);
            let grid = |k: usize| k as f64 / 20.0 - 1.0;
            for at in (0..41 * 41).map(|k| [grid(k / 41), grid(k % 41)]) {
                let combination: f64 =
                    multipliers.iter().map(|(k, weight)| weight * evaluate(&functions[*k], at)).sum();
                assert!(least(at) <= value + 1e-9 && combination <= value + 1e-9);
            }
            with_three += usize::from(multipliers.iter().all(|(_, weight)| *weight > 0.0));
        }
        assert!(with_three > 50, "{with_three}");
    }

    /// The multipliers have sum 1 even where functions are NaN or infinite, so
    /// that their combination of upper bounds stays an upper bound.
    #[test]
    fn multipliers_have_sum_1_whatever_the_functions() {
        for number in [f64::NAN, f64::INFINITY, f64::MAX] {
            let functions = [DVec3::splat(number); 4];
            let sum: f64 = maximin(&functions).multipliers.iter().map(|(_, weight)| weight).sum();
            assert!(sum == 1.0, "{number}: {sum}");
        }
    }
}
