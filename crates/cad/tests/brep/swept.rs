//! Extrusions, revolutions, trimmed and offset surfaces.

use crate::area::surface_points;
use crate::support::writers::brep::rectangle;
use crate::{area_of, assert_near, region};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

#[test]
fn extrusions_have_the_length_of_their_profile() {
    // A circle of radius 3 in the plane z = 0, along (0, 0, 1).
    let circle = "6 0 0 1\n2 0 0 0 0 0 1 1 0 0 0 1 0 3";
    let (model, report) = region(circle, &[rectangle([0.5, 1.0], [2.5, 5.0])]);
    assert_eq!(report.exact, 4);
    assert_near(area_of(&model), 3.0 * 2.0 * 4.0, 1e-12);
    assert_eq!(model.faces().next().unwrap().kind(), Some("extrusion"));
    // The parabola (t² / 4, t, 0): its length is that of the arc, √(1 + t²/4) integrated.
    let parabola = "6 0 0 1\n4 0 0 0 0 0 1 1 0 0 0 1 0 1";
    let (model, _) = region(parabola, &[rectangle([0.0, 0.0], [2.0, 1.0])]);
    assert_near(area_of(&model), 2.0_f64.sqrt() + 1.0_f64.asinh(), 1e-9);
    // The hyperbola (cosh t, sinh t, 0) lies on x² - y² = 1; its parameter lines stay exact.
    let hyperbola = "6 0 0 1\n5 0 0 0 0 0 1 1 0 0 0 1 0 1\n1";
    let (model, report) = region(hyperbola, &[rectangle([-1.5, 0.0], [2.0, 1.0])]);
    assert_eq!(report.exact, 4);
    let points = surface_points(&model.faces().next().unwrap());
    assert!(points.iter().all(|[x, y, _]| (x * x - y * y - 1.0).abs() < 1e-12));
    let ends = points.iter().map(|point| point[1]).fold([0.0_f64; 2], |[a, b], y| [a.min(y), b.max(y)]);
    assert_near(ends[0], -(1.5_f64.sinh()), 1e-14);
    assert_near(ends[1], 2.0_f64.sinh(), 1e-14);
}

#[test]
fn revolutions_turn_their_profile() {
    // A segment from (2, 0, 0) to (5, 0, 4) about z: a cone of slant 5.
    let segment = "7 0 0 0 0 0 1\n8 0 5\n1 2 0 0 0.6 0 0.8";
    let (model, report) = region(segment, &[rectangle([0.0, 0.0], [TAU, 5.0])]);
    assert_eq!(report.exact, 4);
    assert_near(area_of(&model), PI * (2.0 + 5.0) * 5.0, 1e-11);
    // A circle of radius 1 about an axis through (5, 0, 0) in the direction of y: a torus.
    let circle = "7 5 0 0 0 1 0\n2 1 0 0 0 0 1 1 0 0 0 1 0 1";
    let (model, _) = region(circle, &[rectangle([0.0, 0.0], [TAU, TAU])]);
    assert_near(area_of(&model), 4.0 * PI * PI * 4.0, 1e-11);
    // A skew line: a hyperboloid x² + y² = 1 + z².
    let skew = "7 0 0 0 0 0 1\n1 1 0 0 0 1 1";
    let (model, _) = region(skew, &[rectangle([0.0, -2.0], [3.0, 2.0])]);
    let points = surface_points(&model.faces().next().unwrap());
    assert!(points.iter().all(|[x, y, z]| (x * x + y * y - 1.0 - z * z).abs() < 1e-12));
    // A cubic Bézier profile: S(0, v) is the profile.
    let cubic = "7 0 0 0 0 0 1\n6 0 3 1 0 0 2 0 1 1 0 2 2 0 3";
    let (model, _) = region(cubic, &[rectangle([0.0, 0.0], [FRAC_PI_2, 1.0])]);
    assert_eq!(model.surfaces()[0].degree(), [2, 3]);
    let middle = crate::support::evaluator::point(&model.surfaces()[0], 0.0, 0.5);
    assert!((middle[0] - 1.5).abs() < 1e-15 && middle[1] == 0.0 && (middle[2] - 1.5).abs() < 1e-15);
}

#[test]
fn offsets_of_elementary_surfaces_are_of_the_same_kind() {
    let area = |surface: &str, corners: [[f64; 2]; 2]| {
        let (model, report) = region(surface, &[rectangle(corners[0], corners[1])]);
        assert_eq!(report.exact, 4);
        area_of(&model)
    };
    let frame = "0 0 0 0 0 1 1 0 0 0 1 0";
    assert_near(area(&format!("11 0.5\n2 {frame} 2"), [[0.0, 0.0], [1.0, 3.0]]), 7.5, 1e-13);
    // In a left-handed frame the normal points inward.
    assert_near(area("11 0.5\n2 0 0 0 0 0 1 1 0 0 0 -1 0 2", [[0.0, 0.0], [1.0, 3.0]]), 4.5, 1e-13);
    let sphere = area(&format!("11 -1\n4 {frame} 10"), [[0.0, -1.0], [1.0, 1.0]]);
    assert_near(sphere, 81.0 * 2.0 * 1.0_f64.sin(), 1e-11);
    let torus = area(&format!("11 1\n5 {frame} 10 2"), [[0.0, 0.0], [1.0, PI]]);
    assert_near(torus, 3.0 * 10.0 * PI, 1e-11);
    // The offset of a cone is a cone about the same axis, its radii larger by d / cos a.
    let (half_angle, d) = (0.5_f64, 0.7);
    let cone = format!("11 {d:?}\n3 {frame}\n4 {half_angle:?}");
    let (model, _) = region(&cone, &[rectangle([0.0, 0.0], [1.0, 3.0])]);
    for [x, y, z] in surface_points(&model.faces().next().unwrap()) {
        assert_near(x.hypot(y), 4.0 + z * half_angle.tan() + d / half_angle.cos(), 1e-14);
    }
    // Planes move along their normal, whatever the nesting.
    let (model, _) =
        region(&format!("11 1\n10 0 9 0 9\n11 2\n1 {frame}"), &[rectangle([0.0, 0.0], [1.0, 1.0])]);
    assert!(surface_points(&model.faces().next().unwrap()).iter().all(|point| point[2] == 3.0));
    // Extruded circles and revolved segments.
    let circle = format!("11 0.5\n6 0 0 1\n2 {frame} 2");
    assert_near(area(&circle, [[0.0, 0.0], [1.0, 3.0]]), 7.5, 1e-13);
    assert_near(area("11 0.5\n7 0 0 0 0 0 1\n1 2 0 0 0 0 1", [[0.0, 0.0], [1.0, 3.0]]), 7.5, 1e-13);
}

#[test]
fn trimmed_surfaces_keep_the_parameters_of_their_basis() {
    let trimmed = "10 5 7 1 3\n2 0 0 0 0 0 1 1 0 0 0 1 0 20";
    let (model, report) = region(trimmed, &[rectangle([5.0, 1.0], [7.0, 3.0])]);
    assert_eq!((report.exact, model.faces().next().unwrap().kind()), (4, Some("cylinder")));
    assert_near(area_of(&model), 20.0 * 2.0 * 2.0, 1e-12);
}
