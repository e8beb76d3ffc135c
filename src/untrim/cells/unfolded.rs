//! The proof that a ruled map between two curves does not fold.

use crate::rounding::gamma;
use crate::untrim::curve::{Curve, divided, product};
use crate::untrim::face::V_ROUNDING;
use glam::{DVec2, DVec3};

/// The largest number of intervals of t that the proof looks at: cells that do not fold take a
/// few, and those with a cusp one for each of the 50 halvings down to the rounding.
const MAX_INTERVALS: usize = 64;

/// Returns upper bounds in u and v on the size of the parts of the map between two curves in
/// which it may fold, if these are at most `tolerance` (lemma T6 of docs/trimming.md).
///
/// The Jacobian is linear in s, so that it is enough to test s = 0 and s = 1:
/// `det(right - left, left')` and `det(right - left, right')`. Where their Bernstein coefficients,
/// after multiplication with positive powers of the weights, exceed their rounding, or consist of
/// zeros, there is no fold; elsewhere the interval of t is halved until both curves
/// together are small there.
pub(super) fn folds(left: &Curve, right: &Curve, tolerance: [f64; 2]) -> Option<[f64; 2]> {
    let mut found = [0.0_f64; 2];
    let mut count = 0;
    let mut open = vec![[0.0, 1.0]];
    while let Some([from, to]) = open.pop() {
        let parts = [left, right].map(|curve| curve.restricted(from, to));
        // Curves that meet do so at an end of the cell.
        let is_unfolded = [0, 1].iter().any(|&end| {
            let parts = relative(&parts, end);
            [0, 1].iter().all(|&side| is_positive(&parts, side))
        });
        if is_unfolded {
            continue;
        }
        count += 1;
        if count > MAX_INTERVALS {
            return None;
        }
        let hulls = parts.map(|part| part.hull());
        let size = hulls[0][1].max(hulls[1][1]) - hulls[0][0].min(hulls[1][0]);
        if size.x <= tolerance[0] && size.y <= tolerance[1] {
            found = [found[0].max(size.x), found[1].max(size.y)];
            continue;
        }
        let middle = 0.5 * (from + to);
        open.extend([[from, middle], [middle, to]]);
    }
    Some(found)
}

/// Returns both curves relative to the start, or the end, of the left one, where rounding is
/// relative to the distance from it. Coordinates of the controls next to that end are 0 where they
/// are within the rounding of v: such a move is that of lemma T7.
fn relative(curves: &[Curve; 2], end: usize) -> [Curve; 2] {
    let origin = if end == 0 { curves[0].start() } else { curves[0].end() };
    let coordinate = |value: f64| if value.abs() <= V_ROUNDING { 0.0 } else { value };
    curves.each_ref().map(|curve| {
        let degree = curve.degree();
        let control = |(index, &control): (usize, &DVec3)| {
            let point = divided(control) - origin;
            let is_near_end = if end == 0 { index <= 1 } else { index + 1 >= degree };
            let point =
                if is_near_end { DVec2::new(coordinate(point.x), coordinate(point.y)) } else { point };
            (point * control.z).extend(control.z)
        };
        Curve { controls: curve.controls.iter().enumerate().map(control).collect() }
    })
}

/// Returns whether a positive multiple of the Jacobian along one side has Bernstein coefficients
/// that are larger than their rounding or are sums of zeros.
fn is_positive(curves: &[Curve; 2], side: usize) -> bool {
    let size = |values: Vec<f64>| values.into_iter().map(f64::abs).collect::<Vec<f64>>();
    let coordinate =
        |curve: &Curve, axis: usize| -> Vec<f64> { curve.controls.iter().map(|c| c[axis]).collect() };
    let add = |a: Vec<f64>, b: Vec<f64>| a.into_iter().zip(b).map(|(a, b)| a + b).collect::<Vec<f64>>();
    let negative = |values: Vec<f64>| values.into_iter().map(|value| -value).collect::<Vec<f64>>();
    let [left, right] = curves;
    let weights = [coordinate(left, 2), coordinate(right, 2)];
    let across = [0, 1].map(|axis| {
        let products =
            [product(&coordinate(right, axis), &weights[0]), product(&coordinate(left, axis), &weights[1])];
        let sizes = products.clone().map(size);
        let ([r, l], [r_size, l_size]) = (products, sizes);
        (add(r, negative(l)), add(r_size, l_size))
    });
    let curve = &curves[side];
    let along = [0, 1].map(|axis| (curve.derivative(axis), curve.derivative_size(axis)));
    let jacobian = add(product(&across[0].0, &along[1].0), negative(product(&across[1].0, &along[0].0)));
    let sizes = add(product(&across[0].1, &along[1].1), product(&across[1].1, &along[0].1));
    // Products of Bernstein coefficients take 8 roundings a degree.
    let rounding = gamma(8.0 * jacobian.len() as f64 + 32.0);
    jacobian.iter().zip(&sizes).all(|(&value, &size)| size == 0.0 || value > rounding * size)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    fn curve(points: &[[f64; 3]]) -> Curve {
        let control = |&[u, v, w]: &[f64; 3]| DVec3::new(u * w, v * w, w);
        Curve { controls: points.iter().map(control).collect() }
    }

    const TOLERANCE: [f64; 2] = [1e-10, 1e-10];

    #[test]
    fn halves_of_a_circle_that_meet_in_its_poles_do_not_fold() {
        let w = std::f64::consts::FRAC_1_SQRT_2;
        // Two arcs of different weights, so that v differs at equal parameters.
        let left = curve(&[[0.5, 0.0, 1.0], [0.0, 0.0, w], [0.0, 0.5, 1.0]]);
        let right = curve(&[[0.5, 0.0, 1.0], [1.0, 0.0, 0.5 * w], [1.0, 0.5, 1.0]]);
        assert_eq!(folds(&left, &right, TOLERANCE), Some([0.0; 2]));
        // Exchanged, the map turns over.
        assert_eq!(folds(&right, &left, TOLERANCE), None);
    }

    /// The side that hurries ahead and then turns away folds the map along itself alone.
    #[test]
    fn a_map_that_folds_along_one_side_is_refused_on_either() {
        let straight = |u: f64| curve(&[[u, 0.0, 1.0], [u, 1.0, 1.0]]);
        let ahead = |from: f64, to: f64| {
            curve(&[[from, 0.0, 1.0], [from, 1.0, 1.0], [from, 1.0, 1.0], [to, 1.0, 1.0]])
        };
        assert_eq!(folds(&straight(0.0), &ahead(0.1, 1.0), TOLERANCE), None);
        assert_eq!(folds(&ahead(-0.1, -1.0), &straight(0.0), TOLERANCE), None);
        assert!(folds(&straight(0.0), &straight(0.1), TOLERANCE).is_some());
    }

    #[test]
    fn a_map_that_folds_in_a_part_is_refused_or_bounded_by_its_size() {
        // The left side passes through the right one near its upper end.
        for (beyond, is_small) in [(0.1, false), (1e-11, true)] {
            let left = curve(&[[0.0, 0.0, 1.0], [0.1, 0.5, 1.0], [0.5 + beyond, 1.0, 1.0]]);
            let right = curve(&[[0.6, 0.0, 1.0], [0.55, 0.4, 1.0], [0.5, 1.0, 1.0]]);
            let found = folds(&left, &right, TOLERANCE);
            assert_eq!(found.is_some(), is_small, "{beyond}: {found:?}");
            if let Some([in_u, in_v]) = found {
                // The sides approach each other in u by 0.9 for each 1 in v.
                let allowed = beyond..=1e-10;
                assert!(allowed.contains(&in_u) && allowed.contains(&in_v), "{in_u} {in_v}");
            }
        }
    }

    /// A fold as high as the cell is refused, however narrow it is.
    #[test]
    fn a_narrow_fold_that_is_high_is_refused() {
        let straight = |u: f64| curve(&[[u, 0.0, 1.0], [u, 1.0, 1.0]]);
        assert_eq!(folds(&straight(1e-11), &straight(0.0), TOLERANCE), None);
    }

    /// A width of one unit in the last place is not known to be positive.
    #[test]
    fn a_width_within_its_rounding_has_no_sign() {
        let left = curve(&[[0.1, 0.0, 1.0], [0.7, 1.0, 1.0]]);
        let right = curve(&[[0.1, 0.0, 1.0], [0.7_f64.next_up(), 1.0, 1.0]]);
        assert_eq!(folds(&left, &right, TOLERANCE), None);
    }
}
