//! Inserting knots, elevating degrees, cutting and moving keep the surface.

use crate::support::evaluator::{distance, evaluate, length, parameters, point};
use crate::support::models;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::shapes::operations::{cut_model, cut_surface, elevate_degree, insert_knot, transformed};
use nurbs_hausdorff::shapes::{list, shape};
use nurbs_hausdorff::{Axis, Model, NurbsSurface, RigidTransform, SurfaceArrays};

/// Part of the diagonal by which points may differ.
const TOLERANCE: f64 = 1e-12;

/// The first surfaces of a model are enough: the rest are of the same kinds.
const SURFACES: usize = 12;

const SAMPLES: usize = 7;

fn shapes_and_models(test: &str) -> impl Iterator<Item = (String, Model)> {
    list()
        .map(|info| (info.name.to_owned(), shape(info.name).unwrap()))
        .chain([("unclamped".to_owned(), Model::new(None, vec![unclamped()]).unwrap())])
        .chain(models::all(test))
}

/// A rational sheet with unclamped knots of mixed multiplicity in both directions.
fn unclamped() -> NurbsSurface {
    let control_points = (0..7 * 6)
        .map(|k| {
            let (i, j) = (f64::from(k / 6), f64::from(k % 6));
            [i, j, (1.3 * i + 0.7 * j * j).sin(), 1.0 + 0.3 * (i * j).cos()]
        })
        .collect();
    let arrays = SurfaceArrays {
        degree: [3, 2],
        knots: [
            vec![-1.0, -0.5, 0.0, 0.25, 1.0, 1.0, 2.5, 3.0, 3.5, 3.5, 5.0],
            vec![0.0, 0.1, 0.4, 1.0, 1.7, 1.7, 2.0, 2.1, 4.0],
        ],
        counts: [7, 6],
        control_points,
    };
    NurbsSurface::new(0, arrays).unwrap()
}

/// Fails unless both surfaces have the same points at the same parameters in
/// the domain of `part`.
fn assert_same(name: &str, whole: &NurbsSurface, part: &NurbsSurface, diagonal: f64) {
    for [u, v] in parameters(part, SAMPLES) {
        let error = distance(point(whole, u, v), point(part, u, v));
        assert!(error <= TOLERANCE * diagonal, "{name} at ({u}, {v}): {}", error / diagonal);
    }
}

/// Fractions of a domain that are no round parameters.
const FRACTIONS: [f64; 3] = [0.137, 0.5, 0.861];

fn at(surface: &NurbsSurface, axis: Axis, fraction: f64) -> f64 {
    let [start, end] = surface.domain()[axis];
    (1.0 - fraction) * start + fraction * end
}

#[test]
fn inserted_knots_keep_the_surface() {
    for (name, model) in shapes_and_models("inserted_knots_keep_the_surface") {
        let diagonal = model.bounding_box().diagonal();
        for surface in model.surfaces().iter().take(SURFACES) {
            let mut refined = surface.clone();
            for axis in Axis::BOTH {
                for fraction in FRACTIONS {
                    let knot = at(surface, axis, fraction);
                    if !surface.knots(axis).contains(&knot) {
                        refined = insert_knot(&refined, axis, knot, surface.degree()[axis].min(2)).unwrap();
                    }
                }
            }
            assert_same(&name, surface, &refined, diagonal);
        }
    }
}

#[test]
fn elevated_degrees_keep_the_surface() {
    for (name, model) in shapes_and_models("elevated_degrees_keep_the_surface") {
        let diagonal = model.bounding_box().diagonal();
        for surface in model.surfaces().iter().take(SURFACES) {
            let mut elevated = surface.clone();
            for axis in [Axis::U, Axis::V, Axis::V] {
                elevated = elevate_degree(&elevated, axis).unwrap();
            }
            let [p, q] = surface.degree();
            assert_eq!(elevated.degree(), [p + 1, q + 2]);
            assert_eq!(elevated.domain(), surface.domain());
            assert_same(&name, surface, &elevated, diagonal);
        }
    }
}

#[test]
fn cut_surfaces_keep_their_points() {
    for (name, model) in shapes_and_models("cut_surfaces_keep_their_points") {
        let diagonal = model.bounding_box().diagonal();
        for surface in model.surfaces().iter().take(SURFACES) {
            for axis in Axis::BOTH {
                for fraction in FRACTIONS {
                    let parameter = at(surface, axis, fraction);
                    let pieces = cut_surface(surface, axis, parameter).unwrap();
                    assert_eq!(pieces[0].domain()[axis][1], parameter);
                    assert_eq!(pieces[1].domain()[axis][0], parameter);
                    assert_same(&name, surface, &pieces[1], diagonal);
                    // The lower piece ends where the whole surface may jump.
                    if !surface.knots(axis).contains(&parameter) {
                        assert_same(&name, surface, &pieces[0], diagonal);
                    }
                }
            }
        }
    }
}

#[test]
fn cutting_at_a_full_knot_takes_the_sides_apart() {
    let arrays = SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0, 2.0, 2.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [4, 2],
        control_points: (0..8).map(|k| [f64::from(k / 2), f64::from(k % 2), 0.0, 1.0]).collect(),
    };
    let pieces = cut_surface(&NurbsSurface::new(0, arrays).unwrap(), Axis::U, 1.0).unwrap();
    assert_eq!(point(&pieces[0], 1.0, 0.0), [1.0, 0.0, 0.0]);
    assert_eq!(point(&pieces[1], 1.0, 0.0), [2.0, 0.0, 0.0]);
}

#[test]
fn cut_models_have_all_pieces() {
    let model = shape("cylinder").unwrap();
    let cut = cut_model(&model, [&[0.6, 0.2], &[0.5]]).unwrap();
    assert_eq!(cut.surfaces().len(), 3 * 3 * 2);
    assert_eq!(cut.name(), model.name());
    let area = |surface: &NurbsSurface| {
        let [[u0, u1], [v0, v1]] = surface.domain().intervals();
        (u1 - u0) * (v1 - v0)
    };
    for (whole, pieces) in model.surfaces().iter().zip(cut.surfaces().chunks(6)) {
        assert!((pieces.iter().map(area).sum::<f64>() - area(whole)).abs() < 1e-14);
        for piece in pieces {
            assert_same("cylinder", whole, piece, 5.0);
        }
    }
}

#[test]
fn equal_weights_stay_equal() {
    let sheet = shape("wavy-sheet").unwrap().surfaces()[0].clone();
    let refined = insert_knot(&elevate_degree(&sheet, Axis::U).unwrap(), Axis::V, 0.123, 3).unwrap();
    assert!(refined.control_points().iter().all(|point| point[3] == 1.0));
}

#[test]
fn transformed_models_are_moved() {
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 1.1);
    let transform = RigidTransform::new(turn, DVec3::new(3.0, -4.0, 0.5)).unwrap();
    let model = shape("glass").unwrap();
    let moved = transformed(&model, &transform).unwrap();
    for [u, v] in parameters(&model.surfaces()[0], 9) {
        let expected = transform.apply(DVec3::from(point(&model.surfaces()[0], u, v)));
        assert!(distance(point(&moved.surfaces()[0], u, v), expected.into()) < 1e-14 * 10.0);
    }
}

#[test]
fn elevated_surfaces_have_the_same_derivatives() {
    let surface = unclamped();
    let elevated = elevate_degree(&elevate_degree(&surface, Axis::U).unwrap(), Axis::V).unwrap();
    for [u, v] in parameters(&surface, 8) {
        let [a, b] = [&surface, &elevated].map(|surface| evaluate(surface, u, v, [0.0; 3]));
        for (a, b) in [(a.u, b.u), (a.v, b.v), (a.uu, b.uu), (a.uv, b.uv), (a.vv, b.vv)] {
            assert!(distance(a, b) < 1e-11 * (1.0 + length(a)), "at ({u}, {v}): {a:?} {b:?}");
        }
    }
}

#[test]
fn operations_refuse_what_is_out_of_range() {
    let surface = unclamped();
    for (knot, times) in [(0.24, 1), (3.1, 1), (f64::NAN, 1), (0.5, 4), (1.0, 2)] {
        assert_eq!(insert_knot(&surface, Axis::U, knot, times).unwrap_err().code(), "OPTION_OUT_OF_RANGE");
    }
    for parameter in [0.25, 3.0, f64::NAN, f64::INFINITY] {
        assert_eq!(cut_surface(&surface, Axis::U, parameter).unwrap_err().code(), "OPTION_OUT_OF_RANGE");
    }
    let mut highest = surface;
    while highest.degree()[0] < 15 {
        highest = elevate_degree(&highest, Axis::U).unwrap();
    }
    assert_same("degree 15", &unclamped(), &highest, 10.0);
    assert_eq!(elevate_degree(&highest, Axis::U).unwrap_err().code(), "DEGREE_OUT_OF_RANGE");
}

#[test]
fn inserting_nothing_changes_nothing() {
    let surface = unclamped();
    assert_eq!(insert_knot(&surface, Axis::V, 0.5, 0).unwrap(), surface);
}
