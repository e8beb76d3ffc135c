//! Tests in which the terms of the bound by sliding feet are needed: overshoots of rational
//! differences, patches and gaps behind seams, and rounding.

use super::super::orientation::Orientation;
use super::Sliding;
use crate::certified::reparametrization::Reparametrization;
use crate::certified::rounding::UNIT_ROUNDOFF;
use crate::certified::sheets::{Chart, Over};
use crate::certified::testing::{Surfaces, clamped};
use crate::flatness::Flatness;
use crate::model::SurfaceArrays;
use glam::{DVec2, DVec3, DVec4};

fn orientation(swapped: bool) -> Orientation {
    let (p, q) = if swapped { (DVec2::Y, DVec2::X) } else { (DVec2::X, DVec2::Y) };
    Orientation::new(&Reparametrization { p, q })
}

/// A surface over the unit square that is constant along y, with these points along x.
fn profile(degree: usize, interior: &[f64], points: &[[f64; 2]]) -> Surfaces {
    let arrays = SurfaceArrays {
        degree: [degree, 1],
        counts: [points.len(), 2],
        knots: [clamped(degree, interior), clamped(1, &[])],
        control_points: points.iter().flat_map(|&[x, z]| [0.0, 1.0].map(|y| [x, y, z, 1.0])).collect(),
    };
    Surfaces::new(vec![arrays], Flatness::None)
}

/// The bound, from an image in a patch, for a step of 0.3 of the patch towards the seam.
fn over_the_seam(b: &Surfaces, patch: u32, backwards: bool) -> f64 {
    let chart = Chart::new(b.sheets(), patch, [0.5; 2]);
    let (along, sign) = if backwards { ([0.2, 0.3], -1.0) } else { ([0.7, 0.8], 1.0) };
    let sliding = Sliding::new(&chart, [0, 0], [along, [0.25, 0.75]], orientation(false));
    let step = sign * 0.3 * chart.jet().s;
    sliding.upper_bound([1, 1], &[step.extend(1.0); 4], 1.0).unwrap_or(f64::INFINITY)
}

/// One line of the difference moves the feet in the middle of an image beyond the end of the
/// surface, by 0.07, because its weights differ; at both ends of the line they stay on it.
#[test]
fn an_overshoot_depends_on_the_weights_of_every_line() {
    let b = profile(1, &[], &[[0.0, 0.0], [4.0, 0.0]]);
    let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
    for (axis, tangent) in [(0, 4.0 * DVec3::X), (1, DVec3::Y)] {
        for (swapped, moved_line) in [(false, 0), (false, 1), (true, 0), (true, 1)] {
            let mut image = [[0.25, 0.75]; 2];
            image[axis] = [0.5, 1.0];
            let sliding = Sliding::new(&chart, [0, 0], image, orientation(swapped));
            let along = usize::from((axis == 1) != swapped);
            let quotient: Vec<DVec4> = (0..4)
                .map(|index| {
                    let place = [index / 2, index % 2];
                    let is_moved = place[along] == 0 && place[1 - along] == moved_line;
                    let weight = if place[along] == 0 { 0.25 } else { 0.0625 };
                    let difference = if is_moved { 0.4 * tangent } else { DVec3::ZERO };
                    weight * difference.extend(1.0)
                })
                .collect();
            // φ + δ = 3/4 + 0.4 · 4/5 in the middle; the coefficient is (0.5 + 4 · 1.4) / 5.
            let bound = sliding.upper_bound([1, 1], &quotient, 1.0).unwrap_or(f64::INFINITY);
            let bound = bound / tangent.length();
            assert!((0.07..0.2201).contains(&bound), "{axis} {swapped} {moved_line}: {bound}");
        }
    }
}

/// A flat patch beside one that bends away from it: a step over the seam leaves what the other
/// one bends, 0.01 after a fifth of half its length, though the patch of the image has no bend.
#[test]
fn a_step_over_a_seam_leaves_the_bend_behind_it() {
    let b = profile(2, &[0.5], &[[0.0, 0.0], [0.25, 0.0], [0.75, 0.0], [1.0, 1.0]]);
    let bound = over_the_seam(&b, 0, false);
    assert!((0.01..0.2).contains(&bound), "{bound}");
    let b = profile(2, &[0.5], &[[0.0, 1.0], [0.25, 0.0], [0.75, 0.0], [1.0, 0.0]]);
    let bound = over_the_seam(&b, 1, true);
    assert!((0.01..0.2).contains(&bound), "{bound}");
}

/// Over two creases on one side, the derivatives' jumps add up: slopes 0, 1 and 3 of the height.
#[test]
fn the_jumps_of_two_creases_add_up() {
    const SLOPE: f64 = 1e-3;
    let points = [[0.0, 0.0], [0.4, 0.0], [0.6, 0.2 * SLOPE], [1.0, 1.4 * SLOPE]];
    let b = profile(1, &[0.4, 0.6], &points);
    let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
    let sliding = Sliding::new(&chart, [0, 0], [[0.7, 0.8], [0.25, 0.75]], orientation(false));
    let quotient = [(0.8 * chart.jet().s).extend(1.0); 4];
    let bound = sliding.upper_bound([1, 1], &quotient, 1.0).unwrap_or(f64::INFINITY);
    // A step of 0.8 of the patch, 0.32, at the slope of the last patch.
    let lemma = 3.0 * SLOPE * 0.32;
    assert!((lemma..1.000_001 * lemma).contains(&bound), "{bound} {lemma}");
}

/// Feet that reach just the end of a surface may be beyond it by the rounding of their places.
#[test]
fn the_rounding_of_places_is_added() {
    let b = profile(1, &[], &[[0.0, 0.0], [1.0, 0.0]]);
    let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
    let sliding = Sliding::new(&chart, [0, 0], [[0.5, 0.75], [0.25, 0.75]], orientation(false));
    let quotient = [(0.25 * chart.jet().s).extend(1.0); 4];
    let beyond = sliding.overshoot(0, [1, 1], &quotient, [0.0, 1.0]);
    let lemma = 16.0 * UNIT_ROUNDOFF * (1.0 + 0.25);
    assert!((lemma..2.0 * lemma).contains(&beyond), "{beyond:e} {lemma:e}");
}

/// Of a difference across the surface nothing slides, and 16 roundings of each of the three terms
/// of `N D` are added.
#[test]
fn the_rounding_of_residuals_is_added() {
    const HEIGHT: f64 = 128.0;
    let b = profile(1, &[], &[[0.0, 0.0], [1.0, 0.0]]);
    let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
    let sliding = Sliding::new(&chart, [0, 0], [[0.25, 0.75]; 2], orientation(false));
    let quotient = [(HEIGHT * DVec3::Z).extend(1.0); 4];
    let bound = sliding.upper_bound([1, 1], &quotient, 2.0 * HEIGHT).unwrap_or(f64::INFINITY);
    let lemma = 3.0 * 16.0 * UNIT_ROUNDOFF * HEIGHT;
    assert!((HEIGHT + lemma..HEIGHT + 3.0 * lemma).contains(&bound), "{:e} {lemma:e}", bound - HEIGHT);
}

/// Steps are the longest of any coefficient, and 16 roundings of their terms are added, although
/// differences across the surface make none.
#[test]
fn the_rounding_of_steps_is_added() {
    const HEIGHT: f64 = 128.0;
    let b = profile(1, &[], &[[0.0, 0.0], [4.0, 0.0]]);
    let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
    let sliding = Sliding::new(&chart, [0, 0], [[0.25, 0.75]; 2], orientation(false));
    let [along_s, along_t] = sliding.steps(&[(HEIGHT * DVec3::Z).extend(1.0); 4], HEIGHT);
    // The rows of P are a quarter of an edge of the chart and an edge.
    for (step, row) in [(along_s, 0.25), (along_t, 1.0)] {
        let lemma = 16.0 * UNIT_ROUNDOFF * row * HEIGHT;
        assert!((lemma..2.0 * lemma).contains(&step), "{step:e} {lemma:e}");
    }
    let across = (HEIGHT * DVec3::Z).extend(1.0);
    for place in 0..4 {
        let mut quotient = [across; 4];
        quotient[place] = DVec4::new(-4.0, 0.5, 0.0, 2.0);
        let [along_s, along_t] = sliding.steps(&quotient, HEIGHT);
        assert!((0.5..0.501).contains(&along_s) && (0.25..0.251).contains(&along_t), "{along_s} {along_t}");
    }
}

/// For short steps from one point the rounding of the tangents is what is left.
#[test]
fn the_rounding_of_tangents_is_added() {
    const STEP: f64 = 1e-8;
    let b = profile(1, &[], &[[0.0, 0.0], [1.0, 0.0]]);
    let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
    let reach = chart.reach_over_creases([STEP; 2]);
    let error = chart.step_error(&reach, [0.0; 2], [STEP; 2], Over::Patches);
    assert!(error >= 4.0 * UNIT_ROUNDOFF * STEP, "{error:e}");
}

/// A gap at a seam, of points that validation takes as joined, is in the bound.
#[test]
fn a_step_over_a_seam_leaves_its_gap() {
    const GAP: f64 = 2e-10;
    let points = [[0.0, 0.0], [0.5, 0.0], [0.5, GAP], [1.0, GAP]];
    let b = profile(1, &[0.5, 0.5], &points);
    for (patch, backwards) in [(0, false), (1, true)] {
        let bound = over_the_seam(&b, patch, backwards);
        assert!((GAP..1.01 * GAP).contains(&bound), "{bound:e}");
    }
}

/// Boxes and sums of bounds are widened by 16 roundings, also what is beyond an end.
#[test]
fn boxes_and_sums_are_widened() {
    const WIDENED: f64 = 1.0 + 16.0 * UNIT_ROUNDOFF;
    const HEIGHT: f64 = 0.125;
    let b = profile(1, &[], &[[0.0, 0.0], [1.0, 0.0]]);
    let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
    for (image, half) in [([0.5, 0.75], 0.125), ([0.75, 0.5], 0.125)] {
        let sliding = Sliding::new(&chart, [0, 0], [image, [0.25, 0.75]], orientation(false));
        assert!(sliding.half[0] >= WIDENED * half && sliding.half[1] >= WIDENED * 0.25, "{sliding:?}");
        let difference = 0.5 * chart.jet().s + HEIGHT * DVec3::Z;
        let (longest, quotient) = (difference.length(), [difference.extend(1.0); 4]);
        // The tangents and the rows of P have length 1.
        let residual = HEIGHT + 3.0 * 16.0 * UNIT_ROUNDOFF * longest;
        let steps = sliding.steps(&quotient, longest);
        let extent = [0, 1].map(|axis| sliding.half[axis] + steps[axis]);
        let reach = sliding.chart.reach_over_creases(extent);
        let beyond = sliding.overshoot(0, [1, 1], &quotient, reach.domain[0]);
        let of_steps = sliding.chart.step_error(&reach, sliding.half, steps, Over::Patches);
        let expected = WIDENED * (residual + WIDENED * beyond + of_steps);
        let bound = sliding.upper_bound([1, 1], &quotient, 1.0).unwrap_or(f64::INFINITY);
        assert!((bound / expected - 1.0).abs() <= 3.0 * UNIT_ROUNDOFF, "{bound} {expected}");
    }
}

/// A surface of two by two bilinear patches over the unit square. Its control points have these heights at
/// x = 0, 1/2, 1/2 and 1 and at y = 0, 1/2 and 1. The knot 1/2 is double along x, so that the surface may jump
/// there. `transposed` exchanges x and y.
fn four_patches(heights: [[f64; 3]; 4], transposed: bool) -> Surfaces {
    let (xs, ys) = ([0.0, 0.5, 0.5, 1.0], [0.0, 0.5, 1.0]);
    let [along, across] = [clamped(1, &[0.5, 0.5]), clamped(1, &[0.5])];
    let arrays = if transposed {
        let points = (0..3).flat_map(|j| (0..4).map(move |i| [ys[j], xs[i], heights[i][j], 1.0]));
        let control_points = points.collect();
        SurfaceArrays { degree: [1, 1], counts: [3, 4], knots: [across, along], control_points }
    } else {
        let points = (0..4).flat_map(|i| (0..3).map(move |j| [xs[i], ys[j], heights[i][j], 1.0]));
        let control_points = points.collect();
        SurfaceArrays { degree: [1, 1], counts: [4, 3], knots: [along, across], control_points }
    };
    Surfaces::new(vec![arrays], Flatness::None)
}

/// Seams count along both axes, by the largest jump on each line: creases, gaps, and gaps that grow along the
/// seam.
#[test]
fn seams_count_by_their_largest_jumps() {
    const RISE: f64 = 1e-3;
    const GAP: f64 = 2e-10;
    const STEP: f64 = 0.25;
    let flat = [0.0; 3];
    for transposed in [false, true] {
        let by_axes = |[along, across]: [f64; 2]| if transposed { [across, along] } else { [along, across] };
        let error = |heights: [[f64; 3]; 4], half: [f64; 2], steps: [f64; 2]| {
            let b = four_patches(heights, transposed);
            let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
            let reach = chart.reach_over_creases([4.0; 2]);
            let gap = chart.gap(&reach, by_axes(half));
            (chart.step_error(&reach, by_axes(half), by_axes(steps), Over::Patches), gap)
        };
        let close = |found: f64, lemma: f64| {
            assert!((lemma..1.01 * lemma).contains(&found), "{found:e} {lemma:e} {transposed}");
        };
        // A crease of RISE at the start of the line that vanishes over the first patch: M_st is RISE, too.
        let (found, _) = error([flat, flat, flat, [RISE, 0.0, 0.0]], [0.75, 0.75], [STEP, 0.0]);
        close(found, (0.75 * RISE + RISE) * STEP);
        // A gap that vanishes over the first patch, and one over both.
        let [first, both] = [[GAP, 0.0, 0.0], [GAP; 3]];
        let (found, gap) = error([flat, flat, first, first], [0.75, 0.125], [0.0, STEP]);
        close(gap, GAP);
        close(found, GAP + GAP * STEP);
        close(error([flat, flat, first, first], [0.75, 0.75], [0.0, 0.0]).1, GAP);
        close(error([flat, flat, both, both], [0.75, 0.75], [0.0, 0.0]).1, GAP);
    }
    // Over two lines the gaps add up.
    let points = [[0.0, 0.0], [0.4, 0.0], [0.4, GAP], [0.6, GAP], [0.6, 0.0], [1.0, 0.0]];
    let b = profile(1, &[0.4, 0.4, 0.6, 0.6], &points);
    let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
    let reach = chart.reach_over_creases([2.0, 0.25]);
    let gap = chart.gap(&reach, [1.25, 0.25]);
    assert!((2.0 * GAP..2.02 * GAP).contains(&gap), "{gap:e}");
}
