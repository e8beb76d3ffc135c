//! Bézier and B-spline surfaces and curves, periodic ones among them.

use crate::area::{area, surface_points};
use crate::support::writers::brep::{circle, line, rectangle};
use crate::{area_of, assert_near, region};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// The square [0, 2] x [0, 1] as a bicubic Bézier surface whose points are (2 u, v, 0).
fn bicubic() -> String {
    let mut entry = "8 0 0 3 3".to_owned();
    for i in 0..4 {
        for j in 0..4 {
            entry += &format!(" {:?} {:?} 0", 2.0 * f64::from(i) / 3.0, f64::from(j) / 3.0);
        }
    }
    entry
}

#[test]
fn curves_on_bezier_surfaces_stay_exact() {
    let hole = circle([0.5, 0.5], 0.25, -1.0);
    let (model, report) = region(&bicubic(), &[rectangle([0.0, 0.0], [1.0, 1.0]), hole]);
    assert_eq!((report.exact, report.fitted), (5, 0));
    assert!(report.gap < 1e-14, "{}", report.gap);
    assert_near(area_of(&model), 2.0 - 2.0 * PI / 16.0, 1e-12);
    assert_eq!(model.surfaces()[0].degree(), [3, 3]);
}

#[test]
fn every_kind_of_parameter_curve_is_read() {
    // A region of area between the axis v = 0.2 and each curve from (0.2, 0.2) to (0.8, 0.2).
    let close = line([0.8, 0.2], [0.2, 0.2]);
    let area_under = |entry: &str, range: [f64; 2]| {
        // Curves run over the line, so that the loop is clockwise and is reversed.
        let (model, report) = region(&bicubic(), &[vec![(entry.to_owned(), range), close.clone()]]);
        assert_eq!(report.fitted, 0);
        area_of(&model) / 2.0
    };
    // A half ellipse of axes 0.3 and 0.4, and a half circle.
    let ellipse = "3 0.5 0.2 -1 0 0 1 0.3\n0.4";
    assert_near(area_under(ellipse, [0.0, PI]), PI * 0.12 / 2.0, 1e-12);
    assert_near(area_under("2 0.5 0.2 -1 0 0 1 0.3", [0.0, PI]), PI * 0.09 / 2.0, 1e-12);
    // The parabola v = 0.2 + h - (u - 0.5)² / (4 f), with its apex up: 2/3 of the rectangle.
    let (focal, half) = (0.1, 0.3_f64);
    let height = half * half / (4.0 * focal);
    let parabola = format!("4 0.5 {:?} 0 -1 1 0 {focal:?}", 0.2 + height);
    assert_near(area_under(&parabola, [-half, half]), 2.0 / 3.0 * 0.6 * height, 1e-12);
    // The hyperbola (R cosh t, r sinh t) between ±t: with the chord it encloses
    // R r (sinh t cosh t - t). Its axis points down from the apex.
    let t = 1.2_f64;
    let (major, minor) = (0.25, 0.3 / t.sinh());
    let top = 0.2 + major * (t.cosh() - 1.0);
    let hyperbola = format!("5 0.5 {:?} 0 -1 1 0 {major:?}\n{minor:?}", top + major);
    assert_near(area_under(&hyperbola, [-t, t]), major * minor * (t.sinh() * t.cosh() - t), 1e-12);
    // A rational Bézier quarter of a circle is half of the half circle above.
    let quarter = format!("6 1 2 0.2 0.2 1 0.2 0.5 {FRAC_1_SQRT_2:?} 0.5 0.5 1");
    let loops = [vec![(quarter, [0.0, 1.0]), line([0.5, 0.5], [0.5, 0.2]), line([0.5, 0.2], [0.2, 0.2])]];
    assert_near(area_of(&region(&bicubic(), &loops).0) / 2.0, PI * 0.09 / 4.0, 1e-12);
    // A quadratic B-spline of two spans, a trimmed longer one, and offsets of line and circle.
    let spline = "7 0 0  2 4 3  0.2 0.2 0.3 0.5 0.7 0.5 0.8 0.2\n 0 3 1 1 2 3";
    let whole = area_under(spline, [0.0, 2.0]);
    // The polygon's B-spline: the integral of v du of both parabolas, 0.12.
    assert_near(whole, 0.12, 0.2);
    let trimmed = format!("8 0 2\n{spline}");
    assert_near(area_under(&trimmed, [0.0, 2.0]), whole, 1e-14);
    // T × Z points to the right of the direction, here to the centre.
    assert_near(area_under("9 -0.1\n2 0.5 0.2 -1 0 0 1 0.2", [0.0, PI]), PI * 0.09 / 2.0, 1e-12);
}

/// A circle of radius 2 as a periodic quadratic B-spline of four quarters, extruded along z.
fn periodic_cylinder(height: f64) -> String {
    let corners = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];
    let mut entry = "9 1 0 1 0 2 1 8 2 5 2\n".to_owned();
    for (index, [x, y]) in corners.into_iter().enumerate() {
        let weight = if index % 2 == 0 { 1.0 } else { FRAC_1_SQRT_2 };
        for z in [0.0, height] {
            entry += &format!(" {} {} {z:?} {weight:?}", 2 * x, 2 * y);
        }
    }
    entry + "\n 0 2\n 1 2\n 2 2\n 3 2\n 4 2\n 0 2\n 1 2\n"
}

#[test]
fn a_periodic_surface_is_unrolled_over_its_loops() {
    for start in [0.0, 0.5, -1.0, 3.25, 7.0] {
        // Half a turn, whose curves may lie across the first knot and beyond the period.
        let (model, _) = region(&periodic_cylinder(5.0), &[rectangle([start, 0.0], [start + 2.0, 1.0])]);
        let face = model.faces().next().unwrap();
        assert_near(area(&face), 2.0 * PI * 5.0, 1e-9);
        assert!(surface_points(&face).iter().all(|[x, y, _]| (x.hypot(*y) - 2.0).abs() < 1e-14));
        let [u, _] = face.surface().domain().intervals();
        assert_eq!(u, [start, start + 2.0]);
    }
    // Two rings.
    let ring = |v: f64, turn: f64| vec![(format!("1 0.4 {v:?} {turn:?} 0"), [0.0, 4.0])];
    let (model, _) = region(&periodic_cylinder(5.0), &[ring(0.2, 1.0), ring(0.7, -1.0)]);
    assert_near(area_of(&model), 4.0 * PI * 2.5, 1e-9);
}

/// A smooth periodic curve: the cubic basis of eight equal knots, against its definition.
#[test]
fn smooth_periodic_curves_follow_their_basis() {
    let poles =
        [[0.2, 0.2], [0.5, 0.1], [0.8, 0.2], [0.9, 0.5], [0.8, 0.8], [0.5, 0.9], [0.2, 0.8], [0.1, 0.5]];
    let mut entry = "7 0 1  3 8 9 ".to_owned();
    entry += &poles.iter().map(|[u, v]| format!(" {u:?} {v:?}")).collect::<String>();
    entry += &(0..9).map(|knot| format!("\n {knot} 1")).collect::<String>();
    // The area is the sum of b_k P_i × P_{i+k} with b_k the integral of N_0 N_k', which is
    // 245, 56 and 1 of 720; as Σ k N_k = t + c, twice Σ k b_k is 1.
    let weights = [245.0, 56.0, 1.0].map(|b| b / 720.0);
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let mut expected = 0.0;
    for index in 0..8 {
        for (step, weight) in weights.iter().enumerate() {
            expected += weight * cross(poles[index], poles[(index + step + 1) % 8]);
        }
    }
    for start in [0.0, 2.5] {
        let (model, report) = region(&bicubic(), &[vec![(entry.clone(), [start, start + 8.0])]]);
        assert_eq!(report.exact, 1);
        assert_near(area_of(&model) / 2.0, expected, 1e-11);
    }
}

#[test]
fn loops_beyond_the_knots_extend_the_surface() {
    let (model, _) = region(&bicubic(), &[rectangle([-0.02, 0.0], [1.03, 1.0])]);
    assert_near(area_of(&model), 2.0 * 1.05, 1e-12);
    let [u, v] = model.surfaces()[0].domain().intervals();
    assert_near(u[0], -0.02, 1e-16);
    assert_near(u[1], 1.03, 1e-15);
    assert_eq!(v, [0.0, 1.0]);
}
