//! Where models are sampled, how far from a sample their points can be, and
//! the stages `project` and `reduce` on the CPU.

use crate::support::evaluator;
use glam::DVec3;
use nurbs_hausdorff::internals::bezier::{BezierModel, extract};
use nurbs_hausdorff::internals::closest::{Projection, Status, Target};
use nurbs_hausdorff::internals::flatness::{Flatness, flatten};
use nurbs_hausdorff::internals::iteration::{
    Culling, PAGE_SAMPLES, Projected, Rule, Sampling, SamplingRule, project, reduce, sample,
};
use nurbs_hausdorff::shapes::{shape, sphere};
use nurbs_hausdorff::{Model, RigidTransform, SurfaceArrays};
use std::f64::consts::FRAC_1_SQRT_2;

/// Rounding of points of size 1 to 10.
const ROUNDING: f64 = 1e-12;

const RULES: [SamplingRule; 2] = [SamplingRule::Uniform, SamplingRule::ArcLength];

const SHAPES: [&str; 7] = ["sphere", "torus", "cone", "glass", "wigley-hull", "wavy-sheet", "fig5-plane"];

fn single(degree: [usize; 2], knots: [Vec<f64>; 2], control_points: Vec<[f64; 4]>) -> Model {
    let counts = [0, 1].map(|axis| knots[axis].len() - degree[axis] - 1);
    Model::from_arrays(None, vec![SurfaceArrays { degree, knots, counts, control_points }]).unwrap()
}

/// The strip over a curve in the plane, of this height: s runs along the curve.
fn strip(degree: usize, knots: Vec<f64>, curve: &[[f64; 3]], height: f64) -> Model {
    let points = curve.iter().flat_map(|&[x, y, w]| [[x, y, 0.0, w], [x, y, height, w]]).collect();
    single([degree, 1], [knots, vec![0.0, 0.0, 1.0, 1.0]], points)
}

fn point(bezier: &BezierModel, sampling: &Sampling, index: usize) -> DVec3 {
    sample(bezier, sampling, index, &RigidTransform::IDENTITY)
}

#[test]
fn samples_are_the_points_at_their_parameters() {
    for name in SHAPES {
        let model = shape(name).unwrap();
        let bezier = extract(&model);
        for rule in RULES {
            let sampling = Sampling::new(&bezier, 7, rule);
            assert_eq!(sampling.len(), 49 * model.surfaces().len());
            for index in 0..sampling.len() {
                let surface = &model.surfaces()[sampling.surface(index)];
                let [u, v] = sampling.parameters(index);
                let expected = DVec3::from_array(evaluator::point(surface, u, v));
                let found = point(&bezier, &sampling, index);
                assert!(found.distance(expected) < ROUNDING * (1.0 + expected.length()), "{name} {index}");
            }
        }
    }
}

#[test]
fn parameters_rise_from_end_to_end() {
    for name in SHAPES {
        let model = shape(name).unwrap();
        for rule in RULES {
            let sampling = Sampling::new(&extract(&model), 9, rule);
            for (surface, grid) in model.surfaces().iter().zip(&sampling.grids) {
                for (parameters, domain) in grid.parameters.iter().zip(surface.domain().intervals()) {
                    assert_eq!([parameters[0], parameters[8]], domain, "{name} {rule:?}");
                    assert!(parameters.windows(2).all(|pair| pair[0] < pair[1]), "{name} {rule:?}");
                }
            }
        }
    }
}

#[test]
fn pages_are_whole_rows_and_cover_every_sample_once() {
    let flat = shape("fig5-plane").unwrap();
    let surface = &flat.surfaces()[0];
    for (surfaces, samples) in [(1, 2), (1, 513), (7, 300), (300, 32), (2, 1024)] {
        let model = Model::new(None, vec![surface.clone(); surfaces]).unwrap();
        let sampling = Sampling::new(&extract(&model), samples, SamplingRule::Uniform);
        let pages = sampling.pages();
        let mut next = 0;
        for page in &pages {
            assert_eq!(page.start, next);
            assert!(page.len() <= PAGE_SAMPLES && page.len() % samples == 0 && !page.is_empty());
            next = page.end;
        }
        assert_eq!(next, surfaces * samples * samples);
        // No page could have taken the row after it.
        let full = pages.windows(2).all(|pair| pair[0].len() + samples > PAGE_SAMPLES);
        assert!(full, "{surfaces} x {samples}");
    }
}

#[test]
fn every_point_is_within_the_rigorous_radius_of_a_sample() {
    for name in SHAPES {
        let model = shape(name).unwrap();
        let bezier = extract(&model);
        for (rule, samples) in RULES.into_iter().flat_map(|rule| [(rule, 2), (rule, 3), (rule, 9)]) {
            let sampling = Sampling::new(&bezier, samples, rule);
            let radius = sampling.radius(&bezier).rigorous;
            let all: Vec<DVec3> = (0..sampling.len()).map(|index| point(&bezier, &sampling, index)).collect();
            for surface in model.surfaces() {
                for [u, v] in evaluator::parameters(surface, 4 * samples + 1) {
                    let here = DVec3::from_array(evaluator::point(surface, u, v));
                    let nearest =
                        all.iter().map(|sample| sample.distance(here)).fold(f64::INFINITY, f64::min);
                    assert!(nearest <= radius, "{name} {rule:?} {samples}: {nearest}");
                }
            }
        }
    }
}

#[test]
fn the_published_radius_of_a_half_circle_is_no_bound() {
    // The design's example: sampled at its two ends, the box is 2 by 1, and
    // the apex is the square root of 2 from both.
    let w = FRAC_1_SQRT_2;
    let half = [[1.0, 0.0, 1.0], [1.0, 1.0, w], [0.0, 1.0, 1.0], [-1.0, 1.0, w], [-1.0, 0.0, 1.0]];
    let low = strip(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0], &half, 1e-9);
    let bezier = extract(&low);
    let radius = Sampling::new(&bezier, 2, SamplingRule::Uniform).radius(&bezier);
    assert!((radius.published - 1.25_f64.sqrt()).abs() < 1e-6, "{radius:?}");
    assert!(radius.published < 2.0_f64.sqrt());
    // The farthest corner of the box from either end.
    assert!((radius.rigorous - 5.0_f64.sqrt()).abs() < 1e-6, "{radius:?}");
}

#[test]
fn radii_of_flat_cells_are_known() {
    // A square of side 640: 41 samples make cells of 16.
    let plane = extract(&shape("fig5-plane").unwrap());
    let radius = Sampling::new(&plane, 41, SamplingRule::Uniform).radius(&plane);
    let diagonal = 16.0 * 2.0_f64.sqrt();
    assert!((radius.published - 0.5 * diagonal).abs() < 1e-9, "{radius:?}");
    assert!((radius.rigorous - diagonal).abs() < 1e-9, "{radius:?}");
}

#[test]
fn cells_take_in_every_patch_they_touch() {
    // A straight line of three spans: cells of three patches, of one and a half, of a half and one.
    let line = [0.0, 1.0, 2.0, 3.0].map(|x| [x, 0.0, 1.0]);
    let straight = extract(&strip(1, vec![0.0, 0.0, 1.0, 2.0, 3.0, 3.0], &line, 0.0));
    for (samples, length) in [(2, 3.0), (3, 1.5), (4, 1.0), (7, 0.5)] {
        let radius = Sampling::new(&straight, samples, SamplingRule::Uniform).radius(&straight);
        assert!((radius.published - 0.5 * length).abs() < ROUNDING, "{samples}: {radius:?}");
        assert!((radius.rigorous - length).abs() < 1e-11, "{samples}: {radius:?}");
    }
}

#[test]
fn radii_fall_with_the_distance_of_samples() {
    let bezier = extract(&sphere(DVec3::ZERO, 1.0).unwrap());
    let radius = |samples| Sampling::new(&bezier, samples, SamplingRule::Uniform).radius(&bezier).rigorous;
    for samples in [17, 33, 65] {
        let ratio = radius(samples) / radius(2 * samples - 1);
        assert!((1.8..2.3).contains(&ratio), "{samples}: {ratio}");
    }
}

#[test]
fn arc_length_spreads_samples_evenly() {
    // x = t^2, so that x is the arc length; chords of an eighth of the
    // parameter, between which it is taken for linear, are off by 1/256 at most.
    let parabola = [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0]];
    let uneven = strip(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], &parabola, 1.0);
    let bezier = extract(&uneven);
    let off = |rule| {
        let sampling = Sampling::new(&bezier, 17, rule);
        let along = |row: usize| point(&bezier, &sampling, 17 * row).x - row as f64 / 16.0;
        (0..17).map(|row| along(row).abs()).fold(0.0, f64::max)
    };
    assert!(off(SamplingRule::ArcLength) <= 1.0 / 256.0 + ROUNDING, "{}", off(SamplingRule::ArcLength));
    // 1/4 at the middle.
    assert!((off(SamplingRule::Uniform) - 0.25).abs() < ROUNDING);
}

#[test]
fn arc_length_goes_from_end_to_end_over_parts_that_stand_still() {
    // A polyline whose first and last spans are points, of length zero.
    let still = [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [2.0, 0.0, 1.0], [2.0, 0.0, 1.0]];
    let model = strip(1, vec![0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0], &still, 1.0);
    let grid = Sampling::new(&extract(&model), 5, SamplingRule::ArcLength).grids[0].clone();
    assert_eq!([grid.parameters[0][0], grid.parameters[0][4]], [0.0, 4.0]);
    // A surface of no length is sampled by its parameter.
    let point_only = [[1.0, 1.0, 1.0], [1.0, 1.0, 1.0]];
    let model = strip(1, vec![0.0, 0.0, 1.0, 1.0], &point_only, 0.0);
    let grid = Sampling::new(&extract(&model), 3, SamplingRule::ArcLength).grids[0].clone();
    assert_eq!(grid.parameters[0], [0.0, 0.5, 1.0]);
}

fn projected(distance_squared: f64) -> Projected {
    Projected { distance_squared, patch: 0, parameters: [0.0; 2], status: Status::Converged }
}

#[test]
fn reduce_finds_the_largest_of_many_blocks_first() {
    // 0, 7, 14, ... modulo a prime: every value once, in no order.
    let count = 10_007;
    let all: Vec<Projected> = (0..count).map(|index| projected((index * 7 % count) as f64)).collect();
    let found = reduce(&all);
    assert_eq!(all[found[0]].distance_squared, (count - 1) as f64);
    assert!(found.windows(2).all(|pair| all[pair[0]].distance_squared >= all[pair[1]].distance_squared));
    assert!(reduce(&[]).is_empty());
    assert_eq!(reduce(&[projected(2.0), projected(3.0), projected(3.0)])[0], 1);
}

#[test]
fn the_tree_and_all_patches_give_the_same_distances() {
    let (a, b) = (extract(&shape("glass").unwrap()), extract(&shape("bottle").unwrap()));
    let sampling = Sampling::new(&a, 12, SamplingRule::Uniform);
    for flatness in [Flatness::None, Flatness::Loose, Flatness::Tight, Flatness::Curvature] {
        let target = Target::new(flatten(&b.patches, flatness).patches);
        for projection in [Projection::Newton, Projection::TangentPlane] {
            let rule = |culling| Rule { projection, iterations: 5, step_tolerance: 0.01, culling };
            for index in 0..sampling.len() {
                let point = point(&a, &sampling, index);
                let [tree, all] =
                    [Culling::Tree, Culling::None].map(|culling| project(&target, point, &rule(culling)));
                assert_eq!(
                    tree.distance_squared, all.distance_squared,
                    "{flatness:?} {projection:?} {index}"
                );
                let patch = target.patches.patch(tree.patch);
                let foot = patch.point(tree.parameters);
                assert!((foot.distance(point) - tree.distance_squared.sqrt()).abs() < ROUNDING);
            }
        }
    }
}

#[test]
fn projections_on_nothing_are_infinitely_far() {
    let nothing = Target::new(nurbs_hausdorff::internals::bezier::PatchSet::default());
    for culling in [Culling::Tree, Culling::None] {
        let rule = Rule { projection: Projection::Newton, iterations: 5, step_tolerance: 0.01, culling };
        assert_eq!(project(&nothing, DVec3::ZERO, &rule).distance_squared, f64::INFINITY);
    }
}
