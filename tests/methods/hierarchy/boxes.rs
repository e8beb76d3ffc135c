//! The boxes of method `hierarchy`: they contain their cells, and culling drops no pair that matters.

use crate::support::evaluator;
use crate::support::fixtures::{model, square, translation, turned};
use glam::DVec3;
use nurbs_hausdorff::internals::bezier::{BezierModel, extract};
use nurbs_hausdorff::internals::bvh::Aabb;
use nurbs_hausdorff::internals::hierarchy::{
    CellPart, ChildRange, DistanceBounds, GridCell, GridTree, MAX_CHILDREN, Pairs, Traversal, boxes,
    extremes, pyramid,
};
use nurbs_hausdorff::shapes::{WavySheet, shape, wavy_sheet};
use nurbs_hausdorff::{Model, RigidTransform, SurfaceArrays};

/// Rounding of a distance of models of size 1 to 10 in float64.
const ROUNDING: f64 = 1e-9;

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
    let of_part = |part: &CellPart| boxes(&bezier.patches.patch(part.patch), part, transform, 0.0);
    pyramid(&tree.levels, tree.parts.iter().map(of_part).collect())
}

fn contains(aabb: &Aabb, point: DVec3) -> bool {
    (aabb.min - ROUNDING).cmple(point).all() && point.cmple(aabb.max + ROUNDING).all()
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
                let [u, v] = surface.domain().intervals();
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
            tree.cells.iter().map(|&GridCell { surface, row, column }| (surface, row, column)).collect();
        found.sort_unstable();
        let side = grid as u32;
        let all = (0..9).flat_map(|s| (0..side).flat_map(move |i| (0..side).map(move |j| (s, i, j))));
        assert_eq!(found, all.collect::<Vec<_>>());
        // ChildRange follow one another without gap or overlap.
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
    let most = |level: &Vec<ChildRange>| level.iter().map(|node| node.count).max();
    assert!(tree.levels.iter().all(|level| most(level).unwrap() as usize <= MAX_CHILDREN));
}

/// Descends on the CPU without a budget.
fn descend(mut traversal: Traversal<'_>) -> DistanceBounds {
    let mut found = DistanceBounds::UNKNOWN;
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
            of_b.iter()
                .map(|other| DistanceBounds::between(aabb, other))
                .fold(DistanceBounds::UNKNOWN, DistanceBounds::nearest)
        };
        let all: Vec<DistanceBounds> = of_a.iter().map(nearest).collect();
        let largest = |of: fn(&DistanceBounds) -> f64| all.iter().map(of).fold(0.0, f64::max);
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
        let DistanceBounds { near, far } = DistanceBounds::between(&a, &b);
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
