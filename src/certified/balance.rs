//! The highest place under several planes over a square, and the weights with
//! which they balance there.

use crate::bezier::Jet;
use glam::DVec3;

/// `(v, s, t)`: `v + σ s + τ t` over (σ, τ) in [-1, 1]^2.
pub(super) type Plane = DVec3;

/// `|A - point|²` to first order over the steps from `low` to `high` in A's
/// parameters, given A's jet.
pub(super) fn plane_of_distance(a: &Jet, point: DVec3, low: [f64; 2], high: [f64; 2]) -> Plane {
    let way = a.point - point;
    let [s, t] = [way.dot(a.s), way.dot(a.t)];
    DVec3::new(
        way.length_squared() + s * (high[0] + low[0]) + t * (high[1] + low[1]),
        s * (high[0] - low[0]),
        t * (high[1] - low[1]),
    )
}

/// Where the least of some planes is largest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Balance {
    /// Up to three planes and weights of sum 1, unused ones 0. The weighted
    /// mean of these planes is nowhere above the height.
    pub(super) weights: [(usize, f64); 3],
    /// (σ, τ).
    pub(super) place: [f64; 2],
    pub(super) height: f64,
}

/// Planes exchanged, at most: a few suffice, and weights of any are valid.
const EXCHANGES: usize = 16;

/// Part of the heights' size that the least plane may be below the balance for
/// it to be the best.
const HEIGHT_ROUNDING: f64 = 1e-14;

/// The largest least height of the planes, which are at least one.
///
/// By exchange: the balance of a few planes is the least mean that weights give
/// ([`of_few`]); the plane lowest at its place joins those that carry it.
pub(super) fn balance(planes: &[Plane]) -> Balance {
    let mut few = vec![lowest(planes, [0.0; 2]).0];
    let mut best = of_few(planes, &few);
    for _ in 1..EXCHANGES {
        let (index, height) = lowest(planes, best.place);
        if few.contains(&index) || height >= best.height - HEIGHT_ROUNDING * best.height.abs() {
            break;
        }
        few.clear();
        for (carrier, weight) in best.weights {
            if weight > 0.0 {
                few.push(carrier);
            }
        }
        few.push(index);
        best = of_few(planes, &few);
    }
    best
}

/// The plane lowest at a place, and its height there.
fn lowest(planes: &[Plane], [s, t]: [f64; 2]) -> (usize, f64) {
    let mut lowest = (0, f64::INFINITY);
    for (index, plane) in planes.iter().enumerate() {
        let height = plane.dot(DVec3::new(1.0, s, t));
        if height < lowest.1 {
            lowest = (index, height);
        }
    }
    lowest
}

/// A place's coordinate where the mean plane is as high as it gets.
const FREE: f64 = f64::NAN;

/// The balance of few planes, by trying all ways to carry it.
///
/// By duality of linear programs the largest least height is the smallest of
/// `Σ λ v + |Σ λ s| + |Σ λ t|` over weights λ, which is taken by one plane, by
/// two that even out one slope, or by three that even out both.
fn of_few(planes: &[Plane], few: &[usize]) -> Balance {
    let first = few[0];
    let alone = [(first, 1.0), (first, 0.0), (first, 0.0)];
    let mut best = Balance { weights: alone, place: [0.0; 2], height: f64::INFINITY };
    for (place, &i) in few.iter().enumerate() {
        let one = planes[i];
        best.offer(planes, [(i, 1.0), (i, 0.0), (i, 0.0)], [FREE; 2]);
        for (next, &j) in few.iter().enumerate().skip(place + 1) {
            let two = planes[j];
            let apart = one - two;
            for axis in 0..2 {
                let [along, across] = [1 + axis, 2 - axis];
                let weight = -two[along] / apart[along];
                let side = (weight * one[across] + (1.0 - weight) * two[across]).signum();
                let even = -(apart.x + apart[across] * side) / apart[along];
                let place = [0, 1].map(|a| if a == axis { even } else { FREE });
                best.offer(planes, [(i, weight), (j, 1.0 - weight), (i, 0.0)], place);
            }
            for &l in few.iter().skip(next + 1) {
                let three = planes[l];
                // The three planes meet where both differences vanish.
                let [p, q] = [one - three, two - three];
                let meeting = p.cross(q);
                let of_one = (three.z * q.y - three.y * q.z) / meeting.x;
                let of_two = (three.y * p.z - three.z * p.y) / meeting.x;
                let place = [meeting.y / meeting.x, meeting.z / meeting.x];
                best.offer(planes, [(i, of_one), (j, of_two), (l, 1.0 - of_one - of_two)], place);
            }
        }
    }
    best
}

impl Balance {
    /// Takes these weights if their mean is lower.
    fn offer(&mut self, planes: &[Plane], weights: [(usize, f64); 3], place: [f64; 2]) {
        let mut mean = DVec3::ZERO;
        let mut valid = true;
        for (index, weight) in weights {
            mean += weight * planes[index];
            valid &= weight >= 0.0;
        }
        let height = mean.x + mean.y.abs() + mean.z.abs();
        if valid && height < self.height {
            let slope = [mean.y, mean.z];
            let place =
                [0, 1].map(|axis| if place[axis].is_nan() { slope[axis].signum() } else { place[axis] });
            *self = Self { weights, place, height };
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// No grid point is higher under all planes, no weighted mean of those told
    /// is higher than told, and the place is as high.
    #[test]
    fn balance_is_the_highest_place_under_all_planes() {
        let random = &mut fastrand::Rng::with_seed(5);
        let mut several = 0;
        for _ in 0..500 {
            let mut number = || 2.0 * random.f64() - 1.0;
            let count = 1 + (15.0 * number().abs()) as usize;
            let planes: Vec<Plane> = (0..count).map(|_| DVec3::new(number(), number(), number())).collect();
            let height = |plane: &Plane, [s, t]: [f64; 2]| plane.x + s * plane.y + t * plane.z;
            let least = |place| planes.iter().map(|plane| height(plane, place)).fold(f64::INFINITY, f64::min);
            let Balance { weights, place, height: told } = balance(&planes);
            assert!(place.iter().all(|x| x.abs() <= 1.0 + 1e-9), "{place:?}");
            assert!((least(place) - told).abs() < 1e-9, "{planes:?}");
            assert!((weights.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-12);
            let grid = |k: usize| k as f64 / 20.0 - 1.0;
            for at in (0..41 * 41).map(|k| [grid(k / 41), grid(k % 41)]) {
                let mean: f64 = weights.iter().map(|(k, weight)| weight * height(&planes[*k], at)).sum();
                assert!(least(at) <= told + 1e-9 && mean <= told + 1e-9);
            }
            several += usize::from(weights.iter().all(|(_, weight)| *weight > 0.0));
        }
        assert!(several > 50, "{several}");
    }

    /// Weights have sum 1 even where no mean can be told, so that what they weigh is a bound.
    #[test]
    fn weights_of_planes_without_numbers_have_sum_1() {
        for number in [f64::NAN, f64::INFINITY, f64::MAX] {
            let planes = [DVec3::splat(number); 4];
            let sum: f64 = balance(&planes).weights.iter().map(|(_, weight)| weight).sum();
            assert!(sum == 1.0, "{number}: {sum}");
        }
    }
}
