//! Method `certified` where it is hard: offsets, copies, seams, ridges; and
//! its budgets, limits and reports.

use crate::support::fixtures::peaked_sheet;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::{
    CertifiedDetails, DistanceOptions, DistanceResult, Engine, PreparedModel, Stop,
};
use nurbs_hausdorff::internals::progress::{Monitor, NoMonitor};
use nurbs_hausdorff::shapes::operations::{cut_model, elevate_degree, insert_knot, transformed};
use nurbs_hausdorff::shapes::{shape, sphere, sphere_parts, torus};
use nurbs_hausdorff::{Axis, CertifiedOptions, Method, Model, RigidTransform, SurfaceArrays};

/// Rounding of the truths below, of size 0 to 10.
const ROUNDING: f64 = 1e-12;

fn measure(a: &Model, b: &Model, options: &DistanceOptions, monitor: &mut dyn Monitor) -> DistanceResult {
    let engine = Engine::cpu();
    let (a, b) = (PreparedModel::new(a).unwrap(), PreparedModel::new(b).unwrap());
    engine.distance(&a, &b, options).monitored(monitor).wait().unwrap()
}

fn details(result: &DistanceResult) -> CertifiedDetails {
    result.certified().unwrap()
}

/// Converges, is as narrow as requested, and contains the truth.
fn contains(name: &str, a: &Model, b: &Model, transform: RigidTransform, tolerance: f64, truth: f64) {
    let options =
        DistanceOptions { relative_tolerance: Some(tolerance), transform, ..DistanceOptions::default() };
    let result = measure(a, b, &options, &mut NoMonitor);
    let DistanceResult { lower, upper, .. } = result;
    println!(
        "{name}: [{lower:.9}, {upper:.9}], {} cells, {:.3} s",
        details(&result).cells,
        result.seconds.solve
    );
    assert!(result.converged, "{name}: {:?}", details(&result).stop);
    assert!(upper - lower <= details(&result).tolerance + ROUNDING * result.diagonal, "{name}");
    assert!(
        lower <= truth + ROUNDING && truth - ROUNDING <= upper,
        "{name}: {truth} not in [{lower}, {upper}]"
    );
}

fn turned(axis: DVec3, angle: f64) -> RigidTransform {
    RigidTransform::new(DQuat::from_axis_angle(axis.normalize(), angle), DVec3::ZERO).unwrap()
}

fn at(x: f64, y: f64, z: f64) -> RigidTransform {
    RigidTransform::translation(DVec3::new(x, y, z)).unwrap()
}

// At the default tolerance, which takes each of these up to a second.

#[test]
fn exact_offsets() {
    let [one, larger] = [1.0, 1.1].map(|radius| sphere(DVec3::ZERO, radius).unwrap());
    contains("spheres of 1 and 1.1", &one, &larger, RigidTransform::IDENTITY, 1e-6, 0.1);
    let [thin, thick] = [1.0, 1.05].map(|tube| torus(3.0, tube).unwrap());
    contains("tori of tube 1 and 1.05", &thin, &thick, RigidTransform::IDENTITY, 1e-6, 0.05);
}

#[test]
fn parts_of_exact_offsets() {
    for (name, larger, truth) in [("parts of spheres", 1.1, 0.1), ("parts of a sphere", 1.0, 0.0)] {
        let [a, b] = sphere_parts([1.0, larger]).unwrap();
        contains(name, &a, &b, RigidTransform::IDENTITY, 1e-6, truth);
    }
}

#[test]
fn other_seams_and_poles() {
    let [one, larger] = [1.0, 1.25].map(|radius| sphere(DVec3::ZERO, radius).unwrap());
    let transform = turned(DVec3::new(1.0, 2.0, 3.0), 0.7);
    contains("a sphere turned", &one, &one, transform, 1e-6, 0.0);
    contains("a sphere turned in a larger", &one, &larger, transform, 1e-6, 0.25);
    contains("a sphere turned around a smaller", &larger, &one, transform, 1e-6, 0.25);
    let ring = torus(3.0, 1.0).unwrap();
    contains(
        "a torus turned about its axis",
        &ring,
        &ring,
        turned(DVec3::Z, 1.0_f64.to_radians()),
        1e-6,
        0.0,
    );
}

#[test]
fn copies() {
    let sheet = shape("wavy-sheet").unwrap();
    let [[start, end], _] = sheet.surfaces()[0].domain().intervals();
    let refined = insert_knot(&sheet.surfaces()[0], Axis::U, start + 0.63 * (end - start), 1).unwrap();
    let elevated = Model::new(None, vec![elevate_degree(&refined, Axis::V).unwrap()]).unwrap();
    let cut = cut_model(&sheet, [&[0.21, 0.77], &[0.43]]).unwrap();
    let identity = RigidTransform::IDENTITY;
    contains("a sheet", &sheet, &sheet, identity, 1e-6, 0.0);
    contains("a sheet and its refined copy", &sheet, &elevated, identity, 1e-6, 0.0);
    contains("a refined copy and its sheet", &elevated, &sheet, identity, 1e-6, 0.0);
    contains("a sheet and its pieces", &sheet, &cut, identity, 1e-6, 0.0);
    contains("pieces and their sheet", &cut, &sheet, identity, 1e-6, 0.0);
}

#[test]
fn a_ridge_between_two_sheets() {
    // A flat square midway between two: every point is on the medial axis.
    let plane = |height: f64| {
        let wide = shape("fig5-plane").unwrap();
        transformed(&wide, &at(0.0, 0.0, height)).unwrap().surfaces()[0].clone()
    };
    let two = Model::new(None, vec![plane(30.0), plane(-30.0)]).unwrap();
    let middle = Model::new(None, vec![plane(0.0)]).unwrap();
    contains("between two sheets", &middle, &two, RigidTransform::IDENTITY, 1e-6, 30.0);
    contains("two sheets to one between", &two, &middle, RigidTransform::IDENTITY, 1e-6, 30.0);
}

#[test]
fn far_from_the_origin_and_tiny() {
    for (scale, shift) in [(1.0, 1e6), (1e-3, 1e3), (1e5, 1e6)] {
        let center = DVec3::new(shift, -shift, 0.5 * shift);
        let [one, larger] = [1.0, 1.5].map(|radius| sphere(center, scale * radius).unwrap());
        let options = DistanceOptions { relative_tolerance: Some(1e-3), ..DistanceOptions::default() };
        let result = measure(&one, &larger, &options, &mut NoMonitor);
        // The control points themselves are rounded.
        let rounding = 4.0 * f64::EPSILON * shift;
        assert!(result.converged && result.upper - result.lower <= 2e-3 * result.diagonal);
        assert!(result.lower <= 0.5 * scale + rounding && 0.5 * scale - rounding <= result.upper, "{scale}");
    }
}

#[test]
fn budgets_end_with_an_honest_interval_and_the_reason() {
    let [one, larger] = sphere_parts([1.0, 1.1]).unwrap();
    let budgets = [
        (
            DistanceOptions {
                method: Method::Certified(CertifiedOptions { max_cells: Some(2000), ..Default::default() }),
                ..DistanceOptions::default()
            },
            Stop::Cells,
        ),
        (
            DistanceOptions {
                method: Method::Certified(CertifiedOptions { max_seconds: Some(0.02), ..Default::default() }),
                relative_tolerance: Some(1e-9),
                ..DistanceOptions::default()
            },
            Stop::Time,
        ),
    ];
    for (options, stop) in budgets {
        let result = measure(&one, &larger, &options, &mut NoMonitor);
        assert!(!result.converged);
        assert_eq!(details(&result).stop, stop);
        let Method::Certified(CertifiedOptions { max_cells, .. }) = options.method else { unreachable!() };
        assert!(max_cells.is_none_or(|most| details(&result).cells <= most), "{result:?}");
        assert!(result.lower <= 0.1 + ROUNDING && 0.1 - ROUNDING <= result.upper);
        assert!(result.upper.is_finite());
    }
}

#[test]
fn a_limit_is_decided_sooner_than_the_distance() {
    let [one, larger] = sphere_parts([1.0, 1.1]).unwrap();
    let ask = |limit: Option<f64>| {
        let options = DistanceOptions { limit, relative_tolerance: Some(1e-5), ..DistanceOptions::default() };
        details(&measure(&one, &larger, &options, &mut NoMonitor))
    };
    let whole = ask(None);
    assert_eq!(whole.within, None);
    for (limit, within) in [(0.12, true), (0.08, false)] {
        let decided = ask(Some(limit));
        assert_eq!(decided.within, Some(within));
        assert!(decided.cells * 5 < whole.cells, "{} of {} cells", decided.cells, whole.cells);
    }
    // A limit inside the final interval cannot be decided.
    let options =
        DistanceOptions { limit: Some(0.1), relative_tolerance: Some(1e-3), ..DistanceOptions::default() };
    let result = measure(&one, &larger, &options, &mut NoMonitor);
    assert_eq!((details(&result).within, result.converged), (None, false));
}

/// Notes intervals and cancels after some.
struct Watch {
    intervals: Vec<[f64; 2]>,
    most: usize,
}

impl Monitor for Watch {
    fn progress(&mut self, fraction: f64) {
        assert!((0.0..=1.0).contains(&fraction));
    }

    fn interval(&mut self, lower: f64, upper: f64) {
        self.intervals.push([lower, upper]);
    }

    fn cancelled(&self) -> bool {
        self.intervals.len() >= self.most
    }
}

#[test]
fn the_interval_never_widens_and_cancelling_returns_it() {
    let [one, larger] = sphere_parts([1.0, 1.1]).unwrap();
    let options = DistanceOptions { relative_tolerance: Some(1e-8), ..DistanceOptions::default() };
    let mut watch = Watch { intervals: Vec::new(), most: 8 };
    let result = measure(&one, &larger, &options, &mut watch);
    assert_eq!(details(&result).stop, Stop::Cancelled);
    assert!(!result.converged);
    for pair in watch.intervals.windows(2) {
        assert!(pair[0][0] <= pair[1][0] && pair[1][1] <= pair[0][1], "{pair:?}");
    }
    assert_eq!(watch.intervals.last(), Some(&[result.lower, result.upper]));
    assert!(result.lower <= 0.1 + ROUNDING && 0.1 - ROUNDING <= result.upper);
}

/// Notes whether the search has stalled.
#[derive(Default)]
struct StallWatch(Vec<bool>);

impl Monitor for StallWatch {
    fn progress(&mut self, _fraction: f64) {}

    fn stalled(&mut self, stalled: bool) {
        self.0.push(stalled);
    }

    fn cancelled(&self) -> bool {
        false
    }
}

#[test]
fn a_search_that_gains_nothing_says_so() {
    let even = peaked_sheet(1.0);
    // Reports come by time: many cells, so that some come after the last halving.
    let options = DistanceOptions {
        method: Method::Certified(CertifiedOptions { max_cells: Some(200_000), ..Default::default() }),
        ..DistanceOptions::default()
    };
    let stalled = |a: &Model, b: &Model, tolerance: f64| {
        let mut watch = StallWatch::default();
        measure(a, b, &DistanceOptions { relative_tolerance: Some(tolerance), ..options }, &mut watch);
        watch.0
    };
    let seen = stalled(&peaked_sheet(1e8), &even, 1e-6);
    // The last call is at the end, where nothing is stalled any more.
    assert!(!seen[0] && seen.contains(&true) && !seen[seen.len() - 1], "{seen:?}");
    let [one, other] = ["wavy-sheet", "wavy-sheet-b"].map(|name| shape(name).unwrap());
    assert!(stalled(&one, &other, 1e-6).iter().all(|stalled| !stalled));
}

#[test]
fn the_symmetric_interval_is_that_of_the_larger_direction() {
    let corner = |x: f64, y: f64| [20.0 * x, 20.0 * y, 0.0, 1.0];
    let square = SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: vec![corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, -1.0), corner(1.0, 1.0)],
    };
    let square = Model::from_arrays(None, vec![square]).unwrap();
    let ball = sphere(DVec3::ZERO, 10.0).unwrap();
    let options = DistanceOptions { symmetric: true, ..DistanceOptions::default() };
    let result = measure(&square, &ball, &options, &mut NoMonitor);
    let (forward, reverse) = (result.forward.unwrap(), result.reverse.unwrap());
    // From the square's corner; from the ball's poles, its middle being on the square.
    let corner = 20.0 * 2.0_f64.sqrt() - 10.0;
    for (directed, truth) in [(&forward, corner), (&reverse, 10.0)] {
        assert!(directed.lower <= truth + ROUNDING && truth - ROUNDING <= directed.upper, "{truth}");
    }
    assert_eq!((result.lower, result.upper), (forward.lower, forward.upper));
}

#[test]
fn statistics_of_a_constant_deviation_are_that_constant() {
    let [one, larger] = [1.0, 1.5].map(|radius| sphere(DVec3::ZERO, radius).unwrap());
    let options =
        DistanceOptions { deviations: true, relative_tolerance: Some(1e-3), ..DistanceOptions::default() };
    let result = measure(&one, &larger, &options, &mut NoMonitor);
    let statistics = result.statistics.unwrap();
    for value in [statistics.mean, statistics.rms, statistics.median, statistics.percentile_95] {
        assert!((value - 0.5).abs() < 1e-9, "{value}");
    }
    // Inside the larger sphere, whose normals point outward.
    assert!((statistics.signed_mean + 0.5).abs() < 1e-9, "{}", statistics.signed_mean);
    // The trapezoid rule on 64 x 64 samples.
    assert!((statistics.area / (4.0 * std::f64::consts::PI) - 1.0).abs() < 2e-3, "{}", statistics.area);
}

/// Beside itself at this place, every point of the bottle is at most as far
/// from it as it was moved, and points where its normal is along that way are
/// just as far. On flat patches with two valleys an iteration finds the wrong
/// one, which is a little farther.
#[test]
fn patches_with_two_valleys() {
    let bottle = shape("bottle").unwrap();
    let way = DVec3::new(0.617290145616294, 0.26343211649303505, 0.19757408736977627);
    for tolerance in [1e-4, 1e-5, 1e-6, 1e-8] {
        contains(
            "a bottle beside itself",
            &bottle,
            &bottle,
            at(way.x, way.y, way.z),
            tolerance,
            way.length(),
        );
    }
}

/// A surface that jumps at the knot ½ in u and in v: over each quarter a plane that rises by these slopes.
fn jumping(slopes: [f64; 4]) -> Model {
    let knots = vec![0.0, 0.0, 0.5, 0.5, 1.0, 1.0];
    let places = [(0.0, 0), (0.5, 0), (0.5, 1), (1.0, 1)];
    let control_points = places.iter().flat_map(|&(x, row)| {
        places.iter().map(move |&(y, column)| {
            let slope = slopes[2 * row + column];
            [x, y, slope * (x + y), 1.0]
        })
    });
    let arrays = SurfaceArrays {
        degree: [1, 1],
        knots: [knots.clone(), knots],
        counts: [4, 4],
        control_points: control_points.collect(),
    };
    Model::from_arrays(None, vec![arrays]).unwrap()
}

/// Where a surface jumps, the witness's parameters are those of its own side: the surface there is at its point.
#[test]
fn parameters_at_a_jump_are_of_the_points_side() {
    let flat = jumping([0.0; 4]);
    for (slopes, end) in [
        ([1.0, 0.0, 0.0, 0.0], [0.5, 0.5]),
        ([0.0, 1.0, 0.0, 0.0], [0.5, 1.0]),
        ([0.0, 0.0, 1.0, 0.0], [1.0, 0.5]),
        ([0.0, 0.0, 0.0, 1.0], [1.0, 1.0]),
    ] {
        let steep = jumping(slopes);
        let result = measure(&steep, &flat, &DistanceOptions::default(), &mut NoMonitor);
        let witness = &result.witness.a;
        assert!((result.lower - (end[0] + end[1])).abs() < 1e-5, "{slopes:?}: {}", result.lower);
        for (parameter, end) in [witness.u, witness.v].into_iter().zip(end) {
            assert!((parameter - end).abs() < 1e-9, "{slopes:?}: {witness:?}");
        }
        let point = DVec3::from_array(steep.surfaces()[0].point([witness.u, witness.v]));
        assert!(point.distance(DVec3::from_array(witness.point)) < 1e-9, "{slopes:?}: {witness:?}");
    }
}
