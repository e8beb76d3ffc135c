//! The intervals of method `hierarchy` against distances known from geometry, on both backends.

use crate::support::fixtures::{model, square, translation, turned};
use crate::support::gpu::{engine, measure};
use glam::DVec3;
use nurbs_hausdorff::internals::engine::{
    Backend, DistanceOptions, DistanceResult, Engine, MethodName, PreparedModel, Processor,
};
use nurbs_hausdorff::internals::progress::Monitor;
use nurbs_hausdorff::shapes::operations::transformed;
use nurbs_hausdorff::shapes::{figure5_cylinder, figure5_plane, shape, sphere};
use nurbs_hausdorff::{Error, HierarchyOptions, Method, Model, RigidTransform};

/// Rounding of a distance of models of size 1 to 10 in float64.
const ROUNDING: f64 = 1e-9;

fn hierarchy() -> DistanceOptions {
    DistanceOptions { method: MethodName::Hierarchy.into(), ..DistanceOptions::default() }
}

/// Runs on both backends; the interval must contain the truth.
fn on_both(test: &str, a: &Model, b: &Model, options: &DistanceOptions, truth: f64) -> Vec<DistanceResult> {
    let Some(engine) = engine(test) else { return Vec::new() };
    [Backend::Gpu, Backend::Cpu]
        .map(|backend| {
            let result = measure(&engine, a, b, &DistanceOptions { backend, ..options.clone() });
            let contains = result.lower <= truth && truth <= result.upper;
            assert!(contains, "{backend:?}: {truth} not in [{}, {}]", result.lower, result.upper);
            assert!(result.lower <= result.computed && result.computed <= result.upper, "{backend:?}");
            let [a, b] = [&result.witness.a, &result.witness.b].map(|end| DVec3::from_array(end.point));
            assert_eq!(result.computed, a.distance(b));
            result
        })
        .into()
}

#[test]
fn parallel_planes_are_their_heights_apart() {
    let (a, b) = (model(vec![square(0.0, 0.0)]), model(vec![square(0.0, 3.0)]));
    for result in on_both("parallel_planes", &a, &b, &hierarchy(), 3.0) {
        // Flat boxes of side 1/64, so at most the diagonal of two of them off.
        let most = (9.0 + 2.0 * (2.0_f64 / 64.0).powi(2)).sqrt();
        assert!(result.upper <= most + 1e-4, "{}", result.upper);
        assert!(result.lower >= 3.0 - 1e-4, "{}", result.lower);
        assert_eq!(result.hierarchy().unwrap().levels, 7);
    }
}

#[test]
fn spheres_are_known() {
    let [a, b] = [1.0, 1.5].map(|radius| sphere(DVec3::ZERO, radius).unwrap());
    on_both("concentric_spheres", &a, &b, &hierarchy(), 0.5);
    on_both("a_turned_sphere", &a, &b, &DistanceOptions { transform: rotation(), ..hierarchy() }, 0.5);
    let options = DistanceOptions { transform: translation(0.0, 0.3, 0.75), symmetric: true, ..hierarchy() };
    let moved = 0.75_f64.hypot(0.3);
    for result in on_both("a_moved_sphere", &a, &a, &options, moved) {
        let both: Vec<u64> = result.hierarchy().unwrap().pairs.clone();
        let (forward, reverse) = (result.forward.unwrap(), result.reverse.unwrap());
        assert_eq!(result.lower, forward.lower.max(reverse.lower));
        assert_eq!(result.upper, forward.upper.max(reverse.upper));
        // Named by model, in B's frame.
        let [on_a, on_b] = [&reverse.witness.a, &reverse.witness.b].map(|end| DVec3::from_array(end.point));
        assert!(((on_a - DVec3::new(0.0, 0.3, 0.75)).length() - 1.0).abs() < ROUNDING);
        assert!((on_b.length() - 1.0).abs() < ROUNDING);
        let pairs = [forward, reverse].map(|directed| directed.hierarchy().unwrap().pairs[6]);
        assert_eq!(both[6], pairs[0] + pairs[1]);
    }
}

fn rotation() -> RigidTransform {
    RigidTransform::new(turned().rotation(), DVec3::ZERO).unwrap()
}

#[test]
fn figure_5_of_the_paper() {
    let (plane, cylinder) = (figure5_plane().unwrap(), figure5_cylinder().unwrap());
    on_both("figure_5", &plane, &cylinder, &hierarchy(), 320.0);
}

#[test]
fn a_model_is_at_distance_0_from_itself() {
    for name in ["wavy-sheet", "glass"] {
        let this = shape(name).unwrap();
        for result in on_both(
            name,
            &this,
            &this,
            &DistanceOptions {
                method: Method::Hierarchy(HierarchyOptions { grid: 24, ..Default::default() }),
                ..hierarchy()
            },
            0.0,
        ) {
            assert_eq!(result.lower, 0.0);
            assert!(!result.converged);
        }
    }
}

#[test]
fn moving_by_the_option_is_moving_the_control_points() {
    let (a, b) = (shape("wavy-sheet").unwrap(), shape("wavy-sheet-b").unwrap());
    let transform = turned();
    let Some(engine) = engine("moving_by_the_option") else { return };
    for backend in [Backend::Gpu, Backend::Cpu] {
        let options = DistanceOptions {
            method: Method::Hierarchy(HierarchyOptions { grid: 32, ..Default::default() }),
            backend,
            ..hierarchy()
        };
        let by_option = measure(&engine, &a, &b, &DistanceOptions { transform, ..options.clone() });
        let by_points = measure(&engine, &transformed(&a, &transform).unwrap(), &b, &options);
        // Bounds of derivatives depend on the frame by a little.
        assert!((by_option.lower - by_points.lower).abs() < 1e-3 * by_option.diagonal);
        assert!((by_option.upper - by_points.upper).abs() < 1e-3 * by_option.diagonal);
    }
}

#[test]
fn models_far_from_the_origin_are_bounded_as_well() {
    let away = DVec3::new(3e5, -1e6, 2e5);
    let [a, b] = [1.0, 1.5].map(|radius| sphere(DVec3::ZERO, radius).unwrap());
    let [far_a, far_b] = [1.0, 1.5].map(|radius| sphere(away, radius).unwrap());
    let near = on_both("near", &a, &b, &hierarchy(), 0.5);
    let far = on_both("far", &far_a, &far_b, &hierarchy(), 0.5);
    // A at the origin, moved to B far away.
    let transform = RigidTransform::translation(away).unwrap();
    let moved = on_both("moved", &a, &far_b, &DistanceOptions { transform, ..hierarchy() }, 0.5);
    for ((near, far), moved) in near.iter().zip(&far).zip(&moved) {
        for other in [far, moved] {
            assert!((near.lower - other.lower).abs() < 1e-4, "{} {}", near.lower, other.lower);
            assert!((near.upper - other.upper).abs() < 1e-4, "{} {}", near.upper, other.upper);
        }
    }
}

#[test]
fn the_interval_narrows_with_the_square_of_the_cells() {
    // Where the distance is large against the cells and the farthest boxes lie
    // flat to an axis, as the spheres' poles, boxes are thick by their growth alone.
    let ball = sphere(DVec3::ZERO, 1.0).unwrap();
    let away = DistanceOptions { transform: translation(0.0, 0.0, 20.0), ..hierarchy() };
    let width = |backend: Backend, options: &DistanceOptions, b: &Model, grid: usize| {
        let engine = Engine::new_blocking(backend).unwrap();
        let result = measure(
            &engine,
            &ball,
            b,
            &DistanceOptions {
                method: Method::Hierarchy(HierarchyOptions { grid, ..Default::default() }),
                backend,
                ..options.clone()
            },
        );
        result.upper - result.lower
    };
    let [coarse, fine] = [16, 128].map(|grid| width(Backend::Cpu, &away, &ball, grid));
    let order = (coarse / fine).log2() / 3.0;
    assert!((1.8..2.2).contains(&order), "{coarse} {fine}: order {order}");
    // In between boxes stand askew, and are as thick as they are wide.
    let larger = sphere(DVec3::ZERO, 1.5).unwrap();
    let [coarse, fine] = [16, 128].map(|grid| width(Backend::Cpu, &hierarchy(), &larger, grid));
    let order = (coarse / fine).log2() / 3.0;
    assert!((0.8..1.6).contains(&order), "{coarse} {fine}: order {order}");
}

#[test]
fn both_backends_descend_alike() {
    let Some(engine) = engine("both_backends_descend_alike") else { return };
    let pairs =
        [("sphere", "torus"), ("wavy-sheet", "wavy-sheet-b"), ("glass", "bottle"), ("cone", "cylinder")];
    for (a, b) in pairs {
        let (a, b) = (shape(a).unwrap(), shape(b).unwrap());
        for grid in [7, 64] {
            let options = DistanceOptions {
                method: Method::Hierarchy(HierarchyOptions { grid, ..Default::default() }),
                transform: turned(),
                ..hierarchy()
            };
            let on = |backend| measure(&engine, &a, &b, &DistanceOptions { backend, ..options.clone() });
            let (gpu, cpu) = (on(Backend::Gpu), on(Backend::Cpu));
            assert_eq!((gpu.backend, cpu.backend), (Processor::Gpu, Processor::Cpu));
            // Boxes of the GPU contain those of the CPU, and not much more.
            let room = 2e-4 * cpu.diagonal;
            assert!(gpu.lower <= cpu.lower && cpu.lower - gpu.lower < room, "{} {}", gpu.lower, cpu.lower);
            assert!(gpu.upper >= cpu.upper && gpu.upper - cpu.upper < room, "{} {}", gpu.upper, cpu.upper);
            let (gpu, cpu) = (gpu.hierarchy().unwrap(), cpu.hierarchy().unwrap());
            assert_eq!((gpu.grid, gpu.levels), (cpu.grid, cpu.levels));
            for (gpu, cpu) in gpu.pairs.iter().zip(&cpu.pairs) {
                assert!(gpu.abs_diff(*cpu) <= 2 + cpu / 20, "{gpu} {cpu}");
            }
        }
    }
}

#[test]
fn the_farthest_cell_is_on_the_surface_that_is_the_farthest() {
    // Seven tiles, one of them raised, over one sheet: trees of unequal depth.
    let tiles = |raised: Option<usize>| {
        let height = |tile| if Some(tile) == raised { 0.5 } else { 0.0 };
        model((0..7).map(|tile| square(tile as f64, height(tile))).collect())
    };
    let corners = [[-1.0, -1.0], [-1.0, 2.0], [8.0, -1.0], [8.0, 2.0]];
    let mut sheet = square(0.0, 0.0);
    sheet.control_points = corners.map(|[x, y]| [x, y, 0.0, 1.0]).into();
    let sheet = model(vec![sheet]);
    for raised in [0, 3, 6] {
        for result in on_both("tiles", &tiles(Some(raised)), &sheet, &hierarchy(), 0.5) {
            assert_eq!(result.witness.a.face, raised);
            assert_eq!(result.witness.b.face, 0);
        }
        let reversed = on_both(
            "reversed",
            &sheet,
            &tiles(Some(raised)),
            &DistanceOptions {
                method: Method::Hierarchy(HierarchyOptions { grid: 8, ..Default::default() }),
                ..hierarchy()
            },
            {
                // From the sheet's corner to the nearest corner of the row, or over the raised tile.
                let corner = 2.0_f64.sqrt();
                if raised == 3 { corner } else { (2.0_f64 + 0.25).sqrt() }
            },
        );
        assert!(reversed.iter().all(|result| result.witness.a.face == 0));
    }
}

#[test]
fn a_budget_of_memory_ends_the_descent_with_the_pairs_wanted() {
    let Some(engine) = engine("a_budget_of_memory") else { return };
    let ball = PreparedModel::new(&sphere(DVec3::ZERO, 1.0).unwrap()).unwrap();
    let requested = [Backend::Gpu, Backend::Cpu].map(|backend| {
        let run = |memory_budget| {
            let options = DistanceOptions {
                method: Method::Hierarchy(HierarchyOptions { memory_budget, grid: 128 }),
                backend,
                ..hierarchy()
            };
            engine.distance(&ball, &ball, &options).wait()
        };
        let error = run(1).unwrap_err();
        assert_eq!(error.code(), "PAIR_BUDGET_EXCEEDED");
        let text = error.to_string();
        let Error::PairBudgetExceeded { level, found, expected, mebibytes } = error else { panic!("{text}") };
        // Two lists of pairs of 8 bytes.
        assert_eq!((expected, mebibytes), ((1 << 20) / 16, 1));
        assert!(found > expected && text.contains(&format!("requires {found} pairs")), "{text}");
        // With room for it the level has as many pairs as were required.
        let pairs = run(256).unwrap().hierarchy().unwrap().pairs.clone();
        assert_eq!(pairs[level], found);
        assert!(pairs[..level].iter().all(|&pairs| pairs <= expected));
        found
    });
    assert!(requested[0].abs_diff(requested[1]) < requested[1] / 20, "{requested:?}");
}

#[test]
fn options_out_of_range_are_named() {
    let engine = Engine::cpu();
    let many = PreparedModel::new(&model((0..5).map(|x| square(f64::from(x), 0.0)).collect())).unwrap();
    let refused = |options: DistanceOptions| match engine.distance(&many, &many, &options).wait().unwrap_err()
    {
        Error::OptionOutOfRange { option, found, .. } => (option, found),
        other => panic!("{other}"),
    };
    assert_eq!(
        refused(DistanceOptions {
            method: Method::Hierarchy(HierarchyOptions { grid: 1, ..Default::default() }),
            ..hierarchy()
        }),
        ("grid", "1".to_owned())
    );
    assert_eq!(
        refused(DistanceOptions {
            method: Method::Hierarchy(HierarchyOptions { grid: 1025, ..Default::default() }),
            ..hierarchy()
        }),
        ("grid", "1025".to_owned())
    );
    // Five million cells.
    assert_eq!(
        refused(DistanceOptions {
            method: Method::Hierarchy(HierarchyOptions { grid: 1024, ..Default::default() }),
            ..hierarchy()
        }),
        ("grid", "1024".to_owned())
    );
    assert_eq!(
        refused(DistanceOptions {
            method: Method::Hierarchy(HierarchyOptions { memory_budget: 0, ..Default::default() }),
            ..hierarchy()
        })
        .0,
        "memory budget"
    );
    assert_eq!(
        refused(DistanceOptions {
            method: Method::Hierarchy(HierarchyOptions { memory_budget: 257, ..Default::default() }),
            ..hierarchy()
        })
        .0,
        "memory budget"
    );
}

/// Records its calls, and cancels once the progress passes a fraction.
#[derive(Default)]
struct Watch {
    cancel_at: Option<f64>,
    fractions: Vec<f64>,
    intervals: Vec<[f64; 2]>,
}

impl Monitor for Watch {
    fn progress(&mut self, fraction: f64) {
        self.fractions.push(fraction);
    }

    fn interval(&mut self, lower: f64, upper: f64) {
        self.intervals.push([lower, upper]);
    }

    fn cancelled(&self) -> bool {
        self.cancel_at.is_some_and(|at| self.fractions.last().is_some_and(|&fraction| fraction >= at))
    }
}

#[test]
fn progress_rises_intervals_narrow_and_cancelling_stops_on_the_way() {
    let Some(engine) = engine("progress_rises") else { return };
    let ball = PreparedModel::new(&sphere(DVec3::ZERO, 1.0).unwrap()).unwrap();
    for backend in [Backend::Gpu, Backend::Cpu] {
        let options = DistanceOptions {
            method: Method::Hierarchy(HierarchyOptions { grid: 128, ..Default::default() }),
            backend,
            transform: translation(0.0, 0.0, 0.5),
            ..hierarchy()
        };
        let mut watch = Watch::default();
        let result = engine.distance(&ball, &ball, &options).monitored(&mut watch).wait().unwrap();
        assert!(watch.fractions.windows(2).all(|pair| pair[0] <= pair[1]), "{:?}", watch.fractions);
        assert_eq!(watch.fractions.last(), Some(&1.0));
        let narrows = |pair: &[[f64; 2]]| pair[0][0] <= pair[1][0] && pair[1][1] <= pair[0][1];
        assert!(watch.intervals.windows(2).all(narrows), "{:?}", watch.intervals);
        assert_eq!(watch.intervals.last(), Some(&[result.lower, result.upper]));
        let mut watch = Watch { cancel_at: Some(0.0), ..Watch::default() };
        let cancelled = engine.distance(&ball, &ball, &options).monitored(&mut watch).wait();
        assert_eq!(cancelled.unwrap_err(), Error::Cancelled);
    }
}
