//! Clearances against distances known from geometry, and against samples.

use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::{Engine, PreparedModel, Stop};
use nurbs_hausdorff::shapes::{cylinder, shape, sphere, torus};
use nurbs_hausdorff::{ClearanceOptions, ClearanceResult, GapOptions, Model, Overlap, RigidTransform};

pub(super) fn clearance(a: &Model, b: &Model, options: &ClearanceOptions) -> ClearanceResult {
    let [a, b] = [a, b].map(|model| PreparedModel::new(model).unwrap());
    let engine = Engine::cpu();
    engine.clearance(&a, &b, options).wait().unwrap()
}

pub(super) fn pose(axis: [f64; 3], angle: f64, offset: [f64; 3]) -> RigidTransform {
    let turn = DQuat::from_axis_angle(DVec3::from_array(axis).normalize(), angle);
    RigidTransform::new(turn, DVec3::from_array(offset)).unwrap()
}

/// Whether the truth is in an interval of the width, whose witness attains the upper end.
pub(super) fn assert_clearance(name: &str, a: &Model, b: &Model, transform: RigidTransform, truth: f64) {
    for relative_tolerance in [1e-3, 1e-6, 1e-9] {
        let options = ClearanceOptions {
            relative_tolerance: Some(relative_tolerance),
            transform,
            max_cells: Some(2_000_000),
            ..ClearanceOptions::default()
        };
        let result = clearance(a, b, &options);
        let ClearanceResult { lower, upper, cells, .. } = result;
        println!("{name} at {relative_tolerance:e}: [{lower:e}, {upper:e}], {cells} pairs");
        assert!(lower <= truth && truth <= upper, "{name}: {truth} not in [{lower}, {upper}]");
        assert!(result.converged && upper - lower <= result.tolerance, "{name}: {:?}", result.stop);
        let [a, b] = [&result.witness.a, &result.witness.b].map(|at| DVec3::from_array(at.point));
        assert!((a.distance(b) - upper).abs() <= 1e-13 * result.diagonal, "{name}: the witness");
    }
}

#[test]
fn spheres_apart_touching_crossing_and_nested() {
    let (one, other) = (sphere(DVec3::ZERO, 1.0).unwrap(), sphere(DVec3::ZERO, 0.5).unwrap());
    let at = |distance: f64| {
        let offset = distance * DVec3::new(1.0, 2.0, -2.0) / 3.0;
        pose([0.3, -1.0, 0.4], 1.1, offset.to_array())
    };
    assert_clearance("apart", &other, &one, at(3.0), 1.5);
    assert_clearance("touching", &other, &one, at(1.5), 0.0);
    assert_clearance("crossing", &other, &one, at(1.2), 0.0);
    assert_clearance("nested", &other, &one, at(0.2), 0.3);
}

#[test]
fn tori_apart_and_linked() {
    let torus = torus(2.0, 0.5).unwrap();
    // Rings in planes at right angles: the moved core (1.5 - 2 cos φ, 0, 2 sin φ) is nearest to the
    // other where it crosses its plane, 1.5 on either side.
    let linked = pose([1.0, 0.0, 0.0], std::f64::consts::FRAC_PI_2, [1.5, 0.0, 0.0]);
    assert_clearance("linked", &torus, &torus, linked, 0.5);
    // In one plane, side by side.
    assert_clearance("beside", &torus, &torus, pose([0.0, 0.0, 1.0], 0.7, [6.0, 0.0, 0.0]), 1.0);
}

#[test]
fn a_cylinder_beside_a_sphere() {
    // Its lateral surface ends at half the height; a sphere beyond the rim is nearest to the rim.
    let (body, ball) = (cylinder(1.5, 4.0).unwrap(), sphere(DVec3::ZERO, 0.25).unwrap());
    let box_of = PreparedModel::new(&body).unwrap().bounding_box();
    let top = box_of.max.z;
    let beside = pose([0.0, 1.0, 0.0], 0.4, [1.5 + 2.0, 0.0, 0.5 * (box_of.min.z + top)]);
    assert_clearance("beside", &ball, &body, beside, 1.75);
    let beyond = pose([0.0, 1.0, 0.0], 0.4, [1.5 + 3.0, 0.0, top + 4.0]);
    assert_clearance("beyond the rim", &ball, &body, beyond, 4.75);
}

#[test]
fn a_limit_is_decided_and_costs_less() {
    let (one, other) = (sphere(DVec3::ZERO, 1.0).unwrap(), sphere(DVec3::ZERO, 0.5).unwrap());
    let transform = pose([0.3, -1.0, 0.4], 1.1, [3.0, 0.0, 0.0]);
    let narrow =
        ClearanceOptions { relative_tolerance: Some(1e-9), transform, ..ClearanceOptions::default() };
    let whole = clearance(&other, &one, &narrow);
    for (limit, expected) in [(1.4, true), (1.49, true), (1.51, false), (2.0, false)] {
        let options = ClearanceOptions { limit: Some(limit), ..narrow.clone() };
        let result = clearance(&other, &one, &options);
        assert_eq!(result.at_least, Some(expected), "{limit}");
        assert!(result.converged && result.lower <= 1.5 && 1.5 <= result.upper);
        assert!(result.cells < whole.cells, "{limit}: {} and {}", result.cells, whole.cells);
    }
    let exact = ClearanceOptions { limit: Some(1.5), max_cells: Some(20_000), ..narrow };
    let result = clearance(&other, &one, &exact);
    assert!(result.at_least.is_none() && !result.converged, "{result:?}");
}

#[test]
fn budgets_return_the_interval_so_far() {
    let (one, other) = (shape("wavy-sheet").unwrap(), shape("wavy-sheet-b").unwrap());
    let transform = pose([0.0, 0.0, 1.0], 0.3, [0.0, 0.0, 2.5]);
    let options = |max_cells| ClearanceOptions { transform, max_cells, ..ClearanceOptions::default() };
    let all = clearance(&one, &other, &options(None));
    let some = clearance(&one, &other, &options(Some(1)));
    assert!(all.converged && !some.converged && some.stop == Stop::Cells, "{:?}", some.stop);
    assert!(some.lower <= all.lower && all.upper <= some.upper);
}

#[test]
fn a_tolerance_below_rounding_stops_with_precision() {
    let (one, other) = (sphere(DVec3::ZERO, 1.0).unwrap(), sphere(DVec3::ZERO, 0.5).unwrap());
    let transform = pose([0.3, -1.0, 0.4], 1.1, [3.0, 0.0, 0.0]);
    let options = ClearanceOptions { tolerance: Some(1e-18), transform, ..ClearanceOptions::default() };
    let result = clearance(&other, &one, &options);
    assert_eq!(result.stop, Stop::Precision);
    assert!(result.lower <= 1.5 && 1.5 <= result.upper);
    let options = ClearanceOptions { tolerance: Some(result.min_tolerance), transform, ..options };
    assert!(clearance(&other, &one, &options).converged);
}

/// The pieces of every pair of shapes, at some poses, against the distances of a grid of samples.
#[test]
fn no_sample_is_nearer_than_the_interval() {
    let names = ["wavy-sheet", "naca-wing", "bottle", "cone", "wigley-hull"];
    let models = names.map(|name| shape(name).unwrap());
    for (i, a) in models.iter().enumerate() {
        for (j, b) in models.iter().enumerate() {
            let k = (i * names.len() + j) as f64;
            let offset = [3.0 * (0.7 * k).sin(), 3.0 * (1.3 * k).cos(), 4.0 * (0.3 * k).sin()];
            let transform = pose([1.0, (2.1 * k).sin(), 0.4], k, offset);
            let result = clearance(a, b, &ClearanceOptions { transform, ..ClearanceOptions::default() });
            assert!(result.converged, "{} and {}", names[i], names[j]);
            let points = |model: &Model| -> Vec<DVec3> {
                let steps = 24;
                let surfaces = model.surfaces().iter();
                let grid = |k: i32| (k / (steps + 1), k % (steps + 1));
                surfaces
                    .flat_map(|surface| {
                        (0..(steps + 1) * (steps + 1)).map(move |k| {
                            let (i, j) = grid(k);
                            let fractions = [i, j].map(|at| f64::from(at) / f64::from(steps));
                            DVec3::from_array(surface.point(surface.domain().at(fractions)))
                        })
                    })
                    .collect()
            };
            let (of_a, of_b) = (points(a), points(b));
            let nearest = of_a
                .iter()
                .map(|&point| transform.apply(point))
                .flat_map(|point| of_b.iter().map(move |&other| point.distance(other)))
                .fold(f64::INFINITY, f64::min);
            assert!(result.lower <= nearest, "{} and {}: {} > {nearest}", names[i], names[j], result.lower);
        }
    }
}

#[test]
fn the_overlap_of_spheres_is_that_of_their_centres_and_radii() {
    let (one, other) = (sphere(DVec3::ZERO, 1.0).unwrap(), sphere(DVec3::ZERO, 0.5).unwrap());
    for (distance, kind) in
        [(1.51, "none"), (1.5, "touching"), (1.4, "both"), (0.6, "both"), (0.4, "contained")]
    {
        let offset = distance * DVec3::new(2.0, -1.0, 2.0) / 3.0;
        let transform = pose([0.3, -1.0, 0.4], 1.1, offset.to_array());
        let limit = Some(1e-3);
        for options in [
            ClearanceOptions { transform, ..ClearanceOptions::default() },
            ClearanceOptions { transform, limit, ..ClearanceOptions::default() },
        ] {
            let result = clearance(&other, &one, &options);
            let inside = match (kind, result.overlap) {
                ("none", Some(Overlap::None)) | ("touching", Some(Overlap::Touching)) => None,
                ("both", Some(Overlap::Intersecting { inside_both }))
                | ("contained", Some(Overlap::Contained { inside_both })) => {
                    Some(DVec3::from_array(inside_both))
                }
                // A decision may end before the boundaries are within the tolerance.
                ("touching", None) if options.limit.is_some() => None,
                (_, found) => panic!("{kind} at {distance}: {found:?}"),
            };
            if let Some(point) = inside {
                assert!(point.length() < 1.0 && point.distance(offset) <= 0.5 + 1e-12, "{point}");
                // A point of a body that the other one contains is not on its boundary.
                assert!(kind != "contained" || point.distance(offset) < 0.5 - 1e-9, "{point}");
            }
            let at_least = options.limit.map(|_| kind == "none");
            assert_eq!(result.at_least, at_least, "{kind}");
        }
    }
}

/// Faces of two boxes: only those that face each other are near.
#[test]
fn the_gaps_of_two_boxes_are_those_of_the_faces_that_face_each_other() {
    let boxes = |size: f64| Model::from_arrays(None, super::solids::cube(size)).unwrap();
    let (a, b) = (boxes(1.0), boxes(2.0));
    let [a, b] = [&a, &b].map(|model| PreparedModel::new(model).unwrap());
    let engine = Engine::cpu();
    let transform = pose([0.0, 0.0, 1.0], 0.0, [3.25, 0.0, 0.0]);
    let gaps = |below: f64| {
        let options = GapOptions { below, transform, ..GapOptions::default() };
        engine.gaps(&a, &b, &options).wait().unwrap()
    };
    assert!(gaps(0.2).pairs.is_empty());
    // At 0.25 the upper ends are above the limit, and the faces are no farther apart than that.
    for below in [0.25, 0.3] {
        let found = gaps(below);
        assert!(found.complete);
        // The face at x = -1 of A, and its four neighbours by their edges; the face at x = 2 of B.
        assert_eq!(found.pairs.len(), 5, "{below}");
        for pair in &found.pairs {
            assert!(pair.converged && pair.lower <= 0.25 && 0.25 <= pair.upper);
            assert_eq!(pair.witness.b.face, 1);
            let [a, b] = [&pair.witness.a, &pair.witness.b].map(|witness| witness.point[0]);
            assert!((b - 2.0).abs() < 1e-12 && (a - 2.25).abs() < 1e-12);
        }
        assert!(found.pairs.iter().any(|pair| pair.witness.a.face == 0));
    }
}
