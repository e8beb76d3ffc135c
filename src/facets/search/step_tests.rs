//! Single steps of the search: no point is lost, no bound is below a point's distance, and every
//! allowance is that of docs/meshes.md.

use super::explore::Explored;
use super::part::{Step, TrianglePart};
use super::patch_cell::CellStep;
use super::*;
use crate::bezier::{PatchSet, extract};
use crate::facets::rounding::sag_rounding;
use crate::facets::{FacetTarget, PointCloud, TriangleMesh};
use crate::model::{Model, SurfaceArrays};
use crate::param_box::ParamBox;
use crate::rounding::{lower_min, upper_max};

fn point(random: &mut fastrand::Rng) -> DVec3 {
    DVec3::from_array([0; 3].map(|_| random.f64() - 0.5))
}

fn cloud(points: &[DVec3]) -> FacetTarget {
    FacetTarget::of_cloud(&PointCloud::new(points.to_vec()).unwrap())
}

fn mesh(corners: &[DVec3]) -> FacetTarget {
    let triangles: Vec<[u32; 3]> =
        (0..corners.len() as u32 / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    FacetTarget::of_mesh(&TriangleMesh::new(corners, &triangles).unwrap())
}

fn of(facets: &FacetTarget, error: f64) -> Source<'_> {
    Source::Facets { facets, error }
}

fn to(facets: &FacetTarget, error: f64) -> Measured<'_> {
    Measured::Facets { facets, error }
}

fn distance(b: &FacetTarget, point: DVec3) -> f64 {
    (0..b.len() as u32).map(|facet| b.distance_squared(facet, point)).fold(f64::INFINITY, lower_min).sqrt()
}

/// What a step decides is within its bound, what it does not lies in the parts, both bounds are
/// about attained, and every part is one cut deeper.
#[test]
fn steps_decide_or_keep_every_point() {
    let random = &mut fastrand::Rng::with_seed(51);
    let [mut splits, mut near, mut halvings] = [0; 3];
    let mut attained = [0.0_f64; 2];
    for _ in 0..20_000 {
        let count = random.usize(1..4);
        let b: Vec<DVec3> = (0..3 * count).map(|_| point(random)).collect();
        let b = if random.bool() { mesh(&b) } else { cloud(&b) };
        let corners = [0; 3].map(|_| point(random));
        let mut part = TrianglePart::new(corners, random.u32(0..b.len() as u32));
        part.level = random.u32(0..20);
        let threshold = random.f64();
        let step = part.step(&b, threshold);
        let (decided, parts) = match step {
            Step::Decided(decided) => (decided, [None, None]),
            Step::Far { point, .. } => {
                assert!(distance(&b, point) > threshold);
                continue;
            }
            Step::Split { decided, parts, .. } => (decided, parts),
        };
        assert!(decided <= threshold);
        let is_split = parts[0].is_some();
        splits += usize::from(is_split && decided > 0.0);
        near += usize::from(is_split && parts[1].is_some() && decided > 0.0);
        halvings += usize::from(is_split && decided == 0.0);
        assert!(parts.iter().flatten().all(|inner| inner.level == part.level + 1));
        for sample in 0..40 {
            let [s, t] = [random.f64(), random.f64()];
            let at = if sample < 3 {
                corners[sample]
            } else {
                Facet::Triangle(corners).point([1.0 - s, s * (1.0 - t), s * t])
            };
            let is_kept = |inner: &TrianglePart| {
                Facet::Triangle(inner.corners).nearest(at).distance_squared.sqrt() <= 1e-12
            };
            if !parts.iter().flatten().any(is_kept) {
                let found = distance(&b, at);
                assert!(found <= decided + 1e-12, "{found} beyond {decided}");
                let of = &mut attained[usize::from(is_split)];
                *of = of.max(found / decided);
            }
        }
        // The bound of a part that is too small to be cut is that of one facet.
        part.find_feet(&b);
        assert!(corners.iter().all(|&corner| distance(&b, corner) <= part.upper(&b) + 1e-12));
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        assert!(distance(&b, middle) <= part.upper(&b) + 1e-12);
    }
    assert!(splits > 800 && near > 150 && halvings > 300, "{splits} {near} {halvings}");
    assert!(attained[0] > 0.999 && attained[1] > 0.98, "{attained:?}");
}

fn explored(a: Source<'_>, b: Measured<'_>, region: Region, threshold: f64) -> Explored {
    let search = FacetSearch::new(a, b, RigidTransform::IDENTITY, 1e-6, None);
    search.explore(Node { upper: 7.0, region, start: Start::default(), level: 0 }, threshold)
}

/// Points that are looked at count with their distance, within the threshold or not.
#[test]
fn points_of_a_leaf_are_decided_by_their_distance() {
    let b = cloud(&[DVec3::ZERO]);
    let a = cloud(&[0.3, -0.6, 0.9].map(|x| DVec3::new(x, 0.0, 0.0)));
    let found = explored(of(&a, 0.0), to(&b, 0.0), Region::Node(0), 0.7);
    assert_eq!((found.decided, found.farthest.unwrap().distance), (0.9, 0.9));
}

/// Where the box does not decide, the points of a leaf do, though all are within the threshold.
#[test]
fn points_within_the_threshold_are_decided_by_their_distance() {
    let (a, b) = (cloud(&[-0.6, 0.6].map(|x| DVec3::X * x)), cloud(&[DVec3::Y * 0.8]));
    let found = explored(of(&a, 0.0), to(&b, 0.0), Region::Node(0), 1.2);
    assert!((found.decided - 1.0).abs() <= 1e-15 && found.farthest.is_none(), "{}", found.decided);
    // A node whose bound is within the threshold is decided by its bound.
    let found = explored(of(&a, 0.0), to(&b, 0.0), Region::Node(0), 8.0);
    assert_eq!(found.decided, 7.0);
}

/// No point of a part is beyond what its exploration decides, where nothing of it is left.
#[test]
fn no_point_of_an_explored_part_is_beyond_what_is_decided() {
    let random = &mut fastrand::Rng::with_seed(54);
    let (mut count, mut attained) = (0, 0.0_f64);
    for _ in 0..6000 {
        let b: Vec<DVec3> = (0..3 * random.usize(1..4)).map(|_| point(random)).collect();
        let b = if random.bool() { mesh(&b) } else { cloud(&b) };
        let corners = [0; 3].map(|_| point(random));
        let a = mesh(&corners);
        let farthest_corner = corners.iter().map(|&corner| distance(&b, corner)).fold(0.0, upper_max);
        let threshold = farthest_corner * (1.0 + 0.3 * random.f64());
        let part = TrianglePart::new(corners, 0);
        let found = explored(of(&a, 0.0), to(&b, 0.0), Region::Part(0, part), threshold);
        if found.farthest.is_some() || !found.waiting.is_empty() {
            continue;
        }
        assert!(found.decided >= farthest_corner - 1e-12, "{} {farthest_corner}", found.decided);
        attained = upper_max(attained, farthest_corner / found.decided);
        count += 1;
    }
    assert!(count > 500 && attained > 0.999, "{count} {attained}");
}

/// What a cut decides counts: between a point and a sheet the farthest points are about as far from both.
#[test]
fn what_a_cut_decides_counts() {
    let point = DVec3::Z * 0.4;
    let sheet = [DVec3::new(0.9, -9.0, 0.0), DVec3::new(0.9, 9.0, 0.0), DVec3::X * 20.0];
    let b = mesh(&[sheet, [point; 3]].concat());
    let corners = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 0.2, 0.0)];
    let a = mesh(&corners);
    for first in [0, 1] {
        let found =
            explored(of(&a, 0.0), to(&b, 0.0), Region::Part(0, TrianglePart::new(corners, first)), 0.85);
        assert!(found.farthest.is_none() && found.waiting.is_empty());
        // Of (x, 0) the distances are the root of x² + 0.4² and 0.9 − x: equal for x = 0.65 / 1.8.
        let farthest = 0.9 - 0.65 / 1.8;
        assert!(found.decided >= farthest, "{} {farthest}", found.decided);
    }
}

/// What a search has not bounded yet, and what it need not bound, are in its interval: here the first
/// corner, whose distance is certified first, is a point of B.
#[test]
fn intervals_hold_the_distance_before_the_search_and_within_the_tolerance() {
    let (a, b) = (mesh(&[DVec3::ZERO, DVec3::X * 3.0, DVec3::Y * 4.0]), cloud(&[DVec3::ZERO]));
    for tolerance in [1e-6, 100.0] {
        let mut search =
            FacetSearch::new(of(&a, 0.0), to(&b, 0.0), RigidTransform::IDENTITY, tolerance, None);
        let [lower, upper] = search.interval();
        assert!(lower <= 4.0 && 4.0 <= upper, "[{lower}, {upper}]");
        while search.advance(usize::MAX).is_none() {}
        let [lower, upper] = search.interval();
        assert!(lower <= 4.0 && 4.0 <= upper, "[{lower}, {upper}]");
    }
}

/// The unit square far from the origin at height 1, of a control point at this height, above two
/// triangles that are its own from above: each of the cell's is decided by one of them.
fn cell_above_its_triangles(middle: f64) -> (PatchSet, FacetTarget) {
    let far = DVec3::X * 1000.0;
    let height = |i: usize, j: usize| if [i, j].contains(&1) { middle } else { 1.0 };
    let at = |i: usize, j: usize| far + DVec3::new(i as f64 / 2.0, j as f64 / 2.0, height(i, j));
    let controls = (0..9).map(|k| at(k / 3, k % 3).extend(1.0).to_array()).collect();
    let [a, b, c, d] =
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| far + DVec3::new(x, y, 0.0));
    (patches(2, controls), mesh(&[a, b, c, a, c, d]))
}

/// Lemma F6: a cell that its triangles decide has their bound, its sag, and 256 u L for rounding.
#[test]
fn cells_that_their_triangles_decide_have_their_sag_added() {
    let rounding = 256.0 * UNIT_ROUNDOFF * 1000.0;
    for bulge in [0.0, 1e-4] {
        let (surface, b) = cell_above_its_triangles(1.0 + bulge);
        let cell = PatchCell::whole(0);
        let net = cell.net(&surface, &RigidTransform::IDENTITY);
        let found = PatchCell::step(&net, &cell.corners(&net, &b), &b, 1.001, 1e-3, 1000.0);
        let CellStep::Decided(upper) = found else { panic!("the cell is flat") };
        let expected = 1.0 + bulge + rounding;
        assert!((expected..=expected + 0.1 * rounding).contains(&upper), "{upper} {expected}");
    }
}

/// Statistics of a cell hold all of its points by both of its triangles, its sag and the rounding of
/// lemma F8; those of a triangle and a point that rounding too.
#[test]
fn spreads_have_every_allowance() {
    let u = UNIT_ROUNDOFF;
    let check = |a: Source<'_>, b: &FacetTarget, [low, high]: [f64; 2], sag_roundings: f64| -> [f64; 2] {
        let parts = Parts::new(a, to(b, 0.0), RigidTransform::IDENTITY, 0.0);
        let allowance =
            1.01 * (32.0 + 8.0 + 6.0 * 128.0 + 64.0 + sag_roundings) * u * 1000.0 - 4.0 * u * high;
        let found = match parts.first(0, Start::default()) {
            Some((part, _)) => part.spread(),
            None => parts.point(0, Start::default(), 1e-3).unwrap().0.spread(),
        };
        assert!(found.lower <= low - allowance && found.upper >= high + allowance, "{found:?} {low} {high}");
        let [mean, square] = [found.mean, found.square];
        assert!(mean[0] <= high - allowance && mean[1] >= low + allowance, "{found:?}");
        assert!(square[0].sqrt() <= high - allowance && square[1].sqrt() >= low + allowance, "{found:?}");
        [found.lower, found.upper]
    };
    for bulge in [0.0, 0.25] {
        let (surface, b) = cell_above_its_triangles(1.0 + bulge);
        // The middle of the cell has three quarters of the control points' height, which attain the sag.
        let [_, upper] = check(of_patches(&surface), &b, [1.0, 1.0 + 0.75 * bulge], 256.0);
        assert!(upper <= 1.0 + bulge + 1e-9, "{upper}");
    }
    // Of a slope the first triangle has the heights 1 to 2, and the other one 2 to 3.
    let far = DVec3::X * 1000.0;
    let slope = [[0.0, 0.0, 2.0], [0.0, 1.0, 3.0], [1.0, 0.0, 1.0], [1.0, 1.0, 2.0]]
        .map(|at| (far + DVec3::from_array(at)).extend(1.0).to_array());
    let below = [[-9.0, -9.0], [9.0, -9.0], [0.0, 18.0]].map(|[x, y]| far + DVec3::new(x, y, 0.0));
    let below = mesh(&below);
    let slope = patches(1, slope.to_vec());
    check(of_patches(&slope), &below, [1.0, 3.0], 256.0);
    let a = mesh(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|[x, y]| far + DVec3::new(x, y, 1.0)));
    check(of(&a, 0.0), &below, [1.0; 2], 0.0);
    let point = cloud(&[far + DVec3::Z]);
    check(of(&point, 0.0), &below, [1.0; 2], 0.0);
    // Lemma F2: a certified distance has 32 u L taken off.
    let found = to(&below, 0.0).certified(far + DVec3::Z, Start::default(), 1e-3, 1000.0).unwrap();
    assert!(found.lower <= 1.0 - 32.0 * u * 1000.0, "{}", found.lower);
}

/// Lemma F7, attained: a corner of the box on the ray from B through its middle.
#[test]
fn the_bound_of_a_box_is_attained_at_its_corner() {
    let b = cloud(&[DVec3::splat(-3.0)]);
    let a = cloud(&[DVec3::ZERO, DVec3::ONE]);
    let farthest = 4.0 * 3.0_f64.sqrt();
    // Just below what the box's corner attains, the box does not decide it.
    let found = explored(of(&a, 0.0), to(&b, 0.0), Region::Node(0), farthest * (1.0 - 1e-9));
    assert!((found.decided - farthest).abs() <= 1e-12, "{}", found.decided);
    let found = explored(of(&a, 0.0), to(&b, 0.0), Region::Node(0), farthest * (1.0 + 1e-9));
    assert!((found.decided - farthest).abs() <= 1e-12 && found.farthest.is_none());
    // A search that has not begun has the box of all of A.
    let search = FacetSearch::new(of(&a, 0.0), to(&b, 0.0), RigidTransform::IDENTITY, 1e-6, None);
    assert!((search.bound_of_box() - farthest).abs() <= 1e-12);
    let [lower, upper] = search.interval();
    assert!(lower <= farthest && farthest <= upper);
}

/// Lemma F4 at the witness: a point of a part is as near to A as its cuts have moved it, 6 u L for each
/// and for the four of a cover, and a certified distance has that taken off.
#[test]
fn a_witness_within_a_triangle_has_its_cuts_taken_off() {
    let corners = [DVec3::ZERO, DVec3::X * 1000.0, DVec3::Y];
    let (a, b) = (mesh(&corners), cloud(&[DVec3::Z]));
    let part = TrianglePart { level: 10, ..TrianglePart::new(corners, 0) };
    let found = explored(of(&a, 0.0), to(&b, 0.0), Region::Part(0, part), 0.1).farthest.unwrap();
    let expected = (10.0 + 4.0) * 6.0 * 1.01 * UNIT_ROUNDOFF * 1000.0;
    assert!((found.moved / expected - 1.0).abs() <= 0.01, "{} {expected}", found.moved);
    let mut search = FacetSearch::new(of(&a, 0.0), to(&b, 0.0), RigidTransform::IDENTITY, 1e-6, None);
    search.witness = None;
    search.certify(vec![Sample { moved: 0.25, ..found }]);
    let lower = search.witness.unwrap().closest.lower;
    assert!((found.distance - 0.25 - lower).abs() <= 1e-9, "{lower}");
    search.witness = None;
    search.certify(vec![Sample { moved: 2000.0, ..found }]);
    assert_eq!(search.witness.unwrap().closest.lower, 0.0);
}

/// Parts have the least of their bounds, so that a search at a budget knows what is known of each: here
/// a facet of B is one away from all of the part, and others are nearer to its corners.
#[test]
fn parts_that_are_left_have_the_least_of_their_bounds() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let sheet = [[-9.0, -9.0], [9.0, -9.0], [0.0, 18.0]].map(|[x, y]| DVec3::new(x, y, 1.0));
    let near = [DVec3::Z * 0.5; 3];
    let b = mesh(&[sheet, near].concat());
    let a = mesh(&corners);
    let part = TrianglePart::new(corners, 0);
    let found = explored(of(&a, 0.0), to(&b, 0.0), Region::Part(0, part), 0.9);
    assert!(!found.waiting.is_empty());
    assert!(found.waiting.iter().all(|node| node.upper <= 1.0 + 1e-12), "{:?}", found.waiting);
}

/// Parts and cells that cannot be cut further keep a bound.
#[test]
fn what_is_too_small_to_be_cut_keeps_its_bound() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let (a, b) = (mesh(&corners), cloud(&[DVec3::Z, DVec3::new(1.0, 0.0, 2.0)]));
    let part = TrianglePart { level: MAX_LEVELS, ..TrianglePart::new(corners, 0) };
    let found = explored(of(&a, 0.0), to(&b, 0.0), Region::Part(0, part), 0.1);
    assert!(found.exhausted && found.decided >= 2.0_f64.sqrt() && found.decided < 7.0, "{}", found.decided);
    let flat = patches(
        1,
        vec![[0.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0], [1.0, 1.0, 0.0, 1.0]],
    );
    let a = Source::Patches { patches: &flat, error: 0.0, control_box: flat.bounding_box() };
    let range = ParamBox::new([0.5, 0.5 + 1e-13], [0.5, 0.5 + 1e-13]);
    let found = explored(a, to(&b, 0.0), Region::Cell(PatchCell { range, ..PatchCell::whole(0) }), 0.1);
    assert!(found.exhausted && found.decided == 7.0, "{}", found.decided);
}

/// The patches of one surface of bidegree (degree, degree).
fn patches(degree: usize, control_points: Vec<[f64; 4]>) -> PatchSet {
    let knots = || [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat();
    let surface = SurfaceArrays {
        degree: [degree; 2],
        knots: [knots(), knots()],
        counts: [degree + 1; 2],
        control_points,
    };
    extract(&Model::from_arrays(None, vec![surface]).unwrap()).patches
}

/// A bound of a cell is above the distances of its points, by its triangles and their sag as by one
/// facet, and is attained.
#[test]
fn no_point_of_a_cell_is_beyond_its_bound() {
    let random = &mut fastrand::Rng::with_seed(53);
    let (mut decided_by_parts, mut attained) = (0, 0.0_f64);
    for round in 0..3000 {
        let degree = random.usize(1..3);
        let bend = [0.0, 0.01, 0.2][round % 3];
        let mut controls = Vec::new();
        for i in 0..=degree {
            for j in 0..=degree {
                let at = DVec3::new(i as f64, j as f64, 0.0) / degree as f64 + bend * point(random);
                controls.push(at.extend(1.0).to_array());
            }
        }
        let net = patches(degree, controls);
        let near: Vec<DVec3> = (0..random.usize(2..6))
            .map(|_| DVec3::new(0.5, 0.5, 0.0) + 1.2 * point(random) * DVec3::new(1.0, 1.0, 0.3))
            .collect();
        let b = cloud(&near);
        let samples: Vec<f64> = (0..=12 * 12)
            .map(|k| [f64::from(k % 13) / 12.0, f64::from(k / 13) / 12.0])
            .map(|at| distance(&b, net.patch(0).point(at)))
            .collect();
        let farthest = samples.into_iter().fold(0.0, upper_max);
        let threshold = farthest * (1.0 + 0.3 * random.f64());
        let cell = PatchCell::whole(0);
        let of_cell = cell.net(&net, &RigidTransform::IDENTITY);
        let corners = cell.corners(&of_cell, &b);
        let found = PatchCell::step(&of_cell, &corners, &b, threshold, 1e-3, 2.0);
        if let CellStep::Decided(upper) = found {
            assert!(farthest <= upper + 1e-12 && upper <= threshold, "{farthest} {upper} {threshold}");
            let by_one = |facet: u32| of_cell.upper_by(&b, [facet; 4]) <= threshold;
            let is_by_parts = !(0..b.len() as u32).any(by_one);
            decided_by_parts += usize::from(is_by_parts);
            if is_by_parts {
                attained = upper_max(attained, farthest / upper);
            }
        }
    }
    assert!(decided_by_parts > 100 && attained > 0.9, "{decided_by_parts} {attained}");
}

fn of_patches(patches: &PatchSet) -> Source<'_> {
    Source::Patches { patches, error: 0.0, control_box: patches.bounding_box() }
}

/// The interval of two points has both models' errors, the transform's, and the allowances of
/// section 5: 32, 8, and 6 for each of 128 cuts.
#[test]
fn intervals_have_every_allowance() {
    let (a, b) = (cloud(&[DVec3::ZERO]), cloud(&[DVec3::X]));
    let interval = |of_a: f64, of_b: f64| {
        let mut search = FacetSearch::new(of(&a, of_a), to(&b, of_b), RigidTransform::IDENTITY, 4.0, None);
        while search.advance(usize::MAX).is_none() {}
        search.interval()
    };
    let [lower, upper] = interval(0.1, 0.02);
    assert!((0.87..=0.88).contains(&lower) && (1.12..=1.13).contains(&upper), "[{lower}, {upper}]");
    let moved = RigidTransform::new(glam::DQuat::IDENTITY, DVec3::new(0.0, 1000.0, 0.0)).unwrap();
    for (transform, length, of_points) in
        [(RigidTransform::IDENTITY, 1.0, 0.0), (moved, 1000.0, moved.rounding(0.0))]
    {
        let goal = Goal::new(&of(&a, 0.0), &to(&b, 0.0), &transform, 1.0, None);
        let expected = 1.01 * (32.0 + 8.0 + 6.0 * 128.0) * UNIT_ROUNDOFF * length;
        assert!(goal.length >= length && goal.points >= of_points);
        assert!((goal.bounds / expected - 1.0).abs() <= 1e-6, "{} {expected}", goal.bounds);
        let upper = goal.rounded_up(1.0);
        assert!(upper >= 1.0 + 15.0 * UNIT_ROUNDOFF + expected + of_points, "{upper}");
        assert!(goal.rounded_up(goal.before_rounding_up(1.0)) <= 1.0);
    }
    assert!(sag_rounding(1.0) >= 256.0 * UNIT_ROUNDOFF);
    let far = cloud(&[DVec3::new(0.0, 0.0, 1000.0)]);
    let parts = Parts::new(of(&far, 0.0), to(&b, 0.0), RigidTransform::IDENTITY, 0.0);
    let expected = 1.01 * (32.0 + 8.0 + 6.0 * 128.0 + 64.0) * UNIT_ROUNDOFF * 1000.0
        + RigidTransform::IDENTITY.rounding(1000.0);
    assert!(parts.rounding() >= expected, "{}", parts.rounding());
    let erring = Parts::new(of(&a, 0.1), to(&b, 0.02), RigidTransform::IDENTITY, 0.0);
    assert!(erring.rounding() >= 0.12);
}
