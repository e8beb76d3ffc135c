//! The search where Newton's steps do not find the least distance, and its parts on their own.

use super::*;
use crate::bezier::extract;
use crate::closest::Target;
use crate::model::{Model, SurfaceArrays};
use crate::shapes::sphere;

const GOAL: Goal = Goal { tolerance: 1e-6, limit: None };

/// The knots of a Bézier polynomial.
fn knots(degree: usize) -> Vec<f64> {
    [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat()
}

/// A bilinear patch with the corners (0, 0), (0, 1), (1, 0) and (1, 1).
fn bilinear(corners: [[f64; 3]; 4]) -> SurfaceArrays {
    let control_points = corners.map(|[x, y, z]| [x, y, z, 1.0]).to_vec();
    SurfaceArrays { degree: [1, 1], knots: [knots(1), knots(1)], counts: [2, 2], control_points }
}

/// The square [low, high]² at this height.
fn square(low: f64, high: f64, height: f64) -> SurfaceArrays {
    bilinear([[low, low, height], [low, high, height], [high, low, height], [high, high, height]])
}

fn target(surfaces: Vec<SurfaceArrays>) -> Target {
    Target::new(extract(&Model::from_arrays(None, surfaces).unwrap()).patches)
}

fn body(target: &Target, point_error: f64) -> Body<'_> {
    Body { target, control_box: target.tree.nodes()[0].aabb, point_error }
}

fn bodies<'a>(a: &'a Target, b: &'a Target) -> [Body<'a>; 2] {
    [body(a, 0.0), body(b, 0.0)]
}

/// Searches to the end; the interval contains the truth after every step.
fn assert_contained(mut search: Search<'_>, truth: f64) {
    let contains = |search: &Search<'_>| {
        let Interval { lower, upper } = search.interval();
        assert!(lower <= truth && truth <= upper, "{truth} not in [{lower}, {upper}]");
    };
    contains(&search);
    while search.advance(1).is_none() {
        contains(&search);
    }
    contains(&search);
    let Interval { lower, upper } = search.interval();
    assert!(upper - lower <= GOAL.tolerance, "[{lower}, {upper}]");
}

/// A bound that corners of both pieces refute is not relied on, and one that they attain is.
#[test]
fn a_refuted_bound_is_not_relied_on() {
    let [a, b] = [1.0, 0.0].map(|height| target(vec![square(0.0, 1.0, height)]));
    let mut search = Search::without_pairs(bodies(&a, &b), RigidTransform::IDENTITY, GOAL);
    let pieces = [0, 1].map(|side| search.pieces[side].whole(0));
    assert_eq!((search.audited(pieces, 1.0), search.refuted()), (1.0, 0));
    assert_eq!((search.audited(pieces, 1.0 + 1e-9), search.refuted()), (0.0, 1));
    search.bound_pieces(pieces, DVec3::Z, 3.0);
    assert_eq!(search.refuted(), 2);
    assert_contained(search, 1.0);
}

/// Two boxes are as near to the square as the sheet in one of them; the sheet in the other, which
/// is looked at first, is farther off. Before boxes are divided their bound is all that is known.
#[test]
fn the_bound_of_boxes_is_the_distance_while_the_nearest_sheet_is_not_known() {
    let mut is_first_farther = false;
    for sign in [1.0, -1.0] {
        let high = 5.0 * sign;
        let leaning = [[-3.0, -3.0, sign], [-3.0, 4.0, high], [4.0, -3.0, high], [4.0, 4.0, high]];
        let a = target(vec![bilinear(leaning), square(0.25, 0.75, sign)]);
        let b = target(vec![square(0.0, 1.0, 0.0)]);
        let search = Search::new(bodies(&a, &b), RigidTransform::IDENTITY, GOAL);
        is_first_farther |= search.upper() > 2.0 && search.interval().lower > 1.0 - 1e-12;
        assert_contained(search, 1.0);
    }
    assert!(is_first_farther);
}

/// A sheet at 0.9995, and one whose box is nearer than that but whose nearest point, a corner beside
/// the square, is at a distance of 1.
#[test]
fn pairs_a_little_nearer_than_the_nearest_points_found_are_searched() {
    let low = 0.9992_f64;
    let aside = (0.5 * (1.0 - low * low)).sqrt();
    let [near, far] = [-aside, 1.0 + aside];
    let leaning = bilinear([[near, near, low], [near, far, 3.0], [far, near, 3.0], [far, far, 3.0]]);
    let a = target(vec![leaning, square(0.25, 0.75, 0.9995)]);
    let b = target(vec![square(0.0, 1.0, 0.0)]);
    let first = Search::over(bodies(&a, &b), RigidTransform::IDENTITY, GOAL, &[[0, 0]]);
    assert!((first.upper() - 1.0).abs() < 1e-9, "{}", first.upper());
    let both = [[0, 0], [1, 0]];
    assert_contained(Search::over(bodies(&a, &b), RigidTransform::IDENTITY, GOAL, &both), 0.9995);
    let whole = Search::new(bodies(&a, &b), RigidTransform::IDENTITY, GOAL);
    assert!((whole.upper() - 1.0).abs() < 1e-9, "{}", whole.upper());
    assert_contained(whole, 0.9995);
}

/// A gutter whose lowest control point hardly counts and lies at a high end, while the lowest points
/// lie at the other end, in either half: Newton's steps from the middle of the gutter's nearest
/// control point end at the high end.
#[test]
fn both_halves_of_a_piece_are_searched() {
    let profile = [(2.5, 1.0), (-6.0, 0.01), (6.0, 1.0), (-3.0, 1.0), (3.0, 1.0)];
    let height = |t: f64| {
        let bernstein = |k: usize| {
            [1.0, 4.0, 6.0, 4.0, 1.0][k] * t.powi(k as i32) * (1.0 - t).powi(4 - k as i32) * profile[k].1
        };
        let sum = |part: &dyn Fn(usize) -> f64| (0..5).map(part).sum::<f64>();
        sum(&|k| bernstein(k) * profile[k].0) / sum(&bernstein)
    };
    let steps = 100_000;
    let lowest = (0..=steps).map(|k| height(f64::from(k) / f64::from(steps))).fold(f64::INFINITY, lower_min);
    assert!((0.5..2.0).contains(&lowest), "{lowest}");
    let b = target(vec![square(-1.0, 2.0, -7.0)]);
    for is_reversed in [false, true] {
        let mut rows: Vec<(f64, f64)> = profile.to_vec();
        if is_reversed {
            rows.reverse();
        }
        let rows = rows.iter().enumerate();
        let control = |k: usize, z: f64, w: f64| [0.0, 0.01].map(|y| [0.25 * k as f64, y, z, w]);
        let control_points = rows.flat_map(|(k, &(z, w))| control(k, z, w)).collect();
        let (degree, counts) = ([4, 1], [5, 2]);
        let a = target(vec![SurfaceArrays { degree, knots: [knots(4), knots(1)], counts, control_points }]);
        let mut search = Search::over(bodies(&a, &b), RigidTransform::IDENTITY, GOAL, &[[0, 0]]);
        assert!((search.upper() - 9.5).abs() < 1e-2, "{}", search.upper());
        while search.advance(usize::MAX).is_none() {}
        let Interval { lower, upper } = search.interval();
        // The lowest of the samples is at most 1e-8 above the lowest point.
        let [least, most] = [7.0 + lowest - 1e-8, 7.0 + lowest];
        assert!(lower <= most && least <= upper && upper - lower <= GOAL.tolerance, "[{lower}, {upper}]");
    }
}

/// Such a pair counts with its bound, as the theorem of docs/clearance.md asks.
#[test]
fn pairs_that_cannot_be_divided_keep_their_bound() {
    let [a, b] = [1.0, 0.0].map(|height| target(vec![square(0.0, 1.0, height)]));
    let mut search = Search::new(bodies(&a, &b), RigidTransform::IDENTITY, GOAL);
    let smallest = [0, 1].map(|side| {
        let pieces = &mut search.pieces[side];
        let whole = pieces.whole(0);
        (0..MAX_LEVEL).fold(whole, |piece, _| pieces.halves(piece)[0])
    });
    search.queue.clear();
    for (lower, least) in [(0.5, 0.5), (0.25, 0.25), (0.75, 0.25)] {
        search.divide_pieces(smallest, DVec3::Z, lower);
        assert!(search.queue.is_empty());
        assert_eq!(search.lower(), least);
    }
    assert!(search.interval().lower <= 0.25);
    assert_eq!(search.ended(), Some(Stop::Precision));
}

/// The patches of concentric spheres of radii 1 and 0.75, each opposite to its copy.
#[test]
fn the_bound_by_carriers_is_the_distance_of_concentric_spheres() {
    let [a, b] = [0.75, 1.0]
        .map(|radius| Target::new(extract(&sphere(DVec3::new(0.5, -1.0, 2.0), radius).unwrap()).patches));
    for patch in 0..a.patches.len() as u32 {
        let mut search = Search::without_pairs(bodies(&a, &b), RigidTransform::IDENTITY, GOAL);
        search.pairs = CARRIERS_FROM;
        let pieces = [0, 1].map(|side| search.pieces[side].whole(patch));
        let found = search.carrier_distance(pieces);
        assert!(found <= 0.25 && found > 0.25 - 1e-11, "{found}");
        search.divide_pieces(pieces, DVec3::ZERO, 0.0);
        let queued = search.queue.peek().map(|entry| entry.lower).unwrap();
        assert!(queued <= 0.25 && queued > 0.25 - 1e-11, "{queued}");
    }
}

/// Two squares at a distance; with an error of both models they may be that much nearer.
#[test]
fn pairs_are_left_out_only_if_they_are_certainly_farther_apart() {
    let count = |height: f64, error: f64| {
        let [a, b] = [height, 0.0].map(|height| target(vec![square(0.0, 1.0, height)]));
        let bodies = [body(&a, 0.5 * error), body(&b, 0.5 * error)];
        Search::pairs_within(bodies, RigidTransform::IDENTITY, 1.0).len()
    };
    for (height, error, expected) in
        [(0.995, 0.0, 1), (1.0, 0.0, 1), (1.005, 0.0, 0), (1.24, 0.25, 1), (1.26, 0.25, 0)]
    {
        assert_eq!(count(height, error), expected, "{height} with {error}");
    }
}
