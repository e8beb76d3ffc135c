//! Trimming loops are validated once: what they enclose, what they are closed by, and
//! what is refused, by a stable code and a text that names surface, loop and curve.

use crate::support::trims::{circle, ellipse, face, line, plane, polygon, rectangle, reversed};
use nurbs_hausdorff::model::trim::{FaceArrays, Trim, TrimCurveArrays, oriented};
use nurbs_hausdorff::model::{IDENTITY, InstanceArrays, ModelArrays};
use nurbs_hausdorff::{Error, Model, NurbsSurface, SurfaceArrays};
use proptest::prelude::*;

/// The plane z = 0 with u = x and v = y over [0, 4]².
fn sheet() -> SurfaceArrays {
    plane([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [[0.0, 4.0]; 2])
}

fn surface() -> NurbsSurface {
    NurbsSurface::new(0, sheet()).unwrap()
}

fn trim(loops: Vec<Vec<TrimCurveArrays>>) -> Result<Trim, Error> {
    Trim::new(3, &surface(), loops)
}

/// Checks that the loops are refused by this code, with every one of `words` in the text.
fn refused(code: &str, words: &[&str], loops: Vec<Vec<TrimCurveArrays>>) {
    let error = trim(loops).unwrap_err();
    assert_eq!(error.code(), code, "{error}");
    let text = error.to_string();
    for word in ["surface 3"].iter().chain(words) {
        assert!(text.contains(word), "\"{text}\" does not contain \"{word}\"");
    }
}

#[test]
fn three_nested_loops_are_material_hole_and_island() {
    let loops = vec![circle([2.0, 2.0], 1.8), reversed(circle([2.0, 2.0], 1.2)), circle([2.0, 2.0], 0.6)];
    let trim = trim(loops).unwrap();
    let winding = trim.winding();
    for (radius, expected) in [(0.3, 1), (0.9, 0), (1.5, 1), (1.9, 0)] {
        for step in 0..100 {
            let angle = 0.0628 * f64::from(step);
            let at = [2.0 + radius * angle.cos(), 2.0 + radius * angle.sin()];
            assert_eq!(winding.number(at), Some(expected), "{radius} {angle}");
        }
    }
    assert_eq!(trim.gap(), 0.0);
}

#[test]
fn points_next_to_a_circle_are_decided_to_ten_digits_and_points_on_it_are_not() {
    let trim = trim(vec![circle([2.0, 2.0], 1.0)]).unwrap();
    let winding = trim.winding();
    for step in 0..500 {
        let angle = 0.01257 * f64::from(step);
        let at = |radius: f64| [2.0 + radius * angle.cos(), 2.0 + radius * angle.sin()];
        assert_eq!(winding.number(at(1.0 - 1e-10)), Some(1));
        assert_eq!(winding.number(at(1.0 + 1e-10)), Some(0));
    }
    assert_eq!(winding.number([3.0, 2.0]), None);
}

#[test]
fn ends_that_miss_each_other_are_joined_and_the_gap_is_that_of_the_move() {
    let mut curves = rectangle([1.0, 1.0], [3.0, 2.0]);
    curves[1].control_points[0][1] += 1e-7;
    let trim = trim(vec![curves]).unwrap();
    let pieces = &trim.loops()[0];
    for (index, piece) in pieces.iter().enumerate() {
        assert_eq!(piece.end(), pieces[(index + 1) % pieces.len()].start());
    }
    // |S_u| = |S_v| = 1, and the bound exceeds them by rounding only.
    assert!((1e-7 - 1e-16..1.01e-7).contains(&trim.gap()), "{}", trim.gap());
    // The parameter lines stay parameter lines.
    assert!(pieces.iter().all(|piece| {
        let (start, end) = (piece.start(), piece.end());
        start.x == end.x || start.y == end.y
    }));
}

#[test]
fn the_gap_is_that_of_the_worst_curve() {
    let mut curves = rectangle([1.0, 1.0], [3.0, 2.0]);
    curves[2].gap = 3e-4;
    assert_eq!(trim(vec![curves.clone()]).unwrap().gap(), 3e-4);
    // A stated gap also closes ends that miss each other by less than it.
    curves[2].control_points[0][1] += 2e-4;
    let gap = trim(vec![curves.clone()]).unwrap().gap();
    assert!((5e-4 - 1e-12..5.1e-4).contains(&gap), "{gap}");
    curves[2].gap = 1e-4;
    refused("TRIM_LOOP_OPEN", &["loop 0", "curve 2"], vec![curves]);
}

#[test]
fn a_curve_at_the_edge_of_the_domain_is_moved_onto_it() {
    let mut curves = rectangle([0.0, 0.0], [4.0, 4.0]);
    for curve in &mut curves {
        for point in &mut curve.control_points {
            point[0] += 1e-10;
        }
    }
    let trim = trim(vec![curves]).unwrap();
    assert!(trim.loops()[0].iter().all(|piece| [0.0, 4.0].contains(&piece.start().x)));
    assert!((1e-10 - 1e-15..1.1e-10).contains(&trim.gap()), "{}", trim.gap());
}

#[test]
fn invalid_curves_are_refused() {
    let spoiled = |spoil: &dyn Fn(&mut TrimCurveArrays)| {
        let mut curves = rectangle([1.0, 1.0], [2.0, 2.0]);
        spoil(&mut curves[2]);
        vec![rectangle([0.0, 0.0], [4.0, 4.0]), reversed(curves)]
    };
    // Reversing moved curve 2 to place 1.
    let place = ["loop 1", "curve 1"];
    let invalid = |words: &[&str], spoil: &dyn Fn(&mut TrimCurveArrays)| {
        let words: Vec<&str> = place.iter().chain(words).copied().collect();
        refused("TRIM_CURVE_INVALID", &words, spoiled(spoil));
    };
    invalid(&["degree 0, expected 1 to 15"], &|curve| curve.degree = 0);
    invalid(&["degree 16"], &|curve| curve.degree = 16);
    invalid(&["3 knots, expected 4"], &|curve| curve.knots.truncate(3));
    invalid(&["knot"], &|curve| curve.knots[1] = f64::NAN);
    invalid(&["2 control points, expected at least 3"], &|curve| curve.degree = 2);
    invalid(&["control point 0 has inf"], &|curve| curve.control_points[1][1] = f64::INFINITY);
    invalid(&["gap is -1.0, expected"], &|curve| curve.gap = -1.0);
    let weight = "TRIM_WEIGHT_NOT_POSITIVE";
    refused(
        weight,
        &["loop 1, curve 1: weight of control point 1 is 0.0"],
        spoiled(&|curve| {
            curve.control_points[0][2] = 0.0;
        }),
    );
    refused(weight, &["is -1.0"], spoiled(&|curve| curve.control_points[0][2] = -1.0));
    refused("TRIM_NO_LOOPS", &["0 trimming loops"], vec![]);
    refused("TRIM_LOOP_NO_AREA", &["loop 0"], vec![vec![]]);
}

#[test]
fn open_loops_and_curves_outside_are_refused() {
    let mut open = rectangle([1.0, 1.0], [2.0, 2.0]);
    open.pop();
    refused("TRIM_LOOP_OPEN", &["loop 0, curve 0", "2.5e-1", "expected at most 1e-6"], vec![open]);
    let outside = vec![circle([3.0, 2.0], 1.0 + 1e-4)];
    refused("TRIM_OUTSIDE_DOMAIN", &["loop 0, curve 0"], outside);
    // Control points may lie outside, here by 0.4 of the range, if the curve does not.
    let mut curves = rectangle([1.0, 1.0], [3.0, 3.0]);
    curves[1] = TrimCurveArrays {
        degree: 2,
        knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
        control_points: vec![[3.0, 1.0, 1.0], [5.0 - 1e-9, 2.0, 1.0], [3.0, 3.0, 1.0]],
        ..TrimCurveArrays::default()
    };
    let trim = trim(vec![curves]).unwrap();
    assert!(trim.gap() < 4e-9, "{}", trim.gap());
    assert!(trim.loops()[0].iter().flat_map(|piece| piece.points()).all(|point| point.x <= 4.0));
}

#[test]
fn loops_without_area_crossing_loops_and_wrong_nesting_are_refused() {
    let back = vec![line([1.0, 1.0], [2.0, 2.0]), line([2.0, 2.0], [1.0, 1.0])];
    refused("TRIM_LOOP_NO_AREA", &["loop 0"], vec![back]);
    let eight = polygon(&[[1.0, 1.0], [3.0, 2.5], [3.0, 1.0], [1.0, 2.0]]);
    refused("TRIM_LOOPS_CROSS", &["loop 0", "winding number there is -1"], vec![eight]);
    let lens = vec![circle([1.5, 2.0], 1.0), circle([2.5, 2.0], 1.0)];
    refused("TRIM_LOOPS_CROSS", &["loop 1", "winding number there is 2"], lens);
    let hole = vec![circle([1.5, 2.0], 1.0), reversed(circle([2.5, 2.0], 1.0))];
    refused("TRIM_LOOPS_CROSS", &["winding number there is -1"], hole);
    let clockwise = vec![reversed(circle([2.0, 2.0], 1.0))];
    refused("TRIM_WRONG_NESTING", &["loop 0", "is -1, expected 0 or 1: clockwise"], clockwise);
    let twice = vec![circle([2.0, 2.0], 1.0), circle([2.0, 2.0], 0.5)];
    refused("TRIM_WRONG_NESTING", &["loop 1", "is 2, expected 0 or 1: counterclockwise"], twice);
    let beside = vec![circle([1.0, 1.0], 0.5), reversed(circle([3.0, 3.0], 0.5))];
    refused("TRIM_WRONG_NESTING", &["loop 1"], beside);
}

/// The radius of the outer circle of [`poked`].
const OUTER: f64 = 1.5;

/// A disc with a round hole that comes out of its edge by `depth`, in the direction of `angle`,
/// and with arcs that begin anywhere.
fn poked(inner: f64, depth: f64, angle: f64) -> Vec<Vec<TrimCurveArrays>> {
    let offset = OUTER - inner + depth;
    let hole = circle([2.0 + offset * f64::cos(angle), 2.0 + offset * f64::sin(angle)], inner);
    vec![circle([2.0, 2.0], OUTER), reversed(hole)]
}

/// The angle of such a crossing is about the square root of the depth, so that chords of the
/// curves need not cross.
#[test]
fn a_hole_that_comes_out_of_the_outer_loop_is_refused_however_little() {
    let random = &mut fastrand::Rng::with_seed(3);
    // The domain is 4 wide, so that overlaps up to 4e-6 are accepted.
    for depth in [1e-1, 1e-2, 1e-3, 1e-4, 2e-5] {
        for _ in 0..20 {
            let (inner, angle) = (OUTER * (0.1 + 0.8 * random.f64()), 6.3 * random.f64());
            let error = trim(poked(inner, depth, angle)).unwrap_err();
            assert_eq!(error.code(), "TRIM_LOOPS_CROSS", "{inner} {depth} {angle}: {error}");
            assert!(error.to_string().contains("surface 3, loop"), "{error}");
        }
    }
    for depth in [1e-6, 1e-7, 0.0, -1e-9] {
        for _ in 0..20 {
            let (inner, angle) = (OUTER * (0.1 + 0.8 * random.f64()), 6.3 * random.f64());
            assert!(trim(poked(inner, depth, angle)).is_ok(), "{inner} {depth} {angle}");
        }
    }
}

#[test]
fn loops_may_touch_each_other_themselves_and_the_edge() {
    let touching = vec![circle([2.0, 2.0], 1.5), reversed(circle([2.5, 2.0], 1.0))];
    assert_eq!(trim(touching).unwrap().winding().number([0.6, 2.0]), Some(1));
    let at_corner = polygon(&[[1.0, 1.0], [2.0, 2.0], [3.0, 1.0], [3.0, 3.0], [2.0, 2.0], [1.0, 3.0]]);
    assert_eq!(trim(vec![at_corner]).unwrap().winding().number([1.2, 2.0]), Some(1));
    assert!(trim(vec![circle([2.0, 2.0], 2.0)]).is_ok());
    // A slit, which the loop follows there and back.
    let slit = [[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [2.0, 3.0], [2.0, 2.0], [2.0, 3.0], [1.0, 3.0]];
    assert!(trim(vec![polygon(&slit)]).is_ok());
}

#[test]
fn loops_of_unknown_direction_are_directed_by_their_nesting() {
    let rings = [1.9, 1.5, 1.0, 0.5].map(|radius| circle([2.0, 2.0], radius));
    let expected: Vec<_> = rings
        .iter()
        .enumerate()
        .map(|(k, ring)| if k % 2 == 0 { ring.clone() } else { reversed(ring.clone()) })
        .collect();
    for mask in 0..16 {
        let given = rings
            .iter()
            .enumerate()
            .map(|(k, ring)| if mask >> k & 1 == 1 { reversed(ring.clone()) } else { ring.clone() });
        let directed = oriented(&surface(), given.collect()).unwrap();
        assert_eq!(directed, expected);
        assert!(trim(directed).is_ok());
    }
}

/// A surface of degree 2 x 3 over [1, 3] x [0, 2] with z = (u - 2)² + v³, in two spans of u.
fn cubic_sheet() -> SurfaceArrays {
    // Blossoms: u² at (a, b) is a b, v³ at (a, b, c) is a b c.
    let u_pairs = [[1.0, 1.0], [1.0, 2.5], [2.5, 3.0], [3.0, 3.0]];
    let v_triples = [[0.0, 0.0, 0.0], [0.0, 0.0, 2.0], [0.0, 2.0, 2.0], [2.0, 2.0, 2.0]];
    let point = |k: usize| {
        let ([a, b], [c, d, e]) = (u_pairs[k / 4], v_triples[k % 4]);
        [0.5 * (a + b), (c + d + e) / 3.0, a * b - 2.0 * (a + b) + 4.0 + c * d * e, 1.0]
    };
    SurfaceArrays {
        degree: [2, 3],
        knots: [vec![1.0, 1.0, 1.0, 2.5, 3.0, 3.0, 3.0], vec![0.0, 0.0, 0.0, 0.0, 2.0, 2.0, 2.0, 2.0]],
        counts: [4, 4],
        control_points: (0..16).map(point).collect(),
    }
}

#[test]
fn a_surface_is_continued_to_curves_two_percent_beyond_it() {
    // The ellipse reaches u = 3.04 and v = -0.04.
    let outer = ellipse([2.5, 0.96], [0.54, 1.0]);
    let arrays = ModelArrays { faces: vec![face(cubic_sheet(), vec![outer])], ..ModelArrays::default() };
    let model = Model::from_faces(arrays).unwrap();
    let surface = &model.surfaces()[0];
    let ([u0, v0], [u1, v1]) = (surface.domain().low(), surface.domain().high());
    assert!(u0 == 1.0 && v1 == 2.0);
    assert!((3.04..3.04 + 1e-8).contains(&u1) && (-0.04 - 1e-8..=-0.04).contains(&v0), "{u1} {v0}");
    for i in 0..=20 {
        for j in 0..=20 {
            let (u, v) = (u0 + (u1 - u0) * f64::from(i) / 20.0, v0 + (v1 - v0) * f64::from(j) / 20.0);
            let [x, y, z] = crate::support::evaluator::point(surface, u, v);
            let expected = (u - 2.0) * (u - 2.0) + v * v * v;
            assert!((x - u).abs() + (y - v).abs() + (z - expected).abs() < 1e-13, "{u} {v}: {x} {y} {z}");
        }
    }
    // Beyond 5 % it is refused.
    let far = vec![face(cubic_sheet(), vec![ellipse([2.6, 0.96], [0.54, 0.5])])];
    let error = Model::from_faces(ModelArrays { faces: far, ..ModelArrays::default() }).unwrap_err();
    assert_eq!(error.code(), "TRIM_OUTSIDE_DOMAIN", "{error}");
    assert!(error.to_string().contains("expected at most 5e-2"), "{error}");
}

/// A model of two trimmed faces, placed twice.
fn assembly() -> ModelArrays {
    let mut named = face(sheet(), vec![rectangle([0.0, 0.0], [4.0, 4.0]), reversed(circle([2.0, 2.0], 1.0))]);
    named.part = Some("plate".to_owned());
    named.trim.as_mut().unwrap()[1][0].gap = 1e-5;
    named.trim.as_mut().unwrap()[1][0].edge = Some(17);
    named.kind = Some("plane".to_owned());
    named.gap = 1e-6;
    let mut transform = IDENTITY;
    transform[3] = 10.0;
    let instance = |surfaces: Vec<usize>, transform| InstanceArrays {
        surfaces,
        transform,
        name: Some("bolt:2".to_owned()),
    };
    ModelArrays {
        name: Some("assembly".to_owned()),
        unit: Some(0.001),
        faces: vec![named, FaceArrays { trim: None, reversed: true, ..face(sheet(), vec![]) }],
        instances: vec![instance(vec![0, 1], IDENTITY), instance(vec![0], transform)],
    }
}

#[test]
fn instances_place_faces_by_any_affine_map() {
    let model = Model::from_faces(assembly()).unwrap();
    assert_eq!((model.surfaces().len(), model.unit()), (3, Some(0.001)));
    let parts: Vec<_> = model.faces().map(|face| face.part()).collect();
    assert_eq!(parts, [Some("bolt:2 / plate"), Some("bolt:2"), Some("bolt:2 / plate")]);
    assert_eq!(model.surfaces()[2].control_points()[0], [10.0, 0.0, 0.0, 1.0]);
    assert!((model.gap() - 1.1e-5).abs() < 1e-12, "{}", model.gap());

    let mut sheared = assembly();
    // x doubled and sheared by y: the lengthening is that of the matrix [[2, 1], [0, 1]].
    sheared.instances[1].transform = [2.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0];
    let model = Model::from_faces(sheared).unwrap();
    assert_eq!(model.surfaces()[2].control_points()[3], [12.0, 4.0, 0.0, 1.0]);
    let exact = (3.0 + 5.0_f64.sqrt()).sqrt();
    let factor = model.faces().last().unwrap().gap() / 1.1e-5;
    assert!((exact..1.1 * exact).contains(&factor), "{factor}, expected {exact}");
    assert!(model.faces().last().unwrap().is_reversed());

    for (index, value) in [(0, f64::NAN), (0, 0.0), (3, 1e200)] {
        let mut arrays = assembly();
        arrays.instances[1].transform[index] = value;
        let error = Model::from_faces(arrays).unwrap_err();
        assert_eq!(error.code(), "INSTANCE_TRANSFORM", "{error}");
        assert!(error.to_string().contains("instance 1"), "{error}");
    }
    let mut arrays = assembly();
    arrays.instances[0].surfaces[1] = 2;
    assert_eq!(Model::from_faces(arrays).unwrap_err().code(), "INSTANCE_SURFACE");
    let mut arrays = assembly();
    arrays.unit = Some(-1.0);
    assert_eq!(Model::from_faces(arrays).unwrap_err().code(), "UNIT_INVALID");
    let mut arrays = assembly();
    arrays.faces[1].gap = f64::INFINITY;
    assert_eq!(Model::from_faces(arrays).unwrap_err().code(), "GAP_INVALID");
}

#[test]
fn interchange_json_keeps_trims_names_unit_and_gaps() {
    let model = Model::from_faces(ModelArrays { instances: vec![], ..assembly() }).unwrap();
    let text = model.to_json().unwrap();
    assert_eq!(Model::from_json(&text).unwrap(), model);
    let placed = Model::from_faces(assembly()).unwrap();
    let text = placed.to_json().unwrap();
    assert_eq!(Model::from_json(&text).unwrap().to_json().unwrap(), text);
    // As in the description of the format, with keys that are ignored.
    let text = r#"{"unit": 0.001, "source": {"file": "part.stp", "uncertainty": 0.01},
        "surfaces": [{"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1],
            "ctrl": [[[0, 0, 0, 1], [0, 1, 0, 1]], [[1, 0, 0, 1], [1, 1, 0, 1]]],
            "trim": [[
                {"degree": 1, "knots": [0, 0, 1, 1], "ctrl": [[0, 0, 1], [1, 0, 1]], "gap": 0.0, "edge": 17},
                {"degree": 1, "knots": [0, 0, 1, 1], "ctrl": [[1, 0, 1], [0, 1, 1]]},
                {"degree": 1, "knots": [0, 0, 1, 1], "ctrl": [[0, 1, 1], [0, 0, 1]], "degenerate": false}]],
            "reversed": false, "part": "face 12", "kind": "plane", "gap": 3e-7}],
        "instances": [{"surfaces": [0, 0], "transform": [1,0,0,0, 0,1,0,0, 0,0,1,5], "name": "bolt:2"}]}"#;
    let model = Model::from_json(text).unwrap();
    assert_eq!(model.surfaces()[1].control_points()[0], [0.0, 0.0, 5.0, 1.0]);
    assert_eq!(model.faces().next().unwrap().kind(), Some("plane"));
    assert_eq!(model.faces().next().unwrap().trim().unwrap().winding().number([0.3, 0.3]), Some(1));
    let error = Model::from_json(&text.replace("[1, 0, 1], [0, 1, 1]", "[1, 0, 1], [0, 1, 0]")).unwrap_err();
    assert_eq!(error.code(), "TRIM_WEIGHT_NOT_POSITIVE");
    let error = Model::from_json(&text.replace("\"degree\": 1, ", "")).unwrap_err();
    assert!(error.to_string().contains("surfaces[0].trim[0][0]"), "{error}");
}

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
