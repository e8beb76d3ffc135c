//! Rounding errors of float64, and bounds that they or an overflow may spoil.

use glam::DVec3;

/// An upper bound on what underflow takes off a length or adds to it.
///
/// A sum of at most 512 products, each rounded by at most 2^-1074 where it is
/// subnormal, is off by 2.6e-321. A squared length is such a sum, divided by
/// weights whose products are at least 1e-120, by [`MAX_WEIGHT_RATIO`] once for
/// every factor of the denominator of `|A - B|²`: 2.6e-201, the square of 6e-101.
///
/// [`MAX_WEIGHT_RATIO`]: crate::limits::MAX_WEIGHT_RATIO
pub(crate) const VANISHING_LENGTH: f64 = 1e-100;

/// The largest relative error of one operation in float64, 2^-53.
pub(crate) const UNIT_ROUNDOFF: f64 = 0.5 * f64::EPSILON;

/// Makes n u an upper bound on `n u / (1 - n u)` for n up to 10^4, with the
/// rounding of the bound itself.
const COMPOUNDING: f64 = 1.01;

/// The roundings of a certified closest point, relative to the largest length of
/// the point and of all control points: lemma R12 of docs/rounding.md.
const CLOSEST_ROUNDINGS: f64 = 160.0;

/// An upper bound on the relative error after this many operations in a row, on
/// terms of one sign: `γ_n` in docs/rounding.md, section 6.
pub(crate) fn gamma(operations: f64) -> f64 {
    COMPOUNDING * UNIT_ROUNDOFF * operations
}

/// An upper bound on the error of the lower bound on a distance from a point to a
/// model, all of them at most this far from the origin (lemma R12 of docs/rounding.md).
pub(crate) fn closest_rounding(length: f64) -> f64 {
    gamma(CLOSEST_ROUNDINGS) * length + VANISHING_LENGTH
}

/// Returns the direction of a vector, of length 1 however short the vector is; 0 for 0 and NaN.
///
/// Squares of lengths below 1e-154 are subnormal, so that a quotient by their root may be of any
/// length: the vector is divided by its largest coordinate before.
pub(crate) fn unit(vector: DVec3) -> DVec3 {
    (vector / vector.abs().max_element()).normalize_or_zero()
}

/// Returns the larger of two upper bounds; NaN bounds nothing and counts as +∞.
///
/// `f64::max` would return the other bound, which then does not hold for both.
#[inline]
pub(crate) fn upper_max(largest: f64, bound: f64) -> f64 {
    if bound <= largest {
        largest
    } else if bound > largest {
        bound
    } else {
        f64::INFINITY
    }
}

/// Returns the smaller of a running minimum, which starts at +∞, and another
/// lower bound; a bound that is NaN or +∞, which only overflows give, bounds
/// nothing and counts as −∞.
///
/// Lower bounds on a distance are to be raised to 0 afterwards.
#[inline]
pub(crate) fn lower_min(least: f64, bound: f64) -> f64 {
    if bound < f64::INFINITY { least.min(bound) } else { f64::NEG_INFINITY }
}

/// Returns the less of two upper bounds; a second one that is NaN or infinite bounds nothing.
pub(crate) fn upper_min(least: f64, bound: f64) -> f64 {
    if bound < least { bound } else { least }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn an_upper_bound_that_is_nan_counts_as_infinite() {
        assert_eq!(upper_max(1.0, 2.0), 2.0);
        assert_eq!(upper_max(2.0, 1.0), 2.0);
        assert_eq!(upper_max(1.0, f64::NAN), f64::INFINITY);
        assert_eq!(upper_max(f64::NAN, 1.0), f64::INFINITY);
        assert_eq!([1.0, f64::NAN, 2.0].into_iter().fold(0.0, upper_max), f64::INFINITY);
        assert_eq!([f64::NAN, 3.0].into_iter().fold(0.0, upper_max), f64::INFINITY);
    }

    #[test]
    fn the_rounding_of_a_closest_point_adds_what_underflow_takes() {
        assert_eq!(closest_rounding(0.0), VANISHING_LENGTH);
    }

    #[test]
    fn a_unit_vector_has_length_1_however_short_the_vector_is() {
        for exponent in [-1022, -541, -540, -538, -537, 0, 300] {
            for vector in [DVec3::X, DVec3::new(-2.0, 1.0, 3.0), DVec3::new(0.0, 4.0, -5.0)] {
                let direction = unit(vector * 2.0_f64.powi(exponent));
                assert!((direction.length() - 1.0).abs() < 1e-15, "{vector} 2^{exponent}: {direction}");
                assert!(direction.distance(vector.normalize()) < 1e-15, "{vector} 2^{exponent}: {direction}");
            }
        }
        assert_eq!([DVec3::ZERO, DVec3::NAN, DVec3::INFINITY].map(unit), [DVec3::ZERO; 3]);
    }

    #[test]
    fn a_lower_bound_that_is_nan_or_overflowed_bounds_nothing() {
        let fold = |bounds: &[f64]| bounds.iter().copied().fold(f64::INFINITY, lower_min);
        assert_eq!(fold(&[3.0, -1.0, 2.0]), -1.0);
        assert_eq!(fold(&[3.0, f64::NAN, 2.0]), f64::NEG_INFINITY);
        assert_eq!(fold(&[f64::INFINITY, 2.0]), f64::NEG_INFINITY);
        assert_eq!(fold(&[f64::NAN]).max(0.0), 0.0);
    }
}
