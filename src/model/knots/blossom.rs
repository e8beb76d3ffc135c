//! The blossom of a polynomial of a spline.

use crate::limits::MAX_FILE_DEGREE;
use glam::DVec4;

/// The largest number of control points of a span: that of curves and surfaces of files.
const MAX_ORDER: usize = MAX_FILE_DEGREE + 1;

/// Returns the blossom, or polar form, of the polynomial of the span that begins with knot `span`, with
/// these degree + 1 active control points, at `argument(0)`, …, `argument(degree - 1)` (L. Ramshaw,
/// *Blossoming: a connect-the-dots approach to splines*). O(degree²).
pub fn blossom(
    knots: &[f64],
    degree: usize,
    span: usize,
    controls: &[DVec4],
    argument: impl Fn(usize) -> f64,
) -> DVec4 {
    // Most degrees are small: loops of a known length are unrolled, and clearing unused control
    // points takes longer than the rest.
    match degree {
        1 => blossom_of::<2>(knots, span, controls, argument),
        2 => blossom_of::<3>(knots, span, controls, argument),
        3 => blossom_of::<4>(knots, span, controls, argument),
        0 | 4..=7 => blossom_within::<8>(knots, degree, span, controls, argument),
        _ => blossom_within::<MAX_ORDER>(knots, degree, span, controls, argument),
    }
}

/// [`blossom`] for the degree N - 1.
fn blossom_of<const N: usize>(
    knots: &[f64],
    span: usize,
    controls: &[DVec4],
    argument: impl Fn(usize) -> f64,
) -> DVec4 {
    let mut work: [DVec4; N] = std::array::from_fn(|index| controls[index]);
    // The knots on both sides of the span that the arguments are between.
    let around = &knots[span + 2 - N..span + N];
    for level in 1..N {
        let parameter = argument(level - 1);
        for index in 0..N - level {
            let (low, high) = (around[level + index - 1], around[N - 1 + index]);
            let fraction = (parameter - low) / (high - low);
            work[index] = (1.0 - fraction) * work[index] + fraction * work[index + 1];
        }
    }
    work[0]
}

/// [`blossom`] for a degree below N.
fn blossom_within<const N: usize>(
    knots: &[f64],
    degree: usize,
    span: usize,
    controls: &[DVec4],
    argument: impl Fn(usize) -> f64,
) -> DVec4 {
    let mut work = [DVec4::ZERO; N];
    work[..=degree].copy_from_slice(controls);
    for level in 1..=degree {
        let parameter = argument(level - 1);
        for index in 0..=degree - level {
            let low = knots[span - degree + level + index];
            let high = knots[span + 1 + index];
            let fraction = (parameter - low) / (high - low);
            work[index] = (1.0 - fraction) * work[index] + fraction * work[index + 1];
        }
    }
    work[0]
}
