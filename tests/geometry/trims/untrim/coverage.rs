//! What the cut of a trimmed face guarantees: the pieces cover the inside of the loops
//! once, lie on the surface and reach the loops.

use nurbs_hausdorff::NurbsSurface;
use nurbs_hausdorff::internals::model::trim::Trim;
use nurbs_hausdorff::internals::untrim::Untrimmed;

use super::Point;
use crate::support::evaluator;
use crate::support::quadrature::gauss;

/// The signed area of the pieces of a face in the plane z = 0.
pub(super) fn area(untrimmed: &Untrimmed) -> f64 {
    let rule = gauss(24);
    let mut total = 0.0;
    for piece in &untrimmed.pieces {
        for domain in spans(&piece.surface) {
            let [[a, b], [c, d]] = domain;
            for &[x, wx] in &rule {
                for &[y, wy] in &rule {
                    let (_, by_u, by_v) = evaluate(&piece.surface, a + (b - a) * x, c + (d - c) * y);
                    total += wx * wy * (b - a) * (d - c) * (by_u[0] * by_v[1] - by_u[1] * by_v[0]);
                }
            }
        }
    }
    total
}

/// Point and first derivatives, by the sum of Bernstein polynomials on a single knot span.
fn evaluate(surface: &NurbsSurface, u: f64, v: f64) -> ([f64; 3], [f64; 3], [f64; 3]) {
    let [p, q] = surface.degree();
    if surface.counts() != [p + 1, q + 1] {
        let found = evaluator::evaluate(surface, u, v, [0.0; 3]);
        return (found.point, found.u, found.v);
    }
    let domain = surface.domain();
    let local = |axis: usize, value: f64| (value - domain[axis][0]) / domain.lengths()[axis];
    let bases = |n: usize, t: f64| -> Vec<Point> {
        let choose = |n: usize, k: usize| (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64);
        let value = |n: usize, k: i32| {
            if k < 0 || k > n as i32 {
                return 0.0;
            }
            choose(n, k as usize) * t.powi(k) * (1.0 - t).powi(n as i32 - k)
        };
        (0..=n as i32).map(|k| [value(n, k), n as f64 * (value(n - 1, k - 1) - value(n - 1, k))]).collect()
    };
    let (in_u, in_v) = (bases(p, local(0, u)), bases(q, local(1, v)));
    let mut sums = [[0.0; 4]; 3];
    for (i, [bu, du]) in in_u.iter().enumerate() {
        for (j, [bv, dv]) in in_v.iter().enumerate() {
            let [x, y, z, w] = surface.control_points()[i * (q + 1) + j];
            for (sum, factor) in sums.iter_mut().zip([bu * bv, du * bv, bu * dv]) {
                for (sum, value) in sum.iter_mut().zip([x * w, y * w, z * w, w]) {
                    *sum += factor * value;
                }
            }
        }
    }
    let point = [0, 1, 2].map(|k| sums[0][k] / sums[0][3]);
    let slope = |axis: usize| {
        [0, 1, 2]
            .map(|k| (sums[axis + 1][k] - sums[axis + 1][3] * point[k]) / sums[0][3] / domain.lengths()[axis])
    };
    (point, slope(0), slope(1))
}

/// The rectangles of a surface's knots.
fn spans(surface: &NurbsSurface) -> Vec<[Point; 2]> {
    let breaks = nurbs_hausdorff::Axis::BOTH.map(|axis| {
        let [low, high] = surface.domain()[axis];
        let mut knots: Vec<f64> =
            surface.knots(axis).iter().copied().filter(|knot| (low..=high).contains(knot)).collect();
        knots.dedup();
        knots
    });
    let mut found = Vec::new();
    for u in breaks[0].windows(2) {
        for v in breaks[1].windows(2) {
            found.push([[u[0], u[1]], [v[0], v[1]]]);
        }
    }
    found
}

/// The area within the loops by Green's theorem, 1/2 ∮ u dv - v du.
pub(super) fn green(trim: &Trim) -> f64 {
    let rule = gauss(32);
    let mut total = 0.0;
    for piece in trim.loops().iter().flatten() {
        for &[t, weight] in &rule {
            let (point, slope) =
                curve_at(&piece.controls.iter().map(|c| c.to_array()).collect::<Vec<_>>(), t);
            total += weight * 0.5 * (point[0] * slope[1] - point[1] * slope[0]);
        }
    }
    total
}

/// Point and derivative of a rational Bézier curve by the definition.
fn curve_at(controls: &[[f64; 3]], t: f64) -> (Point, Point) {
    let n = controls.len() - 1;
    let choose = |n: usize, k: usize| (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64);
    let basis = |n: usize, k: usize| choose(n, k) * t.powi(k as i32) * (1.0 - t).powi((n - k) as i32);
    let sum = |axis: usize| (0..=n).map(|k| basis(n, k) * controls[k][axis]).sum::<f64>();
    let slope = |axis: usize| {
        (0..n).map(|k| n as f64 * basis(n - 1, k) * (controls[k + 1][axis] - controls[k][axis])).sum::<f64>()
    };
    let (w, dw) = (sum(2), slope(2));
    let point = [sum(0) / w, sum(1) / w];
    (point, [0, 1].map(|axis| (slope(axis) - dw * point[axis]) / w))
}

/// The winding number of a polygon about a point, and the point's distance from it.
fn winding(polygon: &[Point], [x, y]: Point) -> (i32, f64) {
    let (mut turns, mut least) = (0, f64::INFINITY);
    for (k, a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let along = (((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
        let along = if along.is_nan() { 0.0 } else { along };
        least = least.min((a[0] + along * dx - x).hypot(a[1] + along * dy - y));
        if (a[1] <= y) != (b[1] <= y) {
            let left = dx * (y - a[1]) - dy * (x - a[0]);
            if dy > 0.0 && left > 0.0 {
                turns += 1;
            }
            if dy < 0.0 && left < 0.0 {
                turns -= 1;
            }
        }
    }
    (turns, least)
}

/// Asserts that random points are inside the loops if and only if they are in the parameter
/// image of exactly one piece, whose boundary the parameter map carries over counterclockwise.
pub(super) fn assert_covers(surface: &NurbsSurface, trim: &Trim, untrimmed: &Untrimmed, margin: f64) {
    let steps = 64;
    let loops: Vec<Vec<Point>> = trim
        .loops()
        .iter()
        .map(|pieces| {
            let point = |controls: &Vec<[f64; 3]>, k: usize| curve_at(controls, k as f64 / steps as f64).0;
            pieces
                .iter()
                .map(|piece| piece.controls.iter().map(|c| c.to_array()).collect::<Vec<_>>())
                .flat_map(|controls| (0..steps).map(|k| point(&controls, k)).collect::<Vec<_>>())
                .collect()
        })
        .collect();
    let images: Vec<Vec<Point>> = untrimmed
        .pieces
        .iter()
        .map(|piece| {
            let domain = piece.surface.domain();
            (0..4 * steps)
                .map(|k| {
                    let x = (k % steps) as f64 / steps as f64;
                    let corner = [[x, 0.0], [1.0, x], [1.0 - x, 1.0], [0.0, 1.0 - x]][k / steps];
                    piece.map.face_parameters(domain.at(corner))
                })
                .collect()
        })
        .collect();
    let mut random = fastrand::Rng::with_seed(7);
    let mut tested = 0;
    for _ in 0..2000 {
        let at = surface.domain().at([random.f64(), random.f64()]);
        let around: Vec<(i32, f64)> = loops.iter().map(|polygon| winding(polygon, at)).collect();
        let within: Vec<(i32, f64)> = images.iter().map(|polygon| winding(polygon, at)).collect();
        if around.iter().chain(&within).any(|&(_, distance)| distance < margin) {
            continue;
        }
        tested += 1;
        let expected: i32 = around.iter().map(|&(turns, _)| turns).sum();
        let found: i32 = within.iter().map(|&(turns, _)| turns).sum();
        assert!(within.iter().all(|&(turns, _)| turns == 0 || turns == 1), "{at:?} {within:?}");
        assert_eq!(found, expected, "{at:?}");
    }
    assert!(tested > 300, "{tested}");
}

/// Asserts that the pieces lie on the surface at the parameters that their maps state, up to
/// the deviation.
pub(super) fn assert_on_surface(surface: &NurbsSurface, untrimmed: &Untrimmed, rounding: f64) {
    for piece in &untrimmed.pieces {
        let domain = piece.surface.domain();
        for i in 0..=6 {
            for j in 0..=6 {
                let at = domain.at([f64::from(i) / 6.0, f64::from(j) / 6.0]);
                let found = evaluate(&piece.surface, at[0], at[1]).0;
                let [u, v] = piece.map.face_parameters(at);
                let expected = evaluate(surface, u, v).0;
                let distance = (0..3).map(|k| (found[k] - expected[k]).powi(2)).sum::<f64>().sqrt();
                assert!(distance <= untrimmed.deviation + rounding, "{distance} {}", untrimmed.deviation);
            }
        }
    }
}

/// Asserts that points of the loops lie on the edges of the pieces' parameter images.
pub(super) fn assert_reaches_boundary(trim: &Trim, untrimmed: &Untrimmed, tolerance: f64) {
    let edges: Vec<_> =
        untrimmed.pieces.iter().flat_map(|piece| (0..4).map(move |side| (piece, side))).collect();
    for piece in trim.loops().iter().flatten() {
        let controls: Vec<[f64; 3]> = piece.controls.iter().map(|c| c.to_array()).collect();
        for k in 0..=8 {
            let (at, _) = curve_at(&controls, f64::from(k) / 8.0);
            let found = edges.iter().any(|&(piece, side)| edge_distance(piece, side, at) <= tolerance);
            assert!(found, "{at:?}");
        }
    }
}

/// The distance in the parameter plane from a point to one edge of a piece's image: the least
/// of 17 samples, improved by golden sections around it.
fn edge_distance(piece: &nurbs_hausdorff::internals::untrim::Piece, side: usize, at: Point) -> f64 {
    let domain = piece.surface.domain();
    let distance = |x: f64| {
        let [u, v] = piece.map.face_parameters(domain.at([[x, 0.0], [1.0, x], [x, 1.0], [0.0, x]][side]));
        (u - at[0]).hypot(v - at[1])
    };
    let steps = 16;
    let samples: Vec<f64> = (0..=steps).map(|k| distance(f64::from(k) / f64::from(steps))).collect();
    let length: f64 = samples.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
    let least = (0..samples.len()).min_by(|&a, &b| samples[a].total_cmp(&samples[b])).unwrap();
    if samples[least] > length {
        return samples[least];
    }
    let width = 1.0 / f64::from(steps);
    let (mut low, mut high) = ((least as f64 - 1.0) * width, (least as f64 + 1.0) * width);
    (low, high) = (low.max(0.0), high.min(1.0));
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let mut best = samples[least];
    for _ in 0..75 {
        let inner = [high - ratio * (high - low), low + ratio * (high - low)];
        let found = inner.map(distance);
        best = best.min(found[0]).min(found[1]);
        if found[0] < found[1] {
            high = inner[1];
        } else {
            low = inner[0];
        }
    }
    best
}
