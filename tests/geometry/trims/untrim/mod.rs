//! Trimmed faces cut into patches: areas, coverage, deviation.

mod coverage;

use coverage::{area, assert_covers, assert_on_surface, assert_reaches_boundary, green};
use nurbs_hausdorff::internals::model::trim::{Trim, TrimCurveArrays};
use nurbs_hausdorff::internals::untrim::{ParameterMap, Untrimmed, untrim};
use nurbs_hausdorff::{NurbsSurface, SurfaceArrays};
use std::f64::consts::PI;

use crate::support::trims::{arcs, bezier, polygon, rectangle, reversed};

type Point = [f64; 2];

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

#[test]
fn a_plate_with_a_round_bore_is_exact() {
    let plate = plane([0.0, 100.0], [0.0, 60.0]);
    for (start, count) in [(0.0, 4), (0.3, 4), (0.0, 3), (1.0, 5)] {
        let bore = reversed(arcs([40.0, 30.0], 10.0, start, count));
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
        arcs([0.0, 0.0], 9.0, 0.1, 4),
        reversed(polygon(&[[-4.0, -4.0], [4.5, -3.0], [4.0, 4.0], [-3.0, 4.5]])),
        arcs([0.2, -0.1], 2.0, 0.0, 3),
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
    let hole = reversed(arcs([1.0, 1.4], 0.3, 0.2, 4));
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
    let hole = reversed(vec![
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
            let loops =
                vec![arcs([0.0, 0.0], 1.0, direction, 4), reversed(arcs([x, y], 0.5 - gap, direction, 4))];
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

#[test]
fn holes_that_cross_by_rounding_on_a_surface_of_very_different_weights() {
    let points = (0..16)
        .map(|k| {
            let (i, j) = (k / 4, k % 4);
            let weight = 10.0_f64.powi(-((5 * i + 3 * j) % 5));
            [i as f64, j as f64, 0.3 * ((i * j) as f64).sin(), weight]
        })
        .collect();
    let surface = surface([3, 3], [[0.0, 1.0]; 2], points);
    // The holes cross by 4e-8 of the domain, by less than validation sees. Bounds on derivatives
    // from all weights at once allow no such crossing.
    let hole = |x: f64| reversed(arcs([x, 0.5], 0.1 + 2e-8, 0.3, 4));
    let loops = vec![arcs([0.5, 0.5], 0.35, 0.0, 4), hole(0.4), hole(0.6)];
    let (trim, cut) = cut(&surface, loops, 1e-9);
    assert!(cut.deviation <= 1.01e-9, "{}", cut.deviation);
    assert_covers(&surface, &trim, &cut, 0.01);
    assert_on_surface(&surface, &cut, 1e-12);
}

#[test]
fn a_ring_narrower_than_the_deviation_is_covered() {
    // So large a deviation allows every move of the boundary, and those would cross.
    let sheet = sheet();
    let center = [1.044_134, 1.385_037];
    for (start, hole_start) in [(2.3485, 3.0593), (0.0, 0.3), (0.4, 1.1)] {
        let hole = reversed(arcs(center, 0.6 - 1e-6, hole_start, 5));
        let (trim, cut) = cut(&sheet, vec![arcs(center, 0.6, start, 4), hole], 1.0);
        assert!(cut.deviation <= 1.0, "{}", cut.deviation);
        assert_on_surface(&sheet, &cut, 1e-12);
        assert_reaches_boundary(&trim, &cut, 1e-4);
    }
}

/// Arcs of a circle of radius 1/8 about a point beside the knot line u = 0.7 of the sheet touch
/// that line in the middle of their height, where the order of arc and line does not show.
#[test]
fn circles_that_touch_a_knot_line_are_cut_on_their_side_of_it() {
    let sheet = sheet();
    for (side, start) in [(-1.0, 0.0), (1.0, 0.0), (-1.0, 0.5 * PI), (1.0, 0.4)] {
        let circle = arcs([0.7 + side * 0.125, 0.75], 0.125, start, 4);
        let (trim, island) = cut(&sheet, vec![circle.clone()], 1e-8);
        assert_covers(&sheet, &trim, &island, 0.002);
        assert_reaches_boundary(&trim, &island, 1e-8);
        let outer = rectangle([0.3, 0.25], [1.0, 1.25]);
        let (trim, around) = cut(&sheet, vec![outer, reversed(circle)], 1e-8);
        assert_covers(&sheet, &trim, &around, 0.002);
        assert_on_surface(&sheet, &around, 1e-12);
        assert_reaches_boundary(&trim, &around, 1e-8);
    }
}

/// A circle of three arcs of 120°, whose last weights and points are off by a few units as affine
/// maps of OpenCASCADE write them: the levels of both sides differ by units, too.
#[test]
fn a_circle_of_three_arcs_with_rounded_weights_is_a_disc() {
    let half = 3.0_f64.sqrt() / 2.0;
    let mut random = fastrand::Rng::with_seed(11);
    for _ in 0..40 {
        let [a, b, c, d] = [(); 4].map(|()| 4.0 * random.f64() - 2.0);
        if (a * d - b * c).abs() < 0.2 {
            continue;
        }
        let mut off = || 1.0 + f64::from(random.i32(-8..=8)) * f64::EPSILON;
        let corners =
            [[1.0, 0.0], [1.0, 2.0 * half], [-0.5, half], [-2.0, 0.0], [-0.5, -half], [1.0, -2.0 * half]];
        let weights = [1.0, 0.5, 1.0, 0.5, 1.0, 0.5];
        let image = |k: usize, off: &mut dyn FnMut() -> f64| {
            let ([x, y], w) = (corners[k % 6], weights[k % 6]);
            [(20.0 + 5.0 * (a * x + b * y)) * off(), (15.0 + 5.0 * (c * x + d * y)) * off(), w * off()]
        };
        let mut points: Vec<[f64; 3]> = (0..6).map(|k| image(k, &mut off)).collect();
        points.push([points[0][0], points[0][1], off()]);
        if a * d < b * c {
            points.reverse();
        }
        let third = 2.0 * PI / 3.0;
        let knots = [0.0, 0.0, 0.0, third, third, 2.0 * third, 2.0 * third, 2.0 * PI, 2.0 * PI, 2.0 * PI];
        let curve = TrimCurveArrays {
            degree: 2,
            knots: knots.to_vec(),
            control_points: points,
            ..TrimCurveArrays::default()
        };
        // The plane ends where the disc does, as files write it.
        let reach = |x: f64, y: f64| 5.0 * (x * x + y * y).sqrt();
        let plate = plane(
            [20.0 - 1.001 * reach(a, b), 20.0 + 1.001 * reach(a, b)],
            [15.0 - 1.001 * reach(c, d), 15.0 + 1.001 * reach(c, d)],
        );
        let (trim, cut) = cut(&plate, vec![vec![curve]], 1e-8);
        let expected = 25.0 * PI * (a * d - b * c).abs();
        assert!(cut.deviation <= 1e-8, "{}", cut.deviation);
        let length = 2.0 * PI * reach(a, b).hypot(reach(c, d));
        let found = area(&cut);
        assert!((found - expected).abs() <= cut.deviation * length + 1e-12 * expected, "{found} {expected}");
        assert_covers(&plate, &trim, &cut, 0.05);
    }
}
