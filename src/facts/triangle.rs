//! The moments of the cone from the origin over a triangle.

use super::moments::{COUNT, Moments, order};
use crate::interval::Interval;
use crate::rounding::gamma;
use glam::DVec3;

/// The roundings of a moment, relative to the product of the lengths that it has: differences, a cross and a
/// scalar product, products of coordinates and their sum (lemma V4 of docs/facts.md).
const TRIANGLE_ROUNDINGS: f64 = 48.0;

/// The roundings of an area, relative to the product of two edges' lengths.
const AREA_ROUNDINGS: f64 = 12.0;

/// Returns the moments of the signed cone over a triangle, whose corners are off by at most `moved`.
///
/// With corners a, b, c relative to the origin the cone has the volume V = a·((b − a) × (c − a)) / 6, the first
/// moments V s / 4 for s = a + b + c, and the second ones V (Σ v vᵀ + s sᵀ) / 20 over the corners v.
pub(crate) fn of_triangle(corners: [DVec3; 3], origin: DVec3, moved: f64) -> Moments {
    let [a, b, c] = corners.map(|corner| corner - origin);
    let edges = [corners[1] - corners[0], corners[2] - corners[0]];
    let volume = a.dot(edges[0].cross(edges[1])) / 6.0;
    let sum = a + b + c;
    let second =
        |i: usize, j: usize| volume / 20.0 * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + sum[i] * sum[j]);
    let first = sum * (volume / 4.0);
    let values = [
        volume,
        first.x,
        first.y,
        first.z,
        second(0, 0),
        second(1, 1),
        second(2, 2),
        second(0, 1),
        second(1, 2),
        second(2, 0),
    ];
    let lengths = [edges[0], edges[1]].map(DVec3::length);
    let radius = [a, b, c].map(DVec3::length).into_iter().fold(0.0, crate::rounding::upper_max) + moved;
    let size = radius * lengths[0] * lengths[1] / 6.0;
    let rounding: [f64; COUNT] =
        std::array::from_fn(|index| gamma(TRIANGLE_ROUNDINGS) * size * radius.powi(order(index)));
    let mut moments = Moments { values, errors: rounding };
    if moved > 0.0 {
        let area = 0.5 * (lengths[0] + 2.0 * moved) * (lengths[1] + 2.0 * moved);
        moments.add_layer(moved, area, radius);
    }
    moments
}

/// Returns the area of a triangle whose corners are off by at most `moved`.
pub(crate) fn area_of_triangle([a, b, c]: [DVec3; 3], moved: f64) -> Interval {
    let edges = [b - a, c - a];
    let [first, second] = edges.map(DVec3::length);
    let error = gamma(AREA_ROUNDINGS) * first * second + moved * (first + second + 2.0 * moved);
    Interval::about(0.5 * edges[0].cross(edges[1]).length(), error).not_negative()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// Lemma V4 for the tetrahedron of the unit vectors, by ∫ x = 1/24, ∫ x² = 1/60 and ∫ x y = 1/120.
    #[test]
    fn moments_of_a_cone_are_those_of_its_simplex() {
        let found = of_triangle([DVec3::X, DVec3::Y, DVec3::Z], DVec3::ZERO, 0.0);
        for (index, interval) in found.intervals().into_iter().enumerate() {
            let exact = match index {
                0 => 1.0 / 6.0,
                1..4 => 1.0 / 24.0,
                4..7 => 1.0 / 60.0,
                _ => 1.0 / 120.0,
            };
            assert!(interval.contains(exact) && interval.width() < 1e-12, "{index}: {interval:?}");
        }
    }

    /// The rounding of V4: of triangles in a plane through the origin, whose volume is 0, and near it, volumes
    /// are computed in whole numbers besides. Their terms, of some 80 binary digits, cancel.
    #[test]
    fn the_rounding_of_a_volume_is_in_its_error() {
        let random = &mut fastrand::Rng::with_seed(46);
        let mut largest = 0.0_f64;
        for round in 0..200 {
            let mut whole = || [0; 2].map(|_| random.i64(-(1 << 25)..1 << 25));
            // The plane x + 2 y = 3 z, by two vectors in it.
            let mut corners = [(); 3].map(|()| {
                let [a, b] = whole();
                [3 * a, 3 * b, a + 2 * b]
            });
            corners[0][2] += round % 3;
            let [a, b, c] = corners.map(|corner| corner.map(i128::from));
            let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
            let exact = (a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1)) as f64 / 6.0;
            let [a, b, c] = corners.map(|corner| DVec3::from_array(corner.map(|entry| entry as f64)));
            let found = of_triangle([a, b, c], DVec3::ZERO, 0.0);
            let off = (found.values[0] - exact).abs();
            assert!(off <= found.errors[0] + 4.0 * f64::EPSILON * exact.abs(), "{off} {found:?}");
            largest = largest.max(off / exact.abs().max(1.0));
        }
        // Without the rounding they would be wrong.
        assert!(largest > 1e-3, "{largest}");
    }
}
