//! Offsets that are not rational, or not written as what they are: approximated, with the
//! deviation in the gap.

use crate::area::{area, loop_points, surface_points};
use crate::support::quadrature::gauss;
use crate::support::writers::brep::{BrepText, line, plus, rectangle};
use crate::{area_of, assert_near, region};
use nurbs_hausdorff_cad::from_brep;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI, TAU};

/// The gap of an approximation: present, and far below the size.
#[track_caller]
fn assert_fitted(gap: f64, size: f64) {
    assert!(gap > 0.0 && gap <= 2e-9 * size, "{gap}");
}

/// A quarter of a circle of radius 2 in the plane of x and `up`, as poles with their weights.
fn quarter(up: usize) -> String {
    let mut poles = [[2.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0; 3]];
    poles[1][up] = 2.0;
    poles[2][up] = 2.0;
    let weights = [1.0, FRAC_1_SQRT_2, 1.0];
    poles.iter().zip(weights).map(|([x, y, z], w)| format!("{x:?} {y:?} {z:?} {w:?} ")).collect()
}

/// The surface z = x y has the area element √w, the mean curvature -x y w^(-3/2) and the
/// Gaussian one -1/w², w = 1 + x² + y². At the distance d the element is (1 - 2Hd + Kd²) √w.
#[test]
fn the_offset_of_a_hyperbolic_paraboloid_has_steiners_area() {
    let d = 0.5_f64;
    let surface = format!("11 {d:?}\n8 0 0 1 1 0 0 0 0 1 0 1 0 0 1 1 1");
    let (model, report) = region(&surface, &[rectangle([0.0, 0.0], [1.0, 1.0])]);
    assert_eq!((report.trims, report.exact, report.fitted), (4, 0, 4));
    assert_fitted(report.gap, 2.0);
    // A surface that no NURBS equals is compared at points.
    assert!(!report.gap_proven);
    assert!(!model.faces().any(|face| face.is_gap_proven()));
    let rule = gauss(20);
    let plain: f64 = rule
        .iter()
        .flat_map(|&[x, wx]| rule.iter().map(move |&[y, wy]| wx * wy * (1.0 + x * x + y * y).sqrt()))
        .sum();
    let mean = d * (1.5 * 3.0_f64.ln() - 2.0 * 2.0_f64.ln());
    assert_near(area_of(&model), plain + mean - d * d * PI / 6.0, 1e-8);
    // The corner (1, 1, 1) moves along (-1, -1, 1) / √3.
    let face = model.faces().next().unwrap();
    let step = d / 3.0_f64.sqrt();
    let near = |p: &[f64; 3]| (p[0] - 1.0 + step).hypot(p[1] - 1.0 + step).hypot(p[2] - 1.0 - step) < 1e-8;
    assert!(surface_points(&face).iter().any(near));
}

/// An octant of a sphere as a rational patch with a pole, offset and cut.
#[test]
fn the_offset_of_a_rational_sphere_is_a_sphere() {
    let h = FRAC_1_SQRT_2;
    // The circle of latitude times the meridian; all of the third column is the pole.
    let mut poles = String::new();
    for ([x, y], wu) in [([2.0, 0.0], 1.0), ([2.0, 2.0], h), ([0.0, 2.0], 1.0)] {
        for (scale, z, wv) in [(1.0, 0.0, 1.0), (1.0, 2.0, h), (0.0, 2.0, 1.0)] {
            poles += &format!("{:?} {:?} {z:?} {:?}\n", scale * x, scale * y, wu * wv);
        }
    }
    for (distance, radius) in [(0.5, 2.5_f64), (-0.75, 1.25)] {
        let surface = format!("11 {distance:?}\n8 1 1 2 2 {poles}");
        let (model, report) = region(&surface, &[rectangle([0.0, 0.0], [1.0, 1.0])]);
        // The normal at the pole is that of a point beside it.
        assert!(report.gap > 0.0 && report.gap < 1e-6, "{}", report.gap);
        let face = model.faces().next().unwrap();
        assert_near(area(&face), PI * radius * radius / 2.0, 1e-6);
        for [x, y, z] in surface_points(&face) {
            assert!((x.hypot(y).hypot(z) - radius).abs() <= report.gap);
        }
    }
}

/// Swept surfaces stay exact across the profile: u is still the angle, and v linear.
#[test]
fn offsets_of_swept_surfaces_sweep_the_offset_profile() {
    let extruded = format!("11 0.5\n6 0 0 1\n6 1 2 {}", quarter(1));
    let (model, report) = region(&extruded, &[rectangle([0.0, 0.0], [1.0, 3.0])]);
    assert_fitted(report.gap, 4.0);
    assert_eq!(model.surfaces()[0].degree()[1], 1);
    assert_near(area_of(&model), FRAC_PI_2 * 2.5 * 3.0, 1e-8);
    // A meridian turned about z: S_u × S_v points outwards.
    let revolved = format!("11 0.5\n7 0 0 0 0 0 1\n6 1 2 {}", quarter(2));
    let (model, report) = region(&revolved, &[rectangle([0.0, 0.0], [TAU, 1.0])]);
    assert_fitted(report.gap, 8.0);
    assert_eq!(model.surfaces()[0].degree()[0], 2);
    assert_near(area_of(&model), TAU * 2.5 * 2.5, 1e-8);
}

#[test]
fn offset_curves_bound_faces() {
    // In the parameters: the sector of radius 2.5, whose arc is an offset to the right.
    let poles = "2 0 1 2 2 0.7071067811865476 0 2 1";
    let arc = (format!("9 0.5\n6 1 2 {poles}"), [0.0, 1.0]);
    let loops = [vec![line([0.0, 0.0], [2.5, 0.0]), arc, line([0.0, 2.5], [0.0, 0.0])]];
    let (model, report) = region("1 0 0 3 0 0 1 1 0 0 0 1 0", &loops);
    assert_eq!((report.exact, report.fitted), (2, 1));
    assert_fitted(report.gap, 8.0);
    assert_near(area_of(&model), PI * 6.25 / 4.0, 1e-8);
    // In space, without curves in the parameters.
    let mut text = BrepText::new();
    let surface = text.surface("1 0 0 0 0 0 1 1 0 0 0 1 0");
    let [center, east, north] = [[0.0; 3], [2.5, 0.0, 0.0], [0.0, 2.5, 0.0]].map(|point| text.vertex(point));
    let curves = [
        "1 0 0 0 1 0 0".to_owned(),
        format!("9 0.5\n0 0 1\n6 1 2 {}", quarter(1)),
        "1 0 2.5 0 0 -1 0".to_owned(),
    ];
    let [right, arc, down] = curves.map(|curve| text.curve(curve));
    let edges = [
        plus(text.edge(&[format!("1 {right} 0 0 2.5")], [center, east])),
        plus(text.edge(&[format!("1 {arc} 0 0 1")], [east, north])),
        plus(text.edge(&[format!("1 {down} 0 0 2.5")], [north, center])),
    ];
    let wire = text.wire(&edges);
    let face = text.face(surface, &[wire]);
    let (model, report) = crate::read(&text, face);
    assert_eq!((report.exact, report.fitted), (2, 1));
    assert_fitted(report.gap, 4.0);
    let face = model.faces().next().unwrap();
    assert_near(area(&face), PI * 6.25 / 4.0, 1e-8);
    for (_, [x, y, _]) in loop_points(&face) {
        let on_arc = x > 1e-9 && y > 1e-9;
        assert!(!on_arc || (x.hypot(y) - 2.5).abs() <= report.gap);
    }
}

/// The sides of a crease move apart, so that the offset is no surface.
#[test]
fn the_offset_of_a_crease_is_skipped_and_reported() {
    let mut text = BrepText::new();
    let creased = "9 0 0 0 0 1 1 3 2 3 2 0 0 0 0 1 0 1 0 0 1 1 0 2 0 1 2 1 1 0 2 1 1 2 2 0 2 1 2";
    let surface = text.surface(format!("11 0.5\n{creased}"));
    let plain = text.surface(creased);
    let square = [rectangle([0.0, 0.0], [2.0, 1.0])];
    let faces = [text.region(surface, &square), text.region(plain, &square)];
    let shell = text.shape("Sh\n", &faces.map(plus));
    let (model, report) = from_brep(&text.text(plus(shell))).unwrap();
    assert_eq!((model.faces().len(), report.skipped.len()), (1, 1));
    assert_eq!((&report.skipped[0].face, report.skipped[0].code), (&0.into(), "BREP_OFFSET"));
}
