//! The shapes lie on the surfaces that their formulas say.

use crate::support::evaluator::{Vector, distance, evaluate, parameters, point};
use glam::{DQuat, DVec3};
use nurbs_hausdorff::shapes::operations::transformed;
use nurbs_hausdorff::shapes::{self, Naca4, WavySheet, Wing};
use nurbs_hausdorff::{Model, RigidTransform};
use std::f64::consts::PI;

/// Rounding of a rational biquadratic with coordinates near 1.
const ROUNDING: f64 = 1e-14;

const SAMPLES: usize = 33;

/// Calls `check` with points all over surface `index` of `model`.
fn on_surface(model: &Model, index: usize, check: impl Fn(Vector)) {
    let surface = &model.surfaces()[index];
    for [u, v] in parameters(surface, SAMPLES) {
        check(point(surface, u, v));
    }
}

/// Whether normals point away from `inside` on surface `index`.
fn assert_outward(model: &Model, index: usize, inside: impl Fn(Vector) -> Vector) {
    let surface = &model.surfaces()[index];
    for [u, v] in parameters(surface, 9) {
        let at = evaluate(surface, u, v, [0.0; 3]);
        let [p, du, dv] = [at.point, at.u, at.v].map(DVec3::from);
        let normal = du.cross(dv);
        let outward = p - DVec3::from(inside(at.point));
        if normal.length() > 1e-9 * du.length() * dv.length() && du.length() > 1e-9 {
            // 0 at the keel's ends, where the hull is flat.
            assert!(normal.dot(outward) >= -ROUNDING, "surface {index} at ({u}, {v})");
        }
    }
}

#[test]
fn sphere_is_at_radius() {
    let center = DVec3::new(1.0, -2.0, 3.0);
    let model = shapes::sphere(center, 1.7).unwrap();
    on_surface(&model, 0, |p| assert!((distance(p, center.into()) - 1.7).abs() < 10.0 * ROUNDING));
    assert_outward(&model, 0, |_| center.into());
}

#[test]
fn sphere_with_another_seam_is_the_same_sphere() {
    let transform = RigidTransform::new(DQuat::from_rotation_x(0.7), DVec3::new(0.0, 0.0, 5.0)).unwrap();
    let model = transformed(&shapes::sphere(DVec3::ZERO, 2.0).unwrap(), &transform).unwrap();
    on_surface(&model, 0, |p| assert!((distance(p, [0.0, 0.0, 5.0]) - 2.0).abs() < 10.0 * ROUNDING));
    let pole = point(&model.surfaces()[0], 0.0, 1.0);
    assert!(distance(pole, [0.0, -2.0 * 0.7_f64.sin(), 5.0 + 2.0 * 0.7_f64.cos()]) < 10.0 * ROUNDING);
}

#[test]
fn torus_satisfies_its_equation() {
    let model = shapes::torus(2.0, 0.8).unwrap();
    on_surface(&model, 0, |[x, y, z]| {
        assert!(((x.hypot(y) - 2.0).hypot(z) - 0.8).abs() < 10.0 * ROUNDING);
    });
    assert_outward(&model, 0, |[x, y, _]| [2.0 * x / x.hypot(y), 2.0 * y / x.hypot(y), 0.0]);
}

#[test]
fn cylinder_is_at_radius_with_flat_ends() {
    let model = shapes::cylinder(1.5, 4.0).unwrap();
    on_surface(&model, 0, |[x, y, _]| assert!((x.hypot(y) - 1.5).abs() < 10.0 * ROUNDING));
    on_surface(&model, 1, |[x, y, z]| assert!(z == -2.0 && x.hypot(y) < 1.5 + ROUNDING));
    on_surface(&model, 2, |[x, y, z]| assert!(z == 2.0 && x.hypot(y) < 1.5 + ROUNDING));
    for index in 0..3 {
        assert_outward(&model, index, |_| [0.0; 3]);
    }
}

#[test]
fn cone_satisfies_its_equation() {
    let model = shapes::cone(1.8, 4.0).unwrap();
    on_surface(&model, 0, |[x, y, z]| {
        assert!((x.hypot(y) - 1.8 * (2.0 - z) / 4.0).abs() < 10.0 * ROUNDING);
    });
    on_surface(&model, 1, |[_, _, z]| assert_eq!(z, -2.0));
    for index in 0..2 {
        assert_outward(&model, index, |_| [0.0; 3]);
    }
}

#[test]
fn wigley_hull_satisfies_its_equation() {
    let model = shapes::wigley_hull(8.0, 0.8, 0.5).unwrap();
    for (index, sign) in [(0, 1.0), (1, -1.0)] {
        on_surface(&model, index, |[x, y, z]| {
            let expected = sign * 0.4 * (1.0 - (x / 4.0).powi(2)) * (1.0 - (z / 0.5).powi(2));
            assert!((y - expected).abs() < ROUNDING);
            assert!((-0.5..=0.0).contains(&z) && x.abs() <= 4.0);
        });
    }
    on_surface(&model, 2, |[x, y, z]| {
        assert!(z == 0.0 && y.abs() <= 0.4 * (1.0 - (x / 4.0).powi(2)) + ROUNDING);
    });
    for index in 0..3 {
        assert_outward(&model, index, |_| [0.0, 0.0, -0.01]);
    }
}

/// Ordinates of the NACA 0012 basic thickness form in per cent of the chord, by
/// abscissa, from the tables of Abbott and von Doenhoff, appendix I.
const NACA_0012: [(f64, f64); 9] = [
    (1.25, 1.894),
    (5.0, 3.555),
    (10.0, 4.683),
    (20.0, 5.737),
    (30.0, 6.002),
    (50.0, 5.294),
    (70.0, 3.664),
    (90.0, 1.448),
    (100.0, 0.126),
];

#[test]
fn naca_0012_is_as_tabulated() {
    let section = Naca4 { camber: 0.0, position: 0.4, thickness: 0.12 };
    for (abscissa, ordinate) in NACA_0012 {
        let angle = (1.0 - 2.0 * abscissa / 100.0_f64).acos();
        for side in [-1.0, 1.0] {
            let [x, y] = section.point(side * angle);
            assert!((100.0 * x - abscissa).abs() < 1e-9);
            assert!((100.0 * y - side * ordinate).abs() < 6e-4, "at {abscissa} %: {y}");
        }
    }
}

#[test]
fn naca_2412_has_its_camber_where_it_says() {
    let section = Naca4 { camber: 0.02, position: 0.4, thickness: 0.12 };
    let angle = 0.2_f64.acos();
    let ([x_low, low], [x_high, high]) = (section.point(-angle), section.point(angle));
    // The mean line is level at its highest point, so both sides stand above x = 0.4.
    assert!((x_low - 0.4).abs() < 1e-12 && (x_high - 0.4).abs() < 1e-12);
    assert!((0.5 * (low + high) - 0.02).abs() < 1e-12);
}

#[test]
fn wing_has_the_naca_section() {
    let section = Naca4 { camber: 0.02, position: 0.4, thickness: 0.12 };
    let wing = Wing { section, span: 8.0, root_chord: 2.0, taper: 0.5, sweep: 0.35 };
    let model = shapes::wing(&wing).unwrap();
    let skin = &model.surfaces()[0];
    let back = 0.25 + 4.0 * 0.35_f64.tan();
    for (v, chord, y, x0) in [(0.0, 1.0, -4.0, back), (0.5, 2.0, 0.0, 0.0), (1.0, 1.0, 4.0, back)] {
        for index in 0..=400 {
            let u = f64::from(index) / 400.0;
            let [x, z] = section.point(PI * (2.0 * u - 1.0));
            let error = distance(point(skin, u, v), [x0 + chord * x, y, chord * z]);
            // Every tenth parameter is one that the spline interpolates.
            let allowed = if index % 10 == 0 { 100.0 * ROUNDING } else { 1e-4 * chord };
            assert!(error < allowed, "at ({u}, {v}): {error}");
        }
    }
}

#[test]
fn wing_is_closed() {
    let model = shapes::shape("naca-wing").unwrap();
    let [skin, edge, right, left] = model.surfaces() else { panic!("4 surfaces") };
    for index in 0..=50 {
        let t = f64::from(index) / 50.0;
        assert!(distance(point(edge, t, 0.0), point(skin, 0.0, t)) < ROUNDING);
        assert!(distance(point(edge, t, 1.0), point(skin, 1.0, t)) < ROUNDING);
        for (cap, v, upper) in [(right, 1.0, 0.0), (left, 0.0, 1.0)] {
            let u = 0.5 + 0.5 * t;
            assert!(distance(point(cap, u, upper), point(skin, u, v)) < 10.0 * ROUNDING);
            assert!(distance(point(cap, u, 1.0 - upper), point(skin, 1.0 - u, v)) < 10.0 * ROUNDING);
        }
    }
}

#[test]
fn vessels_are_round_and_as_high_as_asked() {
    for (model, height) in [(shapes::glass(5.0).unwrap(), 5.0), (shapes::bottle(6.0).unwrap(), 6.0)] {
        let surface = &model.surfaces()[0];
        for [u, v] in parameters(surface, SAMPLES) {
            let ([x, y, z], [radius, _, level]) = (point(surface, u, v), point(surface, 0.0, v));
            assert!((x.hypot(y) - radius).abs() < 10.0 * ROUNDING && (z - level).abs() < 10.0 * ROUNDING);
            assert!((-0.01 * height..=height + ROUNDING).contains(&z));
        }
    }
}

#[test]
fn wavy_sheet_has_the_net_asked_for() {
    let sheet =
        WavySheet { counts: [298, 13], size: [6.0, 3.0], amplitude: 0.5, waves: [2.0, 1.0], phase: 0.25 };
    let model = shapes::wavy_sheet(&sheet).unwrap();
    let surface = &model.surfaces()[0];
    assert_eq!(surface.counts(), [298, 13]);
    let net = surface.control_points();
    assert_eq!(net[0][..2], [-3.0, -1.5]);
    assert_eq!(net[298 * 13 - 1][..2], [3.0, 1.5]);
    assert!((net[0][2] - 0.5 * 0.25_f64.sin()).abs() < ROUNDING);
    // A corner of a clamped surface is its control point.
    assert!(distance(point(surface, 1.0, 1.0), [3.0, 1.5, net[298 * 13 - 1][2]]) < ROUNDING);
}

#[test]
fn figure5_samples_miss_the_axis_by_9_58() {
    let plane = shapes::figure5_plane().unwrap();
    let samples = parameters(&plane.surfaces()[0], shapes::FIGURE5_SAMPLES);
    let points: Vec<Vector> = samples.iter().map(|&[u, v]| point(&plane.surfaces()[0], u, v)).collect();
    assert!((distance(points[0], points[1]) - 16.0).abs() < 1e-10);
    let nearest = points.iter().map(|p| p[0].hypot(p[1])).fold(f64::INFINITY, f64::min);
    assert!((nearest - 9.58).abs() < 1e-10);
    let farthest = points.iter().map(|p| p[0].hypot(p[1])).fold(0.0, f64::max);
    assert!(farthest - shapes::FIGURE5_RADIUS < shapes::FIGURE5_RADIUS, "the axis must be the farthest");
    on_surface(&shapes::figure5_cylinder().unwrap(), 0, |[x, y, _]| {
        assert!((x.hypot(y) - 320.0).abs() < 320.0 * 10.0 * ROUNDING);
    });
}

#[test]
fn every_name_makes_a_shape_and_others_are_refused() {
    assert_eq!(shapes::list().count(), 21);
    for info in shapes::list() {
        let model = shapes::shape(info.name).unwrap();
        assert!(model.name().is_some() && !info.title.is_empty());
        assert!(model.bounding_box().diagonal() > 0.5);
    }
    let error = shapes::shape("dodecahedron").unwrap_err();
    assert_eq!(error.code(), "UNKNOWN_SHAPE");
    assert!(error.to_string().contains("dodecahedron") && error.to_string().contains("naca-wing"));
}

#[test]
fn sizes_out_of_range_are_refused() {
    let section = Naca4 { camber: 0.02, position: 0.4, thickness: 0.12 };
    let good = Wing { section, span: 8.0, root_chord: 2.0, taper: 0.5, sweep: 0.3 };
    let sheet = WavySheet { counts: [4, 4], size: [1.0; 2], amplitude: 1.0, waves: [1.0; 2], phase: 0.0 };
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for refused in [
            shapes::sphere(DVec3::ZERO, bad),
            shapes::torus(bad, 1.0),
            shapes::torus(1.0, bad),
            shapes::cylinder(bad, 1.0),
            shapes::cylinder(1.0, bad),
            shapes::cone(bad, 1.0),
            shapes::cone(1.0, bad),
            shapes::glass(bad),
            shapes::bottle(bad),
            shapes::wigley_hull(bad, 1.0, 1.0),
            shapes::wigley_hull(1.0, bad, 1.0),
            shapes::wigley_hull(1.0, 1.0, bad),
            shapes::wing(&Wing { span: bad, ..good }),
            shapes::wing(&Wing { root_chord: bad, ..good }),
            shapes::wing(&Wing { taper: bad, ..good }),
            shapes::wing(&Wing { section: Naca4 { thickness: bad, ..section }, ..good }),
            shapes::wing(&Wing { section: Naca4 { position: bad, ..section }, ..good }),
            shapes::wavy_sheet(&WavySheet { size: [bad, 1.0], ..sheet }),
        ] {
            assert_eq!(refused.unwrap_err().code(), "OPTION_OUT_OF_RANGE");
        }
    }
    for refused in [
        shapes::wing(&Wing { sweep: 2.0, ..good }),
        shapes::wing(&Wing { section: Naca4 { camber: 0.5, ..section }, ..good }),
        shapes::wavy_sheet(&WavySheet { amplitude: f64::NAN, ..sheet }),
    ] {
        assert_eq!(refused.unwrap_err().code(), "OPTION_OUT_OF_RANGE");
    }
    let few = shapes::wavy_sheet(&WavySheet { counts: [4, 3], ..sheet });
    assert_eq!(few.unwrap_err().code(), "TOO_FEW_CONTROL_POINTS");
    let nowhere = shapes::sphere(DVec3::new(f64::NAN, 0.0, 0.0), 1.0);
    assert_eq!(nowhere.unwrap_err().code(), "TRANSFORM_NOT_RIGID");
}
