//! Interval operations against exact results.

use super::exact::Exact;
use crate::proof::interval::Interval;
use fastrand::Rng;

/// Exponents of two numbers whose exact sum fits into [`Exact`] differ by less.
const MAX_EXPONENT_GAP: f64 = 60.0;

/// A number of any size and sign, often at an end of float64's range.
fn number(rng: &mut Rng) -> f64 {
    const SPECIAL: [f64; 9] = [0.0, 1.0, -1.0, f64::MAX, f64::MIN, f64::MIN_POSITIVE, 5e-324, -5e-324, 0.1];
    match rng.u8(0..4) {
        0 => SPECIAL[rng.usize(0..SPECIAL.len())],
        1 => rng.f64() * 2.0 - 1.0,
        _ => loop {
            let value = f64::from_bits(rng.u64(..));
            if value.is_finite() {
                break value;
            }
        },
    }
}

/// Whether an interval contains an exact number; infinite ends are beyond all numbers.
fn contains(interval: Interval, value: Exact) -> bool {
    let above_lo = interval.lo == f64::NEG_INFINITY || Exact::from(interval.lo).is_at_most(value);
    let below_hi = interval.hi == f64::INFINITY || value.is_at_most(Exact::from(interval.hi));
    above_lo && below_hi
}

/// Whether the interval moved inwards by two numbers at each end leaves the value out or touches it,
/// so that it is no wider than directed rounding and one number more make it.
fn is_tight(interval: Interval, value: Exact) -> bool {
    let [lo, hi] = [interval.lo.next_up().next_up(), interval.hi.next_down().next_down()];
    let finite = interval.lo.is_finite() && interval.hi.is_finite();
    !finite || (value.is_at_most(Exact::from(lo)) && Exact::from(hi).is_at_most(value))
}

#[test]
fn sums_and_products_round_outward() {
    let mut rng = Rng::with_seed(15);
    let mut sums = 0;
    for _ in 0..200_000 {
        let (x, y) = (number(&mut rng), number(&mut rng));
        let [a, b] = [x, y].map(Interval::point);
        let product = Exact::from(x) * Exact::from(y);
        assert!(contains(a * b, product) && is_tight(a * b, product), "{x:e} * {y:e}");
        let square = Exact::from(x) * Exact::from(x);
        assert!(contains(a.square(), square), "square of {x:e}");
        // The second number at a size like the first one's, so that the sum is exact.
        let near = x * (rng.f64() * 4.0 - 2.0) * rng.f64();
        let gap = if x == 0.0 || near == 0.0 { 0.0 } else { (x.abs().log2() - near.abs().log2()).abs() };
        if near.is_finite() && gap < MAX_EXPONENT_GAP {
            sums += 1;
            let b = Interval::point(near);
            let (sum, difference) = (Exact::from(x) + Exact::from(near), Exact::from(x) + Exact::from(-near));
            assert!(contains(a + b, sum) && is_tight(a + b, sum), "{x:e} + {near:e}");
            assert!(contains(a - b, difference) && is_tight(a - b, difference), "{x:e} - {near:e}");
        }
    }
    assert!(sums > 100_000, "{sums}");
}

/// A quotient lies between the ends if x lies between their products with y, a root if x lies
/// between their squares.
#[test]
fn quotients_and_roots_round_outward() {
    let mut rng = Rng::with_seed(17);
    for _ in 0..200_000 {
        let (x, y) = (number(&mut rng), number(&mut rng).abs());
        if y > 0.0 {
            let found = Interval::point(x) / Interval::point(y);
            let times = |end: f64| Exact::from(end) * Exact::from(y);
            let above_lo = found.lo == f64::NEG_INFINITY || times(found.lo).is_at_most(Exact::from(x));
            let below_hi = found.hi == f64::INFINITY || Exact::from(x).is_at_most(times(found.hi));
            assert!(above_lo && below_hi, "{x:e} / {y:e}: {found:?}");
            let mirrored = Interval::point(x) / Interval::point(-y);
            assert_eq!(mirrored, -found, "{x:e} / {y:e}");
        }
        let size = x.abs();
        let root = Interval::point(size).sqrt();
        let square = |end: f64| Exact::from(end) * Exact::from(end);
        let [lo, hi] = [root.lo, root.hi].map(square);
        assert!(lo.is_at_most(Exact::from(size)) && Exact::from(size).is_at_most(hi), "root of {size:e}");
    }
}

/// Operations on intervals contain the results of all numbers inside; the ends and some
/// between are tried.
#[test]
fn interval_operations_contain_all_results() {
    let mut rng = Rng::with_seed(16);
    let mut interval = || {
        let (x, y) = (rng.f64() * 4.0 - 2.0, rng.f64() * 4.0 - 2.0);
        let inside = [x, y, 0.5 * (x + y), 0.75 * x + 0.25 * y];
        (Interval::point(x).hull(Interval::point(y)), inside)
    };
    for _ in 0..20_000 {
        let ((a, inside_a), (b, inside_b)) = (interval(), interval());
        let contains = |interval: Interval, value: f64| interval.lo <= value && value <= interval.hi;
        for x in inside_a {
            assert!(contains(a.square(), x * x) && contains(-a, -x) && a.magnitude() >= x.abs());
            for y in inside_b {
                assert!(contains(a + b, x + y) && contains(a - b, x - y) && contains(a * b, x * y));
                assert!(contains(a / b, x / y), "{a:?} / {b:?}");
            }
        }
    }
}

#[test]
fn what_is_no_number_is_any_number() {
    let infinite = Interval::point(f64::INFINITY);
    for unknown in [
        Interval::point(f64::NAN),
        infinite - infinite,
        Interval::point(0.0) * infinite,
        Interval::point(1.0) / Interval::point(0.0),
        infinite / infinite,
    ] {
        assert_eq!(unknown, Interval::ENTIRE);
    }
}
