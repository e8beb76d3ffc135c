//! Trimmed faces cut into patches: areas, coverage, deviation.

use nurbs_hausdorff::model::trim::{Trim, TrimCurveArrays};
use nurbs_hausdorff::untrim::{ParameterMap, Untrimmed, untrim};
use nurbs_hausdorff::{NurbsSurface, SurfaceArrays};
use std::f64::consts::PI;

use crate::support::evaluator;
use crate::support::quadrature::gauss;

type Point = [f64; 2];

/// A Bézier curve with controls `[u, v, w]`.
fn bezier(controls: &[[f64; 3]]) -> TrimCurveArrays {
    let degree = controls.len() - 1;
    let knots = [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat();
    TrimCurveArrays { degree, knots, control_points: controls.to_vec(), gap: 0.0, edge: None }
}

fn line(from: Point, to: Point) -> TrimCurveArrays {
    bezier(&[[from[0], from[1], 1.0], [to[0], to[1], 1.0]])
}

fn polygon(corners: &[Point]) -> Vec<TrimCurveArrays> {
    (0..corners.len()).map(|k| line(corners[k], corners[(k + 1) % corners.len()])).collect()
}

fn rectangle(low: Point, high: Point) -> Vec<TrimCurveArrays> {
    polygon(&[low, [high[0], low[1]], high, [low[0], high[1]]])
}

/// A full circle of `arcs` rational quadratic arcs, counterclockwise from the angle `start`.
fn circle(center: Point, radius: f64, start: f64, arcs: usize) -> Vec<TrimCurveArrays> {
    let half = PI / arcs as f64;
    let at = |angle: f64, radius: f64| [center[0] + radius * angle.cos(), center[1] + radius * angle.sin()];
    let corner = |k: usize| at(start + 2.0 * half * (k % arcs) as f64, radius);
    (0..arcs)
        .map(|k| {
            let middle = at(start + half * (2 * k + 1) as f64, radius / half.cos());
            let ([a, b], [c, d]) = (corner(k), corner(k + 1));
            bezier(&[[a, b, 1.0], [middle[0], middle[1], half.cos()], [c, d, 1.0]])
        })
        .collect()
}

fn reversed(curves: &[TrimCurveArrays]) -> Vec<TrimCurveArrays> {
    let reverse = |curve: &TrimCurveArrays| {
        let mut curve = curve.clone();
        curve.control_points.reverse();
        curve
    };
    curves.iter().rev().map(reverse).collect()
}

/// A Bézier surface with these points, v fastest.
fn surface(degree: [usize; 2], domain: [Point; 2], points: Vec<[f64; 4]>) -> NurbsSurface {
    let knots = [0, 1].map(|axis| {
        let [low, high] = domain[axis];
        [vec![low; degree[axis] + 1], vec![high; degree[axis] + 1]].concat()
    });
    let counts = degree.map(|degree| degree + 1);
    NurbsSurface::new(0, SurfaceArrays { degree, knots, counts, control_points: points }).unwrap()
}

/// The plane (u, v) -> (u, v, 0) over a rectangle.
fn plane([u0, u1]: Point, [v0, v1]: Point) -> NurbsSurface {
    let points = [[u0, v0], [u0, v1], [u1, v0], [u1, v1]].map(|[u, v]| [u, v, 0.0, 1.0]).to_vec();
    surface([1, 1], [[u0, u1], [v0, v1]], points)
}

/// A bicubic sheet of size 10 over [0, 2] × [0, 3], with knots.
fn sheet() -> NurbsSurface {
    let counts = [6, 5];
    let points = (0..counts[0] * counts[1])
        .map(|k| {
            let (i, j) = ((k / counts[1]) as f64, (k % counts[1]) as f64);
            [2.0 * i, 2.5 * j, (1.3 * i).sin() + (0.9 * j + 0.2 * i).cos(), 1.0]
        })
        .collect();
    NurbsSurface::new(
        0,
        SurfaceArrays {
            degree: [3, 3],
            knots: [
                vec![0.0, 0.0, 0.0, 0.0, 0.7, 1.1, 2.0, 2.0, 2.0, 2.0],
                vec![0.0, 0.0, 0.0, 0.0, 1.4, 3.0, 3.0, 3.0, 3.0],
            ],
            counts,
            control_points: points,
        },
    )
    .unwrap()
}

/// A quarter cylinder of radius 20 about z, rational in u, z = 100 v.
fn quarter_cylinder() -> NurbsSurface {
    let w = std::f64::consts::FRAC_1_SQRT_2;
    let mut points = Vec::new();
    for [x, y, w] in [[20.0, 0.0, 1.0], [20.0, 20.0, w], [0.0, 20.0, 1.0]] {
        points.extend([[x, y, 0.0, w], [x, y, 100.0, w]]);
    }
    surface([2, 1], [[0.0, 1.0], [0.0, 1.0]], points)
}

fn cut(surface: &NurbsSurface, loops: Vec<Vec<TrimCurveArrays>>, max_deviation: f64) -> (Trim, Untrimmed) {
    let trim = Trim::new(0, surface, loops).unwrap();
    let untrimmed = untrim(0, surface, &trim, max_deviation).unwrap();
    (trim, untrimmed)
}

/// The signed area of the pieces of a face in the plane z = 0.
fn area(untrimmed: &Untrimmed) -> f64 {
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
fn green(trim: &Trim) -> f64 {
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
fn assert_covers(surface: &NurbsSurface, trim: &Trim, untrimmed: &Untrimmed, margin: f64) {
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
fn assert_on_surface(surface: &NurbsSurface, untrimmed: &Untrimmed, rounding: f64) {
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
fn assert_reaches_boundary(trim: &Trim, untrimmed: &Untrimmed, tolerance: f64) {
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
fn edge_distance(piece: &nurbs_hausdorff::untrim::Piece, side: usize, at: Point) -> f64 {
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

#[test]
fn a_plate_with_a_round_bore_is_exact() {
    let plate = plane([0.0, 100.0], [0.0, 60.0]);
    for (start, arcs) in [(0.0, 4), (0.3, 4), (0.0, 3), (1.0, 5)] {
        let bore = reversed(&circle([40.0, 30.0], 10.0, start, arcs));
        let (trim, cut) = cut(&plate, vec![rectangle([0.0, 0.0], [100.0, 60.0]), bore], 1e-9);
        let removed = 6000.0 - area(&cut);
        assert!((removed - 100.0 * PI).abs() < 6000.0 * 1e-15 + 1e-10, "{removed}");
        // Rounding only: 1e-13 of the size.
        assert!(cut.deviation < 3e-11, "{}", cut.deviation);
        assert!(cut.pieces.len() <= 12, "{}", cut.pieces.len());
        assert_covers(&plate, &trim, &cut, 0.05);
        assert_on_surface(&plate, &cut, 1e-12);
        assert_reaches_boundary(&trim, &cut, 1e-10);
    }
}

#[test]
fn three_nested_loops() {
    let plate = plane([-10.0, 10.0], [-10.0, 10.0]);
    let loops = vec![
        circle([0.0, 0.0], 9.0, 0.1, 4),
        reversed(&polygon(&[[-4.0, -4.0], [4.5, -3.0], [4.0, 4.0], [-3.0, 4.5]])),
        circle([0.2, -0.1], 2.0, 0.0, 3),
    ];
    let (trim, cut) = cut(&plate, loops, 1e-9);
    assert!((area(&cut) - green(&trim)).abs() < 1e-10, "{} {}", area(&cut), green(&trim));
    assert_covers(&plate, &trim, &cut, 0.02);
    assert_on_surface(&plate, &cut, 1e-12);
    assert_reaches_boundary(&trim, &cut, 1e-10);
}

#[test]
fn a_rectangle_keeps_its_knots() {
    let sheet = sheet();
    let (trim, cut) = cut(&sheet, vec![rectangle([0.3, 0.0], [1.5, 2.5])], 1e-8);
    assert_eq!(cut.pieces.len(), 1);
    assert!(matches!(cut.pieces[0].map, ParameterMap::Identity));
    assert_eq!(cut.pieces[0].surface.domain().intervals(), [[0.3, 1.5], [0.0, 2.5]]);
    assert!(cut.deviation < 1e-11);
    assert_on_surface(&sheet, &cut, 1e-12);
    assert_covers(&sheet, &trim, &cut, 0.01);
}

#[test]
fn a_bicubic_face_trimmed_by_cubic_curves() {
    let sheet = sheet();
    let outer = vec![
        bezier(&[[0.2, 0.3, 1.0], [0.8, 0.1, 1.0], [1.2, 0.6, 1.0], [1.8, 0.4, 1.0]]),
        bezier(&[[1.8, 0.4, 1.0], [2.0, 1.0, 1.0], [1.5, 2.0, 1.0], [1.7, 2.7, 1.0]]),
        bezier(&[[1.7, 2.7, 1.0], [1.2, 2.9, 1.0], [0.9, 2.2, 1.0], [0.3, 2.8, 1.0]]),
        bezier(&[[0.3, 2.8, 1.0], [0.1, 2.0, 1.0], [0.5, 1.0, 1.0], [0.2, 0.3, 1.0]]),
    ];
    let hole = reversed(&circle([1.0, 1.4], 0.3, 0.2, 4));
    for max_deviation in [1e-6, 1e-8] {
        let (trim, cut) = cut(&sheet, vec![outer.clone(), hole.clone()], max_deviation);
        assert!(cut.deviation <= max_deviation * 1.01, "{}", cut.deviation);
        assert_covers(&sheet, &trim, &cut, 0.005);
        assert_on_surface(&sheet, &cut, 1e-12);
        assert_reaches_boundary(&trim, &cut, max_deviation);
        println!("{max_deviation}: {} pieces, {}", cut.pieces.len(), cut.deviation);
    }
}

#[test]
fn a_cylinder_with_a_cross_bore() {
    let cylinder = quarter_cylinder();
    let hole = reversed(&[
        bezier(&[[0.6, 0.5, 1.0], [0.6, 0.53, 1.0], [0.56, 0.55, 1.0], [0.5, 0.55, 1.0]]),
        bezier(&[[0.5, 0.55, 1.0], [0.44, 0.55, 1.0], [0.4, 0.53, 1.0], [0.4, 0.5, 1.0]]),
        bezier(&[[0.4, 0.5, 1.0], [0.4, 0.47, 1.0], [0.44, 0.45, 1.0], [0.5, 0.45, 1.0]]),
        bezier(&[[0.5, 0.45, 1.0], [0.56, 0.45, 1.0], [0.6, 0.47, 1.0], [0.6, 0.5, 1.0]]),
    ]);
    let (trim, cut) = cut(&cylinder, vec![rectangle([0.0, 0.0], [1.0, 1.0]), hole], 1e-7);
    assert!(cut.deviation <= 1.01e-7, "{}", cut.deviation);
    assert_covers(&cylinder, &trim, &cut, 0.002);
    assert_on_surface(&cylinder, &cut, 1e-12);
    assert_reaches_boundary(&trim, &cut, 1e-9);
    println!("{} pieces, {}", cut.pieces.len(), cut.deviation);
}

#[test]
fn slivers_and_tangent_loops() {
    let plate = plane([-2.0, 2.0], [-2.0, 2.0]);
    // A sliver of 1e-6 along a diagonal and one along an axis.
    for corners in [
        [[-1.0, -1.0], [1.0, 1.0], [1.0, 1.0 + 1e-6], [-1.0, -1.0 + 1e-6]],
        [[-1.0, 0.0], [1.0, 0.0], [1.0, 1e-6], [-1.0, 2e-6]],
    ] {
        let (trim, cut) = cut(&plate, vec![polygon(&corners)], 1e-9);
        assert!((area(&cut) - green(&trim)).abs() < 1e-12, "{} {}", area(&cut), green(&trim));
        assert_on_surface(&plate, &cut, 1e-12);
        assert_reaches_boundary(&trim, &cut, 1e-9);
    }
    // A hole that touches the outer circle from within, and one within 1e-6 of doing so.
    for gap in [0.0, 1e-6, 1e-13] {
        for direction in [0.0, 0.7, 0.5 * PI] {
            let (x, y): (f64, f64) = (0.5 * f64::cos(direction), 0.5 * f64::sin(direction));
            let loops = vec![
                circle([0.0, 0.0], 1.0, direction, 4),
                reversed(&circle([x, y], 0.5 - gap, direction, 4)),
            ];
            let (trim, cut) = cut(&plate, loops, 1e-9);
            assert!(
                (area(&cut) - green(&trim)).abs() < 1e-8,
                "{gap} {direction} {}",
                area(&cut) - green(&trim)
            );
            assert!(cut.deviation < 1.1e-9, "{}", cut.deviation);
            assert_covers(&plate, &trim, &cut, 0.005);
            assert_reaches_boundary(&trim, &cut, 1e-9);
            println!("gap {gap} {direction}: {} pieces, {}", cut.pieces.len(), cut.deviation);
        }
    }
}

/// A face lower than the tolerance has no area left, and is still there.
#[test]
fn a_face_thinner_than_the_tolerance_is_covered() {
    let plate = plane([0.0, 1.0], [0.0, 1.0]);
    for thin in [1e-12, 1e-13] {
        for exchange in [false, true] {
            let mut corners = vec![[0.2, 0.5], [0.8, 0.5], [0.8, 0.5 + thin], [0.2, 0.5 + thin]];
            if exchange {
                corners = corners.into_iter().rev().map(|[u, v]| [v, u]).collect();
            }
            // Not a rectangle: one corner is cut.
            corners[2] = [0.5 * (corners[1][0] + corners[2][0]), 0.5 * (corners[1][1] + corners[2][1])];
            let (trim, cut) = cut(&plate, vec![polygon(&corners)], 1e-9);
            assert!(cut.deviation < 1.1e-9, "{}", cut.deviation);
            assert_reaches_boundary(&trim, &cut, 1e-9);
        }
    }
}
