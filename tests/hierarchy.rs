//! Method `hierarchy`: its boxes, its culling, and its intervals.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

mod support;

use glam::{DQuat, DVec3};
use nurbs_hausdorff::bezier::{BezierModel, extract};
use nurbs_hausdorff::bvh::Aabb;
use nurbs_hausdorff::engine::{Backend, DistanceResult, Engine, Method, Options, PreparedModel, Processor};
use nurbs_hausdorff::hierarchy::{
    Cell, Children, Distances, GridTree, MAX_CHILDREN, Pairs, Part, Traversal, boxes, extremes, pyramid,
};
use nurbs_hausdorff::progress::{Monitor, NoMonitor};
use nurbs_hausdorff::shapes::operations::transformed;
use nurbs_hausdorff::shapes::{WavySheet, figure5_cylinder, figure5_plane, shape, sphere, wavy_sheet};
use nurbs_hausdorff::{Error, Model, RigidTransform, SurfaceArrays};
use support::evaluator;
use support::gpu::{engine, measure};

/// Rounding of a distance of models of size 1 to 10 in float64.
const ROUNDING: f64 = 1e-9;

fn hierarchy() -> Options {
    Options { method: Method::Hierarchy, ..Options::default() }
}

fn translation(x: f64, y: f64, z: f64) -> RigidTransform {
    RigidTransform::translation(DVec3::new(x, y, z)).unwrap()
}

fn square(x: f64, height: f64) -> SurfaceArrays {
    let corner = |i: f64, j: f64| [x + i, j, height, 1.0];
    SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: vec![corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 0.0), corner(1.0, 1.0)],
    }
}

fn model(surfaces: Vec<SurfaceArrays>) -> Model {
    Model::from_arrays(None, surfaces).unwrap()
}

/// A quadratic sheet whose double knot leaves it a crease along u = 1, and
/// whose weights differ.
fn creased() -> Model {
    let height = |i: usize| if i == 2 { 1.0 } else { 0.1 * i as f64 };
    let point = |i: usize, j: usize| [i as f64, j as f64, height(i), 1.0 + ((i + j) % 3) as f64];
    let control_points = (0..5).flat_map(|i| (0..4).map(move |j| point(i, j))).collect();
    model(vec![SurfaceArrays {
        degree: [2, 2],
        knots: [vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0], vec![0.0, 0.0, 0.0, 0.3, 1.0, 1.0, 1.0]],
        counts: [5, 4],
        control_points,
    }])
}

/// Many more spans than cells, so that cells have parts by the hundreds.
fn many_spans() -> Model {
    let sheet =
        WavySheet { counts: [43, 40], size: [9.0, 8.0], amplitude: 0.7, waves: [3.0, 4.0], phase: 0.2 };
    wavy_sheet(&sheet).unwrap()
}

fn boxes_of(bezier: &BezierModel, tree: &GridTree, transform: &RigidTransform) -> Vec<Vec<Aabb>> {
    let of_part = |part: &Part| boxes(&bezier.patches.patch(part.patch), part, transform, 0.0);
    pyramid(&tree.levels, tree.parts.iter().map(of_part).collect())
}

fn contains(aabb: &Aabb, point: DVec3) -> bool {
    (aabb.min - ROUNDING).cmple(point).all() && point.cmple(aabb.max + ROUNDING).all()
}

fn turned() -> RigidTransform {
    let rotation = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.8);
    RigidTransform::new(rotation, DVec3::new(0.3, -0.2, 0.1)).unwrap()
}

/// Parameters of the ends of a cell.
fn ends(domain: [f64; 2], place: u32, grid: usize) -> [f64; 2] {
    [place, place + 1].map(|end| {
        let fraction = f64::from(end) / grid as f64;
        (1.0 - fraction) * domain[0] + fraction * domain[1]
    })
}

#[test]
fn boxes_of_cells_contain_their_points() {
    let models = ["sphere", "torus", "wavy-sheet", "glass"].map(|name| shape(name).unwrap());
    for (index, model) in models.into_iter().chain([creased(), many_spans()]).enumerate() {
        let bezier = extract(&model);
        for (grid, transform) in [(2, RigidTransform::IDENTITY), (5, turned()), (16, turned())] {
            let tree = GridTree::new(&bezier, grid).unwrap();
            let boxes = boxes_of(&bezier, &tree, &transform);
            for (cell, aabb) in tree.cells.iter().zip(&boxes[tree.finest]) {
                let surface = &model.surfaces()[cell.surface as usize];
                let [u, v] = surface.domain();
                let (u, v) = (ends(u, cell.row, grid), ends(v, cell.column, grid));
                for step in 0..49 {
                    let at = |[start, end]: [f64; 2], k: usize| start + (end - start) * k as f64 / 6.0;
                    let point = evaluator::point(surface, at(u, step / 7), at(v, step % 7));
                    let point = transform.apply(DVec3::from_array(point));
                    assert!(
                        contains(aabb, point),
                        "model {index}, {grid}, {cell:?}: {point} not in {aabb:?}"
                    );
                }
            }
            let whole = boxes[0][0];
            assert!(boxes[tree.finest].iter().all(|aabb| whole.union(*aabb) == whole));
        }
    }
}

#[test]
fn growth_of_a_parabola_is_known() {
    // (s, t, s^2) has second derivative 2 by s alone: a cell of a quarter is
    // 2 / 16 / 8 off its chord.
    let point = |i: usize, j: usize| [0.5 * i as f64, j as f64, if i == 2 { 1.0 } else { 0.0 }, 1.0];
    let control_points = (0..3).flat_map(|i| (0..2).map(move |j| point(i, j))).collect();
    let parabola = model(vec![SurfaceArrays {
        degree: [2, 1],
        knots: [vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [3, 2],
        control_points,
    }]);
    let tree = GridTree::new(&extract(&parabola), 4).unwrap();
    for part in &tree.parts {
        assert!((part.growth - 1.0 / 64.0).abs() < 1e-12, "{}", part.growth);
    }
}

#[test]
fn every_cell_of_every_surface_is_a_leaf_once() {
    let tiles = model((0..9).map(|x| square(f64::from(x), 0.0)).collect());
    for grid in [2, 3, 5, 8, 13] {
        let tree = GridTree::new(&extract(&tiles), grid).unwrap();
        let mut found: Vec<(u32, u32, u32)> =
            tree.cells.iter().map(|&Cell { surface, row, column }| (surface, row, column)).collect();
        found.sort_unstable();
        let side = grid as u32;
        let all = (0..9).flat_map(|s| (0..side).flat_map(move |i| (0..side).map(move |j| (s, i, j))));
        assert_eq!(found, all.collect::<Vec<_>>());
        // Children follow one another without gap or overlap.
        for (level, nodes) in tree.levels.iter().enumerate() {
            let mut next = 0;
            for children in nodes {
                assert_eq!(children.range().start, next, "{grid}, level {level}");
                assert!((1..=4).contains(&children.count));
                next = children.range().end;
            }
            assert_eq!(next, tree.levels.get(level + 1).map_or(tree.parts.len(), Vec::len));
        }
    }
}

#[test]
fn cells_of_many_spans_get_levels_in_between() {
    let bezier = extract(&many_spans());
    let tree = GridTree::new(&bezier, 2).unwrap();
    // 40 x 37 spans, halved: 20 by 18 and 19, with one column cut in two.
    assert_eq!(tree.parts.len(), 40 * 38);
    assert_eq!((tree.cells.len(), tree.finest), (4, 1));
    assert_eq!(tree.levels.len(), 3);
    let most = |level: &Vec<Children>| level.iter().map(|node| node.count).max();
    assert!(tree.levels.iter().all(|level| most(level).unwrap() as usize <= MAX_CHILDREN));
}

/// Descends on the CPU without a budget.
fn descend(mut traversal: Traversal<'_>) -> Distances {
    let mut found = Distances::UNKNOWN;
    while traversal.level < traversal.finest() {
        let bounds = traversal.bound(0..traversal.pairs().nodes());
        found = extremes(&bounds);
        let mut pairs = Pairs::new();
        for bound in &bounds {
            let partners = traversal.cull(bound, found.near);
            if !partners.is_empty() {
                pairs.push(bound.node, &partners);
            }
        }
        traversal.descend_to(pairs);
    }
    found
}

#[test]
fn culling_drops_no_pair_that_matters() {
    for (a, b, transform) in [
        ("sphere", "torus", turned()),
        ("wavy-sheet", "wavy-sheet-b", RigidTransform::IDENTITY),
        ("glass", "glass", translation(0.1, 0.0, 0.0)),
        ("cone", "naca-wing", turned()),
    ] {
        let models = [a, b].map(|name| extract(&shape(name).unwrap()));
        let trees = [0, 1].map(|side| GridTree::new(&models[side], 8).unwrap());
        let moves = [transform, RigidTransform::IDENTITY];
        let boxes = [0, 1].map(|side| boxes_of(&models[side], &trees[side], &moves[side]));
        let found = descend(Traversal::new([&trees[0], &trees[1]], boxes.clone()));
        // All pairs of cells.
        let [of_a, of_b] = [0, 1].map(|side| &boxes[side][trees[side].finest]);
        let nearest = |aabb: &Aabb| {
            of_b.iter().map(|other| Distances::of(aabb, other)).fold(Distances::UNKNOWN, Distances::nearest)
        };
        let all: Vec<Distances> = of_a.iter().map(nearest).collect();
        let largest = |of: fn(&Distances) -> f64| all.iter().map(of).fold(0.0, f64::max);
        assert_eq!(found.near, largest(|distances| distances.near), "{a} {b}");
        assert_eq!(found.far, largest(|distances| distances.far), "{a} {b}");
    }
}

#[test]
fn distances_of_boxes_are_those_of_their_points() {
    let mut random = fastrand::Rng::with_seed(11);
    let mut corner = || DVec3::new(random.f64(), random.f64(), random.f64()) * 3.0;
    for _ in 0..500 {
        let mut aabb = || Aabb::EMPTY.with(corner()).with(corner());
        let (a, b) = (aabb(), aabb());
        let Distances { near, far } = Distances::of(&a, &b);
        // From the points of a on a grid of cells of diagonal at most 0.58.
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        for index in 0..1000 {
            let at =
                DVec3::new(f64::from(index / 100), f64::from(index / 10 % 10), f64::from(index % 10)) / 9.0;
            let point = a.min + a.extent() * at;
            least = least.min(b.min_distance_squared(point));
            most = most.max(b.max_distance_squared(point));
        }
        assert!(near <= least + ROUNDING && (far - most).abs() < ROUNDING, "{near} {least}, {far} {most}");
        assert!(least.sqrt() - near.sqrt() < 0.3, "{near} {least}");
    }
}

/// Runs on both backends; the interval must contain the truth.
fn on_both(test: &str, a: &Model, b: &Model, options: &Options, truth: f64) -> Vec<DistanceResult> {
    let Some(engine) = engine(test) else { return Vec::new() };
    [Backend::Gpu, Backend::Cpu]
        .map(|backend| {
            let result = measure(&engine, a, b, &Options { backend, ..options.clone() });
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
    on_both("a_turned_sphere", &a, &b, &Options { transform: rotation(), ..hierarchy() }, 0.5);
    let options = Options { transform: translation(0.0, 0.3, 0.75), symmetric: true, ..hierarchy() };
    let moved = 0.75_f64.hypot(0.3);
    for result in on_both("a_moved_sphere", &a, &a, &options, moved) {
        let both: Vec<u64> = result.hierarchy().unwrap().pairs.clone();
        let (forward, reverse) = (result.forward.unwrap(), result.reverse.unwrap());
        assert_eq!(result.lower, forward.lower.max(reverse.lower));
        assert_eq!(result.upper, forward.upper.max(reverse.upper));
        // Named by model and told in B's frame.
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
        for result in on_both(name, &this, &this, &Options { grid: 24, ..hierarchy() }, 0.0) {
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
        let options = Options { backend, grid: 32, ..hierarchy() };
        let by_option = measure(&engine, &a, &b, &Options { transform, ..options.clone() });
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
    let moved = on_both("moved", &a, &far_b, &Options { transform, ..hierarchy() }, 0.5);
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
    let away = Options { transform: translation(0.0, 0.0, 20.0), ..hierarchy() };
    let width = |backend: Backend, options: &Options, b: &Model, grid: usize| {
        let engine = pollster::block_on(Engine::new(backend)).unwrap();
        let result = measure(&engine, &ball, b, &Options { backend, grid, ..options.clone() });
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
            let options = Options { transform: turned(), grid, ..hierarchy() };
            let on = |backend| measure(&engine, &a, &b, &Options { backend, ..options.clone() });
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
            assert_eq!(result.witness.a.surface, raised);
            assert_eq!(result.witness.b.surface, 0);
        }
        let reversed =
            on_both("reversed", &sheet, &tiles(Some(raised)), &Options { grid: 8, ..hierarchy() }, {
                // From the sheet's corner to the nearest corner of the row, or over the raised tile.
                let corner = 2.0_f64.sqrt();
                if raised == 3 { corner } else { (2.0_f64 + 0.25).sqrt() }
            });
        assert!(reversed.iter().all(|result| result.witness.a.surface == 0));
    }
}

#[test]
fn a_budget_of_memory_ends_the_descent_with_the_pairs_wanted() {
    let Some(engine) = engine("a_budget_of_memory") else { return };
    let ball = PreparedModel::new(&sphere(DVec3::ZERO, 1.0).unwrap());
    let wanted = [Backend::Gpu, Backend::Cpu].map(|backend| {
        let run = |memory_budget| {
            let options = Options { backend, memory_budget, grid: 128, ..hierarchy() };
            pollster::block_on(engine.distance(&ball, &ball, &options, &mut NoMonitor))
        };
        let error = run(1).unwrap_err();
        assert_eq!(error.code(), "PAIR_BUDGET_EXCEEDED");
        let text = error.to_string();
        let Error::PairBudgetExceeded { level, found, expected, mebibytes } = error else { panic!("{text}") };
        // Two lists of pairs of 8 bytes.
        assert_eq!((expected, mebibytes), ((1 << 20) / 16, 1));
        assert!(found > expected && text.contains(&format!("wants {found} pairs")), "{text}");
        // With room for it the level has as many pairs as were wanted.
        let pairs = run(256).unwrap().hierarchy().unwrap().pairs.clone();
        assert_eq!(pairs[level], found);
        assert!(pairs[..level].iter().all(|&pairs| pairs <= expected));
        found
    });
    assert!(wanted[0].abs_diff(wanted[1]) < wanted[1] / 20, "{wanted:?}");
}

#[test]
fn options_out_of_range_are_named() {
    let engine = pollster::block_on(Engine::new(Backend::Cpu)).unwrap();
    let many = PreparedModel::new(&model((0..5).map(|x| square(f64::from(x), 0.0)).collect()));
    let refused =
        |options: Options| match pollster::block_on(engine.distance(&many, &many, &options, &mut NoMonitor))
            .unwrap_err()
        {
            Error::OptionOutOfRange { option, found, .. } => (option, found),
            other => panic!("{other}"),
        };
    assert_eq!(refused(Options { grid: 1, ..hierarchy() }), ("grid", "1".to_owned()));
    assert_eq!(refused(Options { grid: 1025, ..hierarchy() }), ("grid", "1025".to_owned()));
    // Five million cells.
    assert_eq!(refused(Options { grid: 1024, ..hierarchy() }), ("grid", "1024".to_owned()));
    assert_eq!(refused(Options { memory_budget: 0, ..hierarchy() }).0, "memory budget");
    assert_eq!(refused(Options { memory_budget: 257, ..hierarchy() }).0, "memory budget");
}

/// Notes what it is told, and cancels once it passes a fraction.
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
    let ball = PreparedModel::new(&sphere(DVec3::ZERO, 1.0).unwrap());
    for backend in [Backend::Gpu, Backend::Cpu] {
        let options = Options { backend, grid: 128, transform: translation(0.0, 0.0, 0.5), ..hierarchy() };
        let mut watch = Watch::default();
        let result = pollster::block_on(engine.distance(&ball, &ball, &options, &mut watch)).unwrap();
        assert!(watch.fractions.windows(2).all(|pair| pair[0] <= pair[1]), "{:?}", watch.fractions);
        assert_eq!(watch.fractions.last(), Some(&1.0));
        let narrows = |pair: &[[f64; 2]]| pair[0][0] <= pair[1][0] && pair[1][1] <= pair[0][1];
        assert!(watch.intervals.windows(2).all(narrows), "{:?}", watch.intervals);
        assert_eq!(watch.intervals.last(), Some(&[result.lower, result.upper]));
        let mut watch = Watch { cancel_at: Some(0.0), ..Watch::default() };
        let cancelled = pollster::block_on(engine.distance(&ball, &ball, &options, &mut watch));
        assert_eq!(cancelled.unwrap_err(), Error::Cancelled);
    }
}
