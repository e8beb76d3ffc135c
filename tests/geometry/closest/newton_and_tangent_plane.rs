//! Foot points on one patch against geometry and against dense sampling.

use glam::DVec3;
use nurbs_hausdorff::internals::bezier::{BezierModel, Patch, extract};
use nurbs_hausdorff::internals::closest::{
    Foot, Status, contraction, nearest_control, newton, tangent_plane,
};
use nurbs_hausdorff::shapes::{lateral, sphere, torus};
use nurbs_hausdorff::{Model, SurfaceArrays};
use proptest::collection::vec;
use proptest::prelude::*;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

/// Steps that suffice from anywhere on a flat patch.
const ITERATIONS: u32 = 40;

/// Rounding of points and distances of size 1 to 10.
const ROUNDING: f64 = 1e-12;

fn single(degree: [usize; 2], control_points: Vec<[f64; 4]>) -> BezierModel {
    let counts = degree.map(|degree| degree + 1);
    let knots = degree.map(|degree| [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat());
    extract(&Model::from_arrays(None, vec![SurfaceArrays { degree, knots, counts, control_points }]).unwrap())
}

/// The point of a single patch by de Casteljau on the control points.
fn point(degree: [usize; 2], control_points: &[[f64; 4]], [s, t]: [f64; 2]) -> DVec3 {
    let along = |mut line: Vec<[f64; 4]>, t: f64| {
        while line.len() > 1 {
            line = line
                .windows(2)
                .map(|pair| [0, 1, 2, 3].map(|k| (1.0 - t) * pair[0][k] + t * pair[1][k]))
                .collect();
        }
        line[0]
    };
    let homogeneous = |&[x, y, z, w]: &[f64; 4]| [w * x, w * y, w * z, w];
    let rows = control_points.chunks(degree[1] + 1);
    let column = rows.map(|row| along(row.iter().map(homogeneous).collect(), t)).collect();
    let [x, y, z, w] = along(column, s);
    DVec3::new(x, y, z) / w
}

/// A quarter of the cylinder of this radius about the z axis, from the x to
/// the y axis, 2 high: s runs around.
fn quarter_cylinder(radius: f64) -> BezierModel {
    let arc = [[radius, 0.0, 1.0], [radius, radius, FRAC_1_SQRT_2], [0.0, radius, 1.0]];
    let points = arc.iter().flat_map(|&[x, y, w]| [[x, y, -1.0, w], [x, y, 1.0, w]]).collect();
    single([2, 1], points)
}

/// At this angle about the z axis, as far from it, in the plane z = height.
fn around(angle: f64, from_axis: f64, height: f64) -> DVec3 {
    DVec3::new(from_axis * angle.cos(), from_axis * angle.sin(), height)
}

fn solve(patch: &Patch<'_>, target: DVec3) -> Foot {
    newton(patch, target, nearest_control(patch, target), ITERATIONS)
}

/// The nearest of the feet on all patches.
fn nearest(model: &BezierModel, target: DVec3) -> Foot {
    let feet = model.patches.iter().map(|patch| solve(&patch, target));
    feet.min_by(|a, b| a.distance_squared.total_cmp(&b.distance_squared)).unwrap()
}

/// Points all about, at distances from 0.1 to 10 from the origin, none on an axis.
fn targets() -> impl Iterator<Item = DVec3> {
    let turn = |index: u32| f64::from(index);
    (0..60_u32).map(move |index| {
        // The golden angle spreads directions evenly.
        let height = 1.0 - (2.0 * turn(index) + 1.0) / 60.0;
        let direction = around(2.399_963_229_728_653 * turn(index), (1.0 - height * height).sqrt(), height);
        direction * 0.1 * 1.08_f64.powf(turn(index))
    })
}

#[test]
fn feet_on_a_sphere() {
    let ball = extract(&sphere(DVec3::ZERO, 2.0).unwrap());
    for target in targets() {
        let distance = nearest(&ball, target).distance_squared.sqrt();
        assert!((distance - (target.length() - 2.0).abs()).abs() < ROUNDING, "{target}: {distance}");
    }
}

#[test]
fn feet_on_a_torus() {
    let ring = extract(&torus(3.0, 1.0).unwrap());
    for target in targets() {
        let from_circle = (target.truncate().length() - 3.0).hypot(target.z);
        let distance = nearest(&ring, target).distance_squared.sqrt();
        assert!((distance - (from_circle - 1.0).abs()).abs() < ROUNDING, "{target}: {distance}");
    }
}

#[test]
fn feet_on_a_cylinder_and_on_its_rims() {
    let wall = Model::new(None, vec![lateral([2.0, 2.0], [-1.0, 1.0]).unwrap()]).unwrap();
    let wall = extract(&wall);
    let mut on_rims = 0;
    for target in targets() {
        let above = (target.z.abs() - 1.0).max(0.0);
        let expected = (target.truncate().length() - 2.0).hypot(above);
        let foot = nearest(&wall, target);
        let distance = foot.distance_squared.sqrt();
        assert!((distance - expected).abs() < ROUNDING, "{target}: {distance}");
        if above > 0.0 {
            on_rims += 1;
            assert_eq!(foot.status, Status::OnEdge, "{target}");
        }
    }
    assert!(on_rims > 10);
}

#[test]
fn beyond_the_centre_of_curvature_the_nearest_points_are_the_ends() {
    // Seen from beyond the axis, the arc's middle is its farthest point.
    let quarter = quarter_cylinder(1.0);
    let patch = quarter.patches.patch(0);
    for (from_axis, angle) in [(0.5, 0.5), (0.9, 0.4), (3.0, 0.6), (1.5, 0.49)] {
        let target = around((1.0 + angle) * 2.0 * FRAC_PI_2, from_axis, 0.3);
        let end = |at: f64| (target - around(at, 1.0, 0.3)).length();
        let expected = end(0.0).min(end(FRAC_PI_2));
        // A distance of more than the radius of curvature.
        assert!(expected > 1.0);
        let foot = solve(&patch, target);
        assert!((foot.distance_squared.sqrt() - expected).abs() < ROUNDING, "{target}");
        assert_eq!(foot.status, Status::OnEdge, "{target}");
    }
}

/// Near the axis the distance is bent downwards on the far half of the arc, and
/// steps as if it were flat would be fifty times too short.
#[test]
fn steps_do_not_creep_where_the_distance_is_bent_downwards() {
    let quarter = quarter_cylinder(1.0);
    let patch = quarter.patches.patch(0);
    let target = around(2.0 * FRAC_PI_2, 0.02, 0.1);
    for start in [0.05, 0.3, 0.7] {
        let foot = newton(&patch, target, [start, 0.2], 10);
        assert_eq!((foot.status, foot.parameters[0]), (Status::OnEdge, 1.0), "from {start}");
        assert!((foot.distance_squared - 1.0004).abs() < ROUNDING);
    }
}

#[test]
fn every_point_of_the_arc_is_as_near_to_its_axis() {
    let quarter = quarter_cylinder(1.0);
    let patch = quarter.patches.patch(0);
    for height in [-0.7, 0.0, 0.2] {
        let foot = solve(&patch, DVec3::new(0.0, 0.0, height));
        assert!((foot.distance_squared.sqrt() - 1.0).abs() < ROUNDING);
        assert_ne!(foot.status, Status::IterationLimit);
    }
}

#[test]
fn feet_beside_a_pole() {
    // Around a pole all control points of an edge are one: where u is there says nothing.
    let ball = extract(&sphere(DVec3::ZERO, 1.0).unwrap());
    for azimuth in [0.1, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0] {
        for colatitude in [0.0, 1e-9, 1e-5, 1e-2, 0.2] {
            for distance in [0.5, 0.999, 1.001, 2.0, 10.0_f64] {
                for pole in [1.0, -1.0] {
                    let at = around(
                        azimuth,
                        distance * f64::sin(colatitude),
                        pole * distance * f64::cos(colatitude),
                    );
                    let found = nearest(&ball, at).distance_squared.sqrt();
                    assert!((found - (distance - 1.0).abs()).abs() < 1e-9, "{at}: {found}");
                }
            }
        }
    }
}

#[test]
fn statuses_tell_how_an_iteration_ended() {
    let square = single(
        [1, 1],
        vec![[0.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0], [1.0, 1.0, 0.0, 1.0]],
    );
    let square = square.patches.patch(0);
    let above = solve(&square, DVec3::new(0.3, 0.6, 2.0));
    assert_eq!(above.status, Status::Converged);
    assert!((above.parameters[0] - 0.3).abs() < ROUNDING && (above.parameters[1] - 0.6).abs() < ROUNDING);
    let beside = solve(&square, DVec3::new(1.5, 0.6, 2.0));
    assert_eq!(beside.status, Status::OnEdge);
    assert!((beside.distance_squared - (0.25 + 4.0)).abs() < ROUNDING);
    let diagonal = solve(&square, DVec3::new(-3.0, 5.0, 0.0));
    assert_eq!((diagonal.status, diagonal.parameters), (Status::OnEdge, [0.0, 1.0]));
    // On the surface itself there is nothing left to step.
    let on_it = solve(&square, DVec3::new(0.25, 0.25, 0.0));
    assert_eq!(on_it.status, Status::Converged);
    assert!(on_it.distance_squared < ROUNDING * ROUNDING);
    let quarter = quarter_cylinder(1.0);
    let bent = quarter.patches.patch(0);
    let target = around(0.4, 1.7, 0.1);
    assert_eq!(newton(&bent, target, [1.0, 0.0], 1).status, Status::IterationLimit);
    assert_eq!(newton(&bent, target, [1.0, 0.0], ITERATIONS).status, Status::Converged);
}

#[test]
fn the_tangent_plane_step_is_exact_on_a_plane() {
    let square = single(
        [1, 1],
        vec![[0.0, 0.0, 0.0, 1.0], [0.0, 2.0, 0.0, 1.0], [1.0, 1.0, 0.0, 1.0], [1.0, 3.0, 0.0, 1.0]],
    );
    let square = square.patches.patch(0);
    let inside = tangent_plane(&square, DVec3::new(0.5, 1.25, 3.0), [0.0, 0.0], 1, 1e-9);
    assert!((inside.distance_squared - 9.0).abs() < ROUNDING);
    // The one step was a long one, so that nothing says it was the last needed.
    assert_eq!(inside.status, Status::IterationLimit);
    let again = tangent_plane(&square, DVec3::new(0.5, 1.25, 3.0), [0.0, 0.0], 2, 1e-9);
    assert_eq!(again.status, Status::Converged);
}

/// Contraction observed from beside the foot, for a target this far outside a
/// cylinder of this radius, or inside if negative.
fn observed(radius: f64, distance: f64) -> f64 {
    let quarter = quarter_cylinder(radius);
    contraction(&quarter.patches.patch(0), around(FRAC_PI_2 / 2.0, radius + distance, 0.0), [0.502, 0.5], 6)
}

#[test]
fn the_tangent_plane_step_contracts_by_distance_times_curvature() {
    // The parameter's error shrinks by d κ a step (Gauss-Newton), the
    // distance's, which is its square and is what is observed, by (d κ)^2.
    for radius in [1.0, 4.0] {
        for part in [0.2, 0.5, 0.8, -0.3, -0.7] {
            let expected: f64 = part * part;
            let found = observed(radius, part * radius);
            assert!((found - expected).abs() < 0.01, "radius {radius}, d κ = {part}: {found}, {expected}");
        }
        // Farther outside than the radius of curvature the iteration diverges.
        assert!(observed(radius, 1.5 * radius) > 1.0);
    }
}

#[test]
fn far_outside_a_cylinder_the_tangent_plane_step_ends_in_a_wrong_corner() {
    let quarter = quarter_cylinder(1.0);
    let patch = quarter.patches.patch(0);
    let target = around(FRAC_PI_2 / 2.0, 4.0, 0.0);
    let published = tangent_plane(&patch, target, [0.45, 0.5], ITERATIONS, 1e-9);
    // It leaps across the foot until it is cut at an end of the arc, whose
    // distance is known: the law of cosines, at 45° from the target.
    let at_the_ends = (17.0 - 8.0 * FRAC_1_SQRT_2).sqrt();
    assert!((published.distance_squared.sqrt() - at_the_ends).abs() < ROUNDING);
    assert_ne!(published.status, Status::Converged);
    // Where the damped step does.
    let damped = newton(&patch, target, [0.45, 0.5], ITERATIONS);
    assert!((damped.distance_squared.sqrt() - 3.0).abs() < ROUNDING);
}

/// Nets over a unit square, bent so little that within 0.2 of them the
/// distance has one minimum: second derivatives of heights up to 0.02 are
/// below p (p - 1) 0.08 <= 1.6, curvatures times distance below 1.
fn gentle() -> impl Strategy<Value = ([usize; 2], Vec<[f64; 4]>)> {
    (1_usize..=5, 1_usize..=5).prop_flat_map(|(p, q)| {
        vec(0.0..0.02, (p + 1) * (q + 1)).prop_map(move |heights: Vec<f64>| {
            let at =
                |index: usize| [(index / (q + 1)) as f64 / p as f64, (index % (q + 1)) as f64 / q as f64];
            let points = heights.iter().enumerate().map(|(index, &z)| [at(index)[0], at(index)[1], z, 1.0]);
            ([p, q], points.collect())
        })
    })
}

/// Nets of any shape with weights of a ratio up to 10.
fn wild() -> impl Strategy<Value = ([usize; 2], Vec<[f64; 4]>)> {
    (1_usize..=6, 1_usize..=6).prop_flat_map(|(p, q)| {
        let point = (-1.0..1.0, -1.0..1.0, -1.0..1.0, 1.0..10.0).prop_map(|(x, y, z, w)| [x, y, z, w]);
        vec(point, (p + 1) * (q + 1)).prop_map(move |points| ([p, q], points))
    })
}

fn target() -> impl Strategy<Value = DVec3> {
    (-2.0..2.0, -2.0..2.0, -2.0..2.0).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_sample_of_a_gentle_patch_is_nearer_than_its_foot(
        (degree, points) in gentle(),
        x in -0.2..1.2,
        y in -0.2..1.2,
        z in -0.15..0.15,
    ) {
        let target = DVec3::new(x, y, z);
        let model = single(degree, points.clone());
        let foot = solve(&model.patches.patch(0), target);
        let at = |index: usize| index as f64 / 40.0;
        let least = (0..41 * 41)
            .map(|index| point(degree, &points, [at(index / 41), at(index % 41)]).distance_squared(target))
            .fold(f64::INFINITY, f64::min);
        prop_assert!(foot.distance_squared <= least + ROUNDING);
        prop_assert_ne!(foot.status, Status::IterationLimit);
    }

    #[test]
    fn a_foot_is_a_point_of_the_patch_and_no_farther_than_the_start(
        (degree, points) in wild(),
        target in target(),
        start in [0.0..1.0, 0.0..1.0],
        iterations in 0_u32..12,
    ) {
        let model = single(degree, points.clone());
        let patch = model.patches.patch(0);
        let before = point(degree, &points, start).distance_squared(target);
        for (foot, may_rise) in [
            (newton(&patch, target, start, iterations), false),
            (tangent_plane(&patch, target, start, iterations, 1e-6), true),
        ] {
            prop_assert!(foot.parameters.iter().all(|parameter| (0.0..=1.0).contains(parameter)));
            let there = point(degree, &points, foot.parameters).distance_squared(target);
            prop_assert!((foot.distance_squared - there).abs() <= ROUNDING * (1.0 + there));
            prop_assert!(may_rise || foot.distance_squared <= before + ROUNDING * (1.0 + before));
        }
    }

    #[test]
    fn a_converged_foot_is_stationary(
        (degree, points) in wild(),
        target in target(),
    ) {
        let model = single(degree, points.clone());
        let foot = solve(&model.patches.patch(0), target);
        if foot.status == Status::Converged {
            // By differences: along neither direction does the distance change.
            // They are off by 1e-6 times a second derivative, which is below 1e4 for such nets.
            let here = point(degree, &points, foot.parameters);
            let towards = (target - here).normalize();
            for axis in [0, 1] {
                let mut beside = foot.parameters;
                beside[axis] += if beside[axis] > 0.5 { -1e-6 } else { 1e-6 };
                let slope = (point(degree, &points, beside) - here).dot(towards).abs() / 1e-6;
                prop_assert!(slope < 0.01, "{}", slope);
            }
        }
    }
}
