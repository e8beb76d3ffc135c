//! Winding numbers against the summed angles of chords.

use super::trim;
use nurbs_hausdorff::internals::model::trim::TrimCurveArrays;
use proptest::prelude::*;

/// Returns 4,000 points of a curve, evaluated by the recurrence of the B-spline basis.
fn samples(curve: &TrimCurveArrays) -> Vec<[f64; 2]> {
    let (start, end) = (curve.knots[curve.degree], curve.knots[curve.control_points.len()]);
    (0..=4000).map(|k| evaluated(curve, start + (end - start) * f64::from(k) / 4000.0)).collect()
}

/// Returns the winding number around a point by summing the angles of chords, and the
/// distance to the nearest of their ends.
fn brute_force(samples: &[[f64; 2]], [u, v]: [f64; 2]) -> (i32, f64) {
    let (mut angle, mut nearest) = (0.0_f64, f64::INFINITY);
    for pair in samples.windows(2) {
        let [a, b] = [pair[0], pair[1]].map(|[x, y]| [x - u, y - v]);
        angle += (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
        nearest = nearest.min(a[0].hypot(a[1]));
    }
    ((angle / std::f64::consts::TAU).round() as i32, nearest)
}

fn evaluated(curve: &TrimCurveArrays, t: f64) -> [f64; 2] {
    let mut sums = [0.0; 3];
    for (index, &[u, v, w]) in curve.control_points.iter().enumerate() {
        let basis = basis(&curve.knots, curve.degree, index, t, curve.control_points.len()) * w;
        sums = [sums[0] + basis * u, sums[1] + basis * v, sums[2] + basis];
    }
    [sums[0] / sums[2], sums[1] / sums[2]]
}

/// The B-spline basis by Cox's and de Boor's recurrence, closed at the end of the domain.
fn basis(knots: &[f64], degree: usize, index: usize, t: f64, count: usize) -> f64 {
    let p = degree;
    if p == 0 {
        let last = t >= knots[count] && knots[index + 1] >= knots[count];
        return f64::from(u8::from(knots[index] <= t && (t < knots[index + 1] || last && knots[index] < t)));
    }
    let part = |from: f64, to: f64, at: f64| if to > from { (at - from) / (to - from) } else { 0.0 };
    part(knots[index], knots[index + p], t) * basis(knots, p - 1, index, t, count)
        + part(-knots[index + p + 1], -knots[index + 1], -t) * basis(knots, p - 1, index + 1, t, count)
}

/// A closed clamped rational curve that winds once around (2, 2).
fn star(degree: usize, radii: &[f64], weights: &[f64]) -> TrimCurveArrays {
    let count = radii.len();
    let mut control_points: Vec<[f64; 3]> = (0..count)
        .map(|k| {
            let angle = std::f64::consts::TAU * k as f64 / count as f64;
            [2.0 + radii[k] * angle.cos(), 2.0 + radii[k] * angle.sin(), weights[k]]
        })
        .collect();
    control_points.push(control_points[0]);
    let inner = count - degree;
    let mut knots = vec![0.0; degree + 1];
    knots.extend((1..=inner).map(|k| k as f64));
    knots.extend(vec![inner as f64 + 1.0; degree + 1]);
    TrimCurveArrays { degree, knots, control_points, ..TrimCurveArrays::default() }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn winding_numbers_agree_with_summed_angles(
        degree in 1_usize..6,
        radii in proptest::collection::vec(0.3_f64..1.9, 7..12),
        exponents in proptest::collection::vec(-2.0_f64..2.0, 12),
        points in proptest::collection::vec([0.0_f64..4.0, 0.0_f64..4.0], 20),
    ) {
        let weights: Vec<f64> = exponents.iter().map(|exponent| exponent.exp()).collect();
        let curve = star(degree, &radii, &weights);
        let trim = trim(vec![vec![curve.clone()]]).unwrap();
        let (winding, samples) = (trim.winding(), samples(&curve));
        for at in points {
            let (expected, nearest) = brute_force(&samples, at);
            if nearest > 0.02 {
                prop_assert_eq!(winding.number(at), Some(expected));
            }
        }
    }
}
