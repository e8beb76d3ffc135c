//! Method `iteration` against distances known from geometry, on both backends.

use crate::support::gpu::{engine, measure};
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::closest::Projection;
use nurbs_hausdorff::internals::engine::{
    Backend, DistanceOptions, DistanceResult, Engine, MethodName, PreparedModel,
};
use nurbs_hausdorff::internals::progress::Monitor;
use nurbs_hausdorff::shapes::operations::{elevate_degree, insert_knot, transformed};
use nurbs_hausdorff::shapes::{FIGURE5_SAMPLES, figure5_cylinder, figure5_plane, shape, sphere};
use nurbs_hausdorff::{
    Axis, CertifiedOptions, Error, IterationOptions, Method, Model, RigidTransform, SurfaceArrays,
};

/// Rounding of a distance of models of size 1 to 10 in float64.
const ROUNDING: f64 = 1e-9;

fn iteration() -> DistanceOptions {
    DistanceOptions { method: MethodName::Iteration.into(), ..DistanceOptions::default() }
}

fn translation(x: f64, y: f64, z: f64) -> RigidTransform {
    RigidTransform::translation(DVec3::new(x, y, z)).unwrap()
}

/// Runs on both backends; the interval must contain the truth.
fn on_both(test: &str, a: &Model, b: &Model, options: &DistanceOptions, truth: f64) -> Vec<DistanceResult> {
    let Some(engine) = engine(test) else { return Vec::new() };
    [Backend::Gpu, Backend::Cpu]
        .map(|backend| {
            let result = measure(&engine, a, b, &DistanceOptions { backend, ..options.clone() });
            let contains = result.lower <= truth + ROUNDING && truth - ROUNDING <= result.upper;
            assert!(contains, "{backend:?}: {truth} not in [{}, {}]", result.lower, result.upper);
            assert!(result.lower <= result.computed && result.computed <= result.upper);
            assert!(result.converged, "{backend:?}");
            result
        })
        .into()
}

fn plane(height: f64) -> Model {
    let corner = |x: f64, y: f64| [x, y, height, 1.0];
    let arrays = SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: vec![corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, -1.0), corner(1.0, 1.0)],
    };
    Model::from_arrays(None, vec![arrays]).unwrap()
}

#[test]
fn parallel_planes_are_their_heights_apart() {
    for result in on_both("parallel_planes", &plane(0.0), &plane(3.0), &iteration(), 3.0) {
        assert!((result.computed - 3.0).abs() < ROUNDING);
    }
}

#[test]
fn concentric_spheres_are_their_radii_apart() {
    let [a, b] = [1.0, 1.5].map(|radius| sphere(DVec3::ZERO, radius).unwrap());
    let options = DistanceOptions { symmetric: true, ..iteration() };
    for result in on_both("concentric_spheres", &a, &b, &options, 0.5) {
        assert!((result.computed - 0.5).abs() < ROUNDING, "{}", result.computed);
        let (forward, reverse) = (result.forward.unwrap(), result.reverse.unwrap());
        assert_eq!(result.computed, forward.computed.max(reverse.computed));
        assert_eq!(result.upper, forward.upper.max(reverse.upper));
    }
}

#[test]
fn a_sphere_moved_along_the_axis_is_as_far_as_it_moved() {
    let ball = sphere(DVec3::ZERO, 1.0).unwrap();
    let options = DistanceOptions { transform: translation(0.0, 0.0, 0.75), symmetric: true, ..iteration() };
    // The pole is a sample, and the farthest point of the moved sphere.
    for result in on_both("a_sphere_moved", &ball, &ball, &options, 0.75) {
        assert!((result.computed - 0.75).abs() < ROUNDING, "{}", result.computed);
        let reverse = result.reverse.unwrap();
        let ends = [reverse.witness.a.point, reverse.witness.b.point].map(DVec3::from_array);
        assert!((ends[0].distance(ends[1]) - 0.75).abs() < ROUNDING);
        // Named by model, in B's frame: b on the sphere about the origin, a on the moved one.
        assert!((ends[1].length() - 1.0).abs() < ROUNDING);
        assert!(((ends[0] - DVec3::Z * 0.75).length() - 1.0).abs() < ROUNDING);
    }
}

#[test]
fn turning_a_sphere_about_its_middle_changes_nothing() {
    let [a, b] = [1.0, 1.5].map(|radius| sphere(DVec3::ZERO, radius).unwrap());
    let rotation = DQuat::from_axis_angle(DVec3::new(1.0, -2.0, 0.5).normalize(), 0.8);
    let transform = RigidTransform::new(rotation, DVec3::ZERO).unwrap();
    for result in on_both("turning_a_sphere", &a, &b, &DistanceOptions { transform, ..iteration() }, 0.5) {
        assert!((result.computed - 0.5).abs() < ROUNDING, "{}", result.computed);
    }
}

#[test]
fn moving_by_the_option_is_moving_the_control_points() {
    let rotation = DQuat::from_axis_angle(DVec3::new(0.3, 0.4, 1.0).normalize(), 0.6);
    let transform = RigidTransform::new(rotation, DVec3::new(0.5, 0.1, -0.3)).unwrap();
    let (a, b) = (shape("wavy-sheet").unwrap(), shape("wavy-sheet-b").unwrap());
    let Some(engine) = engine("moving_by_the_option") else { return };
    let by_option = measure(&engine, &a, &b, &DistanceOptions { transform, ..iteration() });
    let by_points = measure(&engine, &transformed(&a, &transform).unwrap(), &b, &iteration());
    assert!((by_option.computed - by_points.computed).abs() < ROUNDING);
}

#[test]
fn refined_and_elevated_copies_are_at_distance_zero() {
    let sheet = shape("wavy-sheet").unwrap();
    let [[start, end], _] = sheet.surfaces()[0].domain().intervals();
    let refined = insert_knot(&sheet.surfaces()[0], Axis::U, start + 0.37 * (end - start), 1).unwrap();
    let elevated = Model::new(None, vec![elevate_degree(&refined, Axis::V).unwrap()]).unwrap();
    for (a, b) in [(&sheet, &elevated), (&elevated, &sheet), (&sheet, &sheet)] {
        for result in on_both("copies", a, b, &iteration(), 0.0) {
            assert!(result.computed <= ROUNDING, "{}", result.computed);
        }
    }
}

#[test]
fn points_at_the_centre_of_curvature_find_the_nearest_point() {
    // From a square through a ball's centre, the centre is farthest from the
    // ball's surface: exactly the radius of curvature away, where the
    // tangent-plane step no longer contracts, with every point equally near.
    let square = plane(0.0);
    let ball = sphere(DVec3::ZERO, 4.0).unwrap();
    for result in
        on_both("points_on_the_axis", &square, &ball, &DistanceOptions { samples: 65, ..iteration() }, 4.0)
    {
        assert!((result.computed - 4.0).abs() < ROUNDING, "{}", result.computed);
    }
}

#[test]
fn figure_5_of_the_paper() {
    let (plane, cylinder) = (figure5_plane().unwrap(), figure5_cylinder().unwrap());
    for projection in [Projection::Newton, Projection::TangentPlane] {
        let options = DistanceOptions {
            method: Method::Iteration(IterationOptions { projection, ..Default::default() }),
            samples: FIGURE5_SAMPLES,
            ..iteration()
        };
        let Some(engine) = engine("figure_5") else { return };
        for backend in [Backend::Gpu, Backend::Cpu] {
            let result = measure(&engine, &plane, &cylinder, &DistanceOptions { backend, ..options.clone() });
            let bounds = result.iteration().unwrap().bounds;
            assert!((result.computed - 310.42).abs() < 0.01, "{}", result.computed);
            // Half the diagonal of a flat cell of side 16.
            assert!((bounds.k_a - 16.0 * 0.5_f64.sqrt()).abs() < 1e-6, "{}", bounds.k_a);
            assert!(result.computed + bounds.k_a >= 320.0);
            assert!(result.lower <= 320.0 && 320.0 <= result.upper);
        }
    }
}

/// Notes progress, and cancels once it passes a fraction.
struct Watch {
    cancel_at: f64,
    seen: Vec<f64>,
}

impl Monitor for Watch {
    fn progress(&mut self, fraction: f64) {
        self.seen.push(fraction);
    }

    fn cancelled(&self) -> bool {
        self.seen.last().is_some_and(|&fraction| fraction >= self.cancel_at)
    }
}

#[test]
fn progress_rises_to_one_and_cancelling_stops_on_the_way() {
    let Some(engine) = engine("progress") else { return };
    let [a, b] = ["bottle", "glass"].map(|name| PreparedModel::new(&shape(name).unwrap()).unwrap());
    for backend in [Backend::Gpu, Backend::Cpu] {
        let options = DistanceOptions { backend, samples: 192, symmetric: true, ..iteration() };
        let mut watch = Watch { cancel_at: 2.0, seen: Vec::new() };
        let whole = engine.distance(&a, &b, &options).monitored(&mut watch).wait().unwrap();
        assert!(watch.seen.windows(2).all(|pair| pair[0] <= pair[1]), "{:?}", watch.seen);
        assert!(watch.seen.len() > 2, "{:?}", watch.seen);
        assert_eq!(watch.seen.last(), Some(&1.0));
        // At the start, and once something is done.
        for cancel_at in [0.0, 0.01] {
            let mut watch = Watch { cancel_at, seen: Vec::new() };
            let cancelled = engine.distance(&a, &b, &options).monitored(&mut watch).wait();
            assert_eq!(cancelled.unwrap_err(), Error::Cancelled);
            // Nothing was done after that.
            let (last, before) = watch.seen.split_last().unwrap();
            assert!(before.iter().all(|&fraction| fraction < cancel_at) && *last < 1.0, "{:?}", watch.seen);
        }
        // What was cancelled leaves the engine as it was.
        let mut watch = Watch { cancel_at: 2.0, seen: Vec::new() };
        let again = engine.distance(&a, &b, &options).monitored(&mut watch).wait().unwrap();
        assert_eq!(again.computed, whole.computed);
    }
}

#[test]
fn options_out_of_range_are_named() {
    let engine = Engine::cpu();
    let model = PreparedModel::new(&plane(0.0)).unwrap();
    let refused = |options: DistanceOptions| {
        let error = engine
            .distance(&model, &model, &options)
            .monitored(&mut Watch { cancel_at: 2.0, seen: vec![] })
            .wait();
        match error.unwrap_err() {
            Error::OptionOutOfRange { option, .. } => option,
            other => panic!("{other}"),
        }
    };
    let base = DistanceOptions::default;
    assert_eq!(refused(DistanceOptions { samples: 1, ..base() }), "samples");
    assert_eq!(refused(DistanceOptions { samples: 1025, ..base() }), "samples");
    assert_eq!(
        refused(DistanceOptions {
            method: Method::Iteration(IterationOptions { iterations: 0, ..Default::default() }),
            ..base()
        }),
        "iterations"
    );
    assert_eq!(
        refused(DistanceOptions {
            method: Method::Iteration(IterationOptions { step_tolerance: 0.0, ..Default::default() }),
            ..base()
        }),
        "step tolerance"
    );
    assert_eq!(
        refused(DistanceOptions { relative_tolerance: Some(f64::NAN), ..base() }),
        "relative tolerance"
    );
    assert_eq!(refused(DistanceOptions { tolerance: Some(0.0), ..base() }), "tolerance");
    assert_eq!(refused(DistanceOptions { limit: Some(-1.0), ..base() }), "limit");
    assert_eq!(
        refused(DistanceOptions {
            method: Method::Certified(CertifiedOptions { max_seconds: Some(0.0), ..Default::default() }),
            ..base()
        }),
        "max seconds"
    );
    assert_eq!(
        refused(DistanceOptions {
            method: Method::Certified(CertifiedOptions { max_cells: Some(0), ..Default::default() }),
            ..base()
        }),
        "max cells"
    );
}

#[test]
fn an_engine_without_a_gpu_refuses_to_pretend() {
    let engine = Engine::cpu();
    let model = PreparedModel::new(&plane(0.0)).unwrap();
    let options = DistanceOptions { backend: Backend::Gpu, ..iteration() };
    let refused = engine
        .distance(&model, &model, &options)
        .monitored(&mut Watch { cancel_at: 2.0, seen: vec![] })
        .wait();
    assert_eq!(refused.unwrap_err().code(), "NO_ADAPTER");
}
