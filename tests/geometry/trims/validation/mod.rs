//! Trimming loops are validated once: what they enclose, what they are closed by, and
//! what is refused, by a stable code and a text that names surface, loop and curve.

mod placed;
mod winding;

use crate::support::trims::{circle, ellipse, face, line, plane, polygon, rectangle, reversed};
use nurbs_hausdorff::internals::model::ModelArrays;
use nurbs_hausdorff::internals::model::trim::{Trim, TrimCurveArrays, oriented};
use nurbs_hausdorff::{Error, Model, NurbsSurface, SurfaceArrays};

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
    let whole = rectangle([0.0, 0.0], [4.0, 4.0]);
    let nothing = vec![whole.clone(), reversed(whole)];
    refused("TRIM_REGION_NO_AREA", &["mean width is 0e0"], nothing);
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
