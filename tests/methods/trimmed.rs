//! Trimmed models whose distances follow from their geometry.

use crate::support::evaluator;
use crate::support::fixtures::with_grid;
use crate::support::trims::{
    ball, circle, cylinder, ellipse, face, fitted, line, plane, polygon, quarter_parameter, rectangle,
    reversed,
};
use glam::DVec3;
use nurbs_hausdorff::internals::model::ModelArrays;
use nurbs_hausdorff::tessellate::{TessellationOptions, tessellate};
use nurbs_hausdorff::trim::{FaceArrays, TrimCurveArrays};
use nurbs_hausdorff::{
    Backend, DistanceOptions, DistanceResult, Engine, MethodName, Model, PreparedModel, SurfaceArrays,
};
use std::f64::consts::{FRAC_PI_2, PI, SQRT_2, TAU};

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

fn model(faces: Vec<FaceArrays>) -> Model {
    let faces = faces
        .into_iter()
        .enumerate()
        .map(|(index, face)| FaceArrays { face_name: Some(format!("face {index}")), ..face });
    Model::from_faces(ModelArrays { faces: faces.collect(), ..ModelArrays::default() }).unwrap()
}

/// All control points coincide: the trimmed face is that point.
#[test]
fn a_surface_that_is_a_point_may_be_trimmed() {
    let mut surface = plane([0.0; 3], X, Y, [[2.0, 3.0]; 2]);
    surface.control_points = vec![[1.0, 2.0, 3.0, 1.0]; 4];
    for trim in [rectangle([2.0, 2.0], [3.0, 3.0]), circle([2.5, 2.5], 0.25)] {
        let point = model(vec![face(surface.clone(), vec![trim])]);
        let plate = model(vec![whole(plane([0.0; 3], X, Y, [[0.0, 4.0]; 2]))]);
        check(&point, &plate, [3.0, (3.0_f64.powi(2) + 2.0_f64.powi(2) + 9.0).sqrt()], 1e-9);
    }
}

fn whole(surface: SurfaceArrays) -> FaceArrays {
    FaceArrays { trim: None, ..face(surface, vec![]) }
}

fn measure(a: &Model, b: &Model, options: &DistanceOptions) -> DistanceResult {
    let (a, b) = (PreparedModel::new(a).unwrap(), PreparedModel::new(b).unwrap());
    let engine = Engine::cpu();
    let options = DistanceOptions { symmetric: true, backend: Backend::Cpu, ..options.clone() };
    engine.distance(&a, &b, &options).wait().unwrap()
}

/// Checks that the certified intervals of both directions contain these distances, known
/// to `accuracy`, that they are narrow, and that the witnesses are points of their faces.
fn check(a: &Model, b: &Model, expected: [f64; 2], accuracy: f64) {
    let result = measure(a, b, &DistanceOptions::default());
    let directions = [result.forward.as_deref().unwrap(), result.reverse.as_deref().unwrap()];
    for (directed, expected) in directions.into_iter().zip(expected) {
        let interval = [directed.lower, directed.upper];
        assert!(directed.converged, "{interval:?}, expected {expected}");
        assert!(directed.upper - directed.lower <= 1e-6 * directed.diagonal, "{interval:?}");
        assert!(
            directed.lower <= expected + accuracy && expected - accuracy <= directed.upper,
            "{interval:?}, expected {expected}"
        );
        for (model, point) in [(a, &directed.witness.a), (b, &directed.witness.b)] {
            let at = evaluator::point(&model.surfaces()[point.face], point.u, point.v);
            let apart = evaluator::distance(at, point.point);
            assert!(apart <= 1e-8 * directed.diagonal, "{point:?} is {apart} from {at:?}");
            assert_eq!(point.face_name.as_deref(), Some(format!("face {}", point.face).as_str()));
            if let Some(trim) = model.faces().nth(point.face).unwrap().trim() {
                assert_ne!(trim.winding().number([point.u, point.v]), Some(2));
            }
        }
    }
}

/// A plate 100 x 60 x 20 about the origin with a bore of this radius along z.
fn plate(radius: f64) -> Model {
    let (long, wide, high) = ([-50.0, 50.0], [-30.0, 30.0], [-10.0, 10.0]);
    let bored = || vec![rectangle([-50.0, -30.0], [50.0, 30.0]), reversed(circle([0.0, 0.0], radius))];
    model(vec![
        face(plane([0.0, 0.0, 10.0], X, Y, [long, wide]), bored()),
        face(plane([0.0, 0.0, -10.0], X, Y, [long, wide]), bored()),
        whole(plane([50.0, 0.0, 0.0], Y, Z, [wide, high])),
        whole(plane([-50.0, 0.0, 0.0], Y, Z, [wide, high])),
        whole(plane([0.0, 30.0, 0.0], X, Z, [long, high])),
        whole(plane([0.0, -30.0, 0.0], X, Z, [long, high])),
        whole(cylinder([0.0; 3], [X, Y, Z], radius, high, 4)),
    ])
}

#[test]
fn plates_with_bores_of_different_radius_differ_by_the_difference() {
    check(&plate(10.0), &plate(10.5), [0.5, 0.5], 1e-12);
}

#[test]
fn the_other_methods_bound_the_distance_of_the_plates_too() {
    for method in [MethodName::Iteration, MethodName::Hierarchy] {
        let options = DistanceOptions {
            method: with_grid(method, 16),
            samples: 24,
            deviations: true,
            ..DistanceOptions::default()
        };
        let result = measure(&plate(10.0), &plate(10.5), &options);
        for directed in [result.forward.as_deref().unwrap(), result.reverse.as_deref().unwrap()] {
            let interval = [directed.lower, directed.upper];
            assert!(directed.lower <= 0.5 && 0.5 <= directed.upper, "{method:?} {interval:?}");
            assert!(directed.upper < 0.25 * directed.diagonal, "{method:?} {interval:?}");
        }
        // Statistics are those of the trimmed area: two faces less the bore, four sides, the bore.
        for (directed, radius) in [(&result.forward, 10.0), (&result.reverse, 10.5)] {
            let directed = directed.as_deref().unwrap();
            let area = 2.0 * (6000.0 - PI * radius * radius) + 40.0 * 160.0 + 20.0 * TAU * radius;
            let found = directed.statistics.unwrap().area;
            assert!((found - area).abs() < 5e-3 * area, "{method:?} {found}, expected {area}");
            assert!(directed.deviations.iter().all(|field| field.face < 7));
        }
    }
}

/// A cylinder of radius 20 and height 100 about z, closed, with or without a cross bore
/// of radius 5 along x.
fn bored_cylinder(bore: bool) -> Model {
    let side = cylinder([0.0; 3], [X, Y, Z], 20.0, [-50.0, 50.0], 4);
    let lid = |z: f64| face(plane([0.0, 0.0, z], X, Y, [[-21.0, 21.0]; 2]), vec![circle([0.0, 0.0], 20.0)]);
    if !bore {
        return model(vec![whole(side), lid(50.0), lid(-50.0)]);
    }
    // The circle y = 5 cos t, z = 5 sin t of the bore, on the side about angle 90° ± 90°; the
    // side is turned so that the holes are away from its seam.
    let turned = cylinder([0.0; 3], [Y, [-1.0, 0.0, 0.0], Z], 20.0, [-50.0, 50.0], 4);
    // Angle a of the turned side has x = -20 sin a, y = 20 cos a.
    let hole = |middle: f64| {
        fitted(96, move |t: f64| {
            let (y, z) = (5.0 * (TAU * t).cos(), 5.0 * (TAU * t).sin());
            let off = (y / 20.0).asin();
            let angle = if middle < PI { middle - off } else { middle + off };
            [quarter_parameter(angle), z]
        })
    };
    let directed = |curve: TrimCurveArrays, clockwise: bool| {
        // At 90° the angle falls as y rises, so that the hole turns clockwise already.
        if clockwise { vec![curve] } else { reversed(vec![curve]) }
    };
    let holes = [directed(hole(FRAC_PI_2), true), directed(hole(3.0 * FRAC_PI_2), false)];
    let [first, second] = holes;
    let outer = rectangle([0.0, -50.0], [4.0, 50.0]);
    // The bore's wall at angle a has y = 5 cos a, z = 5 sin a, and ends at x = ±√(400 - y²).
    let wall = cylinder([0.0; 3], [Y, Z, X], 5.0, [-21.0, 21.0], 4);
    let end = |sign: f64, backwards: bool| {
        fitted(96, move |t: f64| {
            let t = if backwards { 1.0 - t } else { t };
            let angle = (TAU * t).rem_euclid(TAU);
            let whole_turns = (t - angle / TAU).round() * 4.0;
            let y = 5.0 * angle.cos();
            [quarter_parameter(angle) + whole_turns, sign * (400.0 - y * y).sqrt()]
        })
    };
    let (start, stop) = (-(375.0_f64).sqrt(), 375.0_f64.sqrt());
    let around = vec![
        end(-1.0, false),
        line([4.0, start], [4.0, stop]),
        end(1.0, true),
        line([0.0, stop], [0.0, start]),
    ];
    model(vec![face(turned, vec![outer, first, second]), lid(50.0), lid(-50.0), face(wall, vec![around])])
}

#[test]
fn a_cross_bore_is_its_radius_from_the_cylinder_and_the_cylinder_s_radius_back() {
    // Cubic Hermite interpolation in 96 parts: (2π / 96)⁴ / 384 times the fourth derivative,
    // at most about 5 in angle and height and 20 in the wall's ends.
    check(&bored_cylinder(false), &bored_cylinder(true), [5.0, 20.0], 1e-6);
}

/// The ball of radius 10, cut at the height 6 along z if `cut`, with its axis tilted.
fn cut_ball(cut: bool, tilt: f64) -> Model {
    let (sin, cos) = tilt.sin_cos();
    let axes = [[cos, 0.0, -sin], Y, [sin, 0.0, cos]];
    if !cut {
        return model(vec![whole(ball(10.0, axes))]);
    }
    // The point at longitude l and angle p from the south pole has
    // z = 10 (-sin p cos l sin tilt - cos p cos tilt): 6 at one p for each l, as the pole is cut off.
    let edge = fitted(128, move |t: f64| {
        let angle = (TAU * t).rem_euclid(TAU);
        let longitude = quarter_parameter(angle) + ((t - angle / TAU).round() * 4.0);
        let height = |p: f64| -p.sin() * angle.cos() * sin - p.cos() * cos - 0.6;
        let (mut low, mut high) = (FRAC_PI_2, PI);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if height(middle) < 0.0 { low = middle } else { high = middle }
        }
        [longitude, quarter_parameter(low)]
    });
    let seam = edge.control_points[0][1];
    let edge = if tilt == 0.0 { line([4.0, seam], [0.0, seam]) } else { reversed(vec![edge]).remove(0) };
    let around = vec![
        line([0.0, 0.0], [4.0, 0.0]),
        line([4.0, 0.0], [4.0, seam]),
        edge,
        line([0.0, seam], [0.0, 0.0]),
    ];
    let disc = face(plane([0.0, 0.0, 6.0], X, Y, [[-9.0, 9.0]; 2]), vec![circle([0.0, 0.0], 8.0)]);
    model(vec![face(ball(10.0, axes), vec![around]), disc])
}

#[test]
fn a_ball_cut_along_a_parallel_is_its_cap_s_height_from_the_ball() {
    check(&cut_ball(false, 0.0), &cut_ball(true, 0.0), [4.0, 4.0], 1e-9);
}

#[test]
fn a_loop_around_a_tilted_pole_cuts_off_the_same_cap() {
    check(&cut_ball(false, 0.3), &cut_ball(true, 0.3), [4.0, 4.0], 1e-6);
}

/// A box edge along y with a fillet of this radius, and an end face with its arc.
fn fillet(radius: f64) -> Model {
    let length = [0.0, 30.0];
    // The corner is the origin, the faces are z = 0 and x = 0, the axis is (r, r) from it.
    let round = cylinder([radius, 0.0, radius], [[-1.0, 0.0, 0.0], [0.0, 0.0, -1.0], Y], radius, length, 1);
    let mut end = polygon(&[[radius, 0.0], [40.0, 0.0], [40.0, 40.0], [0.0, 40.0], [0.0, radius]]);
    end[4] = TrimCurveArrays {
        degree: 2,
        knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
        control_points: vec![[0.0, radius, 1.0], [0.0, 0.0, 0.5 * SQRT_2], [radius, 0.0, 1.0]],
        ..TrimCurveArrays::default()
    };
    model(vec![
        whole(plane([0.0; 3], X, Y, [[radius, 40.0], length])),
        whole(plane([0.0; 3], Z, Y, [[radius, 40.0], length])),
        whole(round),
        face(plane([0.0; 3], X, Z, [[0.0, 40.0]; 2]), vec![end]),
    ])
}

#[test]
fn fillets_of_different_radius_differ_along_the_diagonal() {
    let expected = 0.2 * (SQRT_2 - 1.0);
    check(&fillet(5.0), &fillet(5.2), [expected, expected], 1e-12);
}

#[test]
fn an_island_in_a_hole_is_half_the_ring_s_width_from_it() {
    let square = plane([0.0; 3], X, Y, [[0.0, 8.0]; 2]);
    let center = [4.0, 4.0];
    let loops = vec![rectangle([0.0; 2], [8.0; 2]), reversed(circle(center, 3.0)), circle(center, 1.0)];
    check(&model(vec![face(square.clone(), loops)]), &model(vec![whole(square)]), [0.0, 1.0], 1e-12);
}

#[test]
fn a_hole_over_the_seam_is_the_hole_elsewhere_on_the_turned_surface() {
    let turned = [[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], Z];
    let side = |axes| cylinder([0.0; 3], axes, 3.0, [0.0, 10.0], 4);
    let hole = ellipse([2.0, 5.0], [0.75, 2.0]);
    let inside = face(side([X, Y, Z]), vec![rectangle([0.0, 0.0], [4.0, 10.0]), reversed(hole.clone())]);
    // The same ellipse about u = 0 and u = 4: its right half on the left, its left half on the right.
    let half = |first: usize, center: f64| TrimCurveArrays {
        degree: 2,
        knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0],
        control_points: (first..first + 5)
            .map(|k| {
                let [u, v, w] = hole[0].control_points[k % 8];
                [u - 2.0 + center, v, w]
            })
            .collect(),
        ..TrimCurveArrays::default()
    };
    // From the ellipse's lowest point over its right to its highest, and back over its left.
    let (right, left) = (half(6, 0.0), half(2, 4.0));
    let [right, left] = [right, left].map(|curve| reversed(vec![curve]).remove(0));
    let around = vec![
        line([0.0, 0.0], [4.0, 0.0]),
        line([4.0, 0.0], [4.0, 3.0]),
        left,
        line([4.0, 7.0], [4.0, 10.0]),
        line([4.0, 10.0], [0.0, 10.0]),
        line([0.0, 10.0], [0.0, 7.0]),
        right,
        line([0.0, 3.0], [0.0, 0.0]),
    ];
    let over = face(side(turned), vec![around]);
    check(&model(vec![inside]), &model(vec![over]), [0.0, 0.0], 1e-9);
}

#[test]
fn a_bicubic_face_cut_along_cubics_is_the_face() {
    let height = |i: usize, j: usize| {
        let (i, j) = (i as f64, j as f64);
        (1.3 * i + 0.4 * j).sin() + 0.5 * (0.9 * j - 0.2 * i).cos()
    };
    let sheet = SurfaceArrays {
        degree: [3, 3],
        knots: [
            vec![0.0, 0.0, 0.0, 0.0, 0.4, 1.0, 1.0, 1.0, 1.0],
            vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0],
        ],
        counts: [5, 4],
        control_points: (0..20)
            .map(|k| [(k / 4) as f64, (k % 4) as f64, height(k / 4, k % 4), 1.0])
            .collect(),
    };
    // A cubic from the lower to the upper edge of the domain parts the face in two.
    let wall = TrimCurveArrays {
        degree: 3,
        knots: vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0],
        control_points: vec![[0.5, 0.0, 1.0], [0.8, 0.3, 1.0], [0.1, 0.6, 1.0], [0.6, 1.0, 1.0]],
        ..TrimCurveArrays::default()
    };
    let back = reversed(vec![wall.clone()]).remove(0);
    let left =
        vec![line([0.0, 0.0], [0.5, 0.0]), wall, line([0.6, 1.0], [0.0, 1.0]), line([0.0, 1.0], [0.0, 0.0])];
    let right =
        vec![line([0.5, 0.0], [1.0, 0.0]), line([1.0, 0.0], [1.0, 1.0]), line([1.0, 1.0], [0.6, 1.0]), back];
    let parts = model(vec![face(sheet.clone(), vec![left]), face(sheet.clone(), vec![right])]);
    check(&parts, &model(vec![whole(sheet)]), [0.0, 0.0], 1e-9);
}

#[test]
fn the_gap_stands_beside_the_interval() {
    let square = || face(plane([0.0; 3], X, Y, [[0.0, 8.0]; 2]), vec![circle([4.0, 4.0], 3.0)]);
    let mut stated = square();
    stated.gap = 1e-3;
    stated.trim.as_mut().unwrap()[0][0].gap = 2e-3;
    let result = measure(&model(vec![stated.clone()]), &model(vec![square()]), &DistanceOptions::default());
    assert!((result.gap - 3e-3).abs() < 1e-15);
    assert!(result.upper < 1e-5);
    let both = measure(&model(vec![stated.clone()]), &model(vec![stated]), &DistanceOptions::default());
    assert!((both.gap - 6e-3).abs() < 1e-15);
}

#[test]
fn a_tolerance_below_the_deviation_stops_with_the_least_one_possible() {
    let (a, b) = (plate(10.0), plate(10.5));
    let options = DistanceOptions { relative_tolerance: Some(1e-14), ..DistanceOptions::default() };
    let result = measure(&a, &b, &options);
    let details = result.certified().unwrap();
    assert!(!result.converged && details.min_tolerance > 1e-14 * result.diagonal);
    assert!(result.lower <= 0.5 && 0.5 <= result.upper, "[{}, {}]", result.lower, result.upper);
    let options =
        DistanceOptions { tolerance: Some(2.0 * details.min_tolerance), ..DistanceOptions::default() };
    assert!(measure(&a, &b, &options).converged);
}

#[test]
fn models_of_different_unit_are_scaled_only_on_request() {
    let square = |size: f64, unit: Option<f64>| {
        let loops = vec![circle([0.5 * size, 0.5 * size], 0.25 * size)];
        let surface = plane([0.0; 3], X, Y, [[0.0, size]; 2]);
        let faces = vec![face(surface, loops)];
        Model::from_faces(ModelArrays { unit, faces, ..ModelArrays::default() }).unwrap()
    };
    let prepared = |size, unit| PreparedModel::new(&square(size, unit)).unwrap();
    let engine = Engine::cpu();
    let measure = |a: &PreparedModel, b: &PreparedModel, scale_units| {
        let options = DistanceOptions { scale_units, backend: Backend::Cpu, ..DistanceOptions::default() };
        engine.distance(a, b, &options).wait()
    };
    let (inches, millimetres) = (prepared(1.0, Some(0.0254)), prepared(25.4, Some(0.001)));
    let error = measure(&inches, &millimetres, false).unwrap_err();
    assert_eq!(error.code(), "UNITS_DIFFER", "{error}");
    let result = measure(&inches, &millimetres, true).unwrap();
    assert!(result.upper < 1e-5 && result.unit == Some(0.0254), "{result:?}");
    assert!(result.diagonal < 2.0, "the result is in A's unit");
    // Without a unit on one side they are compared as they are.
    let plain = prepared(25.4, None);
    let result = measure(&plain, &millimetres, false).unwrap();
    assert!(result.upper < 1e-4 && result.unit == Some(0.001), "{result:?}");
    // The half diagonal between two circles' nearest points is far more than 1.
    assert!(measure(&inches, &plain, false).unwrap().lower > 1.0);
}

#[test]
fn closest_points_and_faces_are_those_of_the_trimmed_model() {
    let square = plane([0.0; 3], X, Y, [[0.0, 8.0]; 2]);
    let ring = model(vec![
        whole(plane([0.0, 0.0, -5.0], X, Y, [[0.0, 8.0]; 2])),
        face(square, vec![circle([4.0, 4.0], 3.0), reversed(circle([4.0, 4.0], 1.0))]),
    ]);
    let prepared = PreparedModel::new(&ring).unwrap();
    let engine = Engine::cpu();
    // Above the hole's middle, above material, outside.
    let points = [4.0, 4.0, 0.0, 4.0, 6.0, 1.0, 4.0, 9.0, 0.0];
    let found = engine.closest_points(&prepared, &points, &Default::default()).wait();
    let found = found.unwrap();
    for ((distance, bound), expected) in found.distances.iter().zip(&found.bounds).zip([1.0, 1.0, 2.0]) {
        assert!((distance - expected).abs() <= *bound && *bound < 1e-6, "{distance} {bound}");
    }
    assert_eq!(found.faces, [1, 1, 1]);
    for (parameters, foot) in found.parameters.chunks(2).zip(found.feet.chunks(3)) {
        // u and v are x and y of this face.
        let foot = DVec3::from_slice(foot);
        assert!(foot.distance(DVec3::new(parameters[0], parameters[1], 0.0)) < 1e-7);
    }
    let options = nurbs_hausdorff::DiffOptions::default();
    let diff = engine.diff(&prepared, &prepared, &options).wait().unwrap();
    assert_eq!((diff.faces_of_a.len(), diff.faces_of_b.len()), (2, 2));
}

#[test]
fn display_triangles_cover_the_trimmed_area() {
    let model = plate(10.0);
    let triangles =
        tessellate(&model, &TessellationOptions { tolerance: Some(1e-3), ..Default::default() }).unwrap();
    assert_eq!(triangles.faces.len(), 7);
    let top = triangles.indices[triangles.faces[0].clone()].chunks(3).map(|corners| {
        let [a, b, c] = [0, 1, 2].map(|k| {
            let first = 3 * corners[k] as usize;
            let position = &triangles.positions[first..first + 3];
            DVec3::new(position[0].into(), position[1].into(), position[2].into())
        });
        0.5 * (b - a).cross(c - a).length()
    });
    let area: f64 = top.sum();
    let expected = 6000.0 - 100.0 * PI;
    assert!((area - expected).abs() < 1e-3 * TAU * 10.0 + 1.0, "{area}, expected {expected}");
}
