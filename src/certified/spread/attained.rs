//! Cells in which the bounds of lemmas S1 to S3 are attained: each term that is left out falsifies one.

use super::*;
use crate::certified::testing::{Net, PatchModel, assert_attained, bilinear, graph, pair, plane, point};
use glam::DVec4;

/// The distance of an apex that is so far behind a cell that its sphere is nearly a plane.
const FAR: f64 = 1e3;

/// A cell that is all of its patch.
const WHOLE: Cell = Cell { patch: 0, center: [0.5; 2], half: [0.5; 2] };

/// The bounds over a cell of A, with an apex at this distance.
fn spread(a: &Net, b: &Net, cell: Cell, (density, sufficient): (Density, f64), apex: f64) -> CellSpread {
    let [a, b] = [a, b].map(|net| PatchModel::new(std::slice::from_ref(net)));
    let spreads = Spreads::new(pair(&a, &b), density, sufficient);
    spreads.of(cell, &SpreadStart { apex, ..spreads.start() })
}

/// The graph z = height + factor (s − 1/2)³ over the unit square: at its middle it is its own third-order term.
fn cubic(height: f64, factor: f64) -> Net {
    let in_s = [-0.125, 0.125, -0.125, 0.125];
    let control = |i: usize, t: f64| DVec4::new(i as f64 / 3.0, t, height + factor * in_s[i], 1.0);
    ([3, 1], (0..4).flat_map(|i| [0.0, 1.0].map(|t| control(i, t))).collect())
}

/// S1 and S2: a cubic differs from its tangent plane by the remainder of third order alone, so that the bounds attain it.
#[test]
fn remainders_count_above_and_from_an_apex() {
    let (a, b) = (cubic(0.25, 0.4), plane([-2.0, 3.0]));
    let found = spread(&a, &b, WHOLE, (Density::OfPatch, 1e-6), FAR);
    assert_attained(found.all[1], 0.25 + 0.4 / 8.0, 1e-3);
    let least = 0.25 - 0.4 / 8.0;
    // An apex that is not infinitely far takes the square of the radius over twice its distance.
    assert!(found.all[0] <= least && found.all[0] >= least - 1.0 / FAR, "{found:?}");
}

/// S1: the lower end lies below the distance of a point of the cell, by the width of the apex's certified distance at
/// least.
#[test]
fn the_least_distance_is_not_above_a_point_of_the_cell() {
    let a = graph(0.25, 0.0, [0, 0]);
    for b in [point([0.5, 0.5, 0.0]), plane([-2.0, 3.0])] {
        let cell = Cell { half: [0.5_f64.powi(10); 2], ..WHOLE };
        let found = spread(&a, &b, cell, (Density::OfPatch, 0.1), 1.0);
        assert!(found.all[0] <= 0.25 + 1e-9 && found.mean[0] <= 0.25 + 1e-5, "{found:?}");
        assert!(found.all[0] > 0.24 && found.all[1] >= 0.25, "{found:?}");
    }
}

/// S2: over a triangle, that is by a density in proportion to s, the mean of 1 + s / 2 is 4/3; by one that falls with
/// s it would be 7/6.
#[test]
fn a_triangle_has_its_area_at_the_side_across_its_corner() {
    let a = bilinear([[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.5], [0.0, 1.0, 1.5]]);
    let found = spread(&a, &plane([-2.0, 3.0]), WHOLE, (Density::OfTriangle, 1e-6), FAR);
    let mean = 4.0 / 3.0;
    assert!(found.mean[0] <= mean && mean <= found.mean[1], "{found:?}");
    assert!(found.mean[1] - found.mean[0] < 0.1, "{found:?}");
}

/// S3, attained: the density of (s², t) is 2 s, three times as large at one end of the cell as at the other.
#[test]
fn the_ratio_of_densities_is_that_of_the_ends() {
    let in_s = [0.0, 0.0, 1.0];
    let control = |i: usize, t: f64| DVec4::new(in_s[i], t, 0.25, 1.0);
    let net: Net = ([2, 1], (0..3).flat_map(|i| [0.0, 1.0].map(|t| control(i, t))).collect());
    let [a, b] = [net, plane([-2.0, 3.0])].map(|net| PatchModel::new(&[net]));
    let pair = pair(&a, &b);
    let spreads = Spreads::new(pair, Density::OfPatch, 1e-6);
    let cell = Cell { half: [0.25; 2], ..WHOLE };
    let context = CellContext::new(&pair, &spreads.nearest, cell, &spreads.start().foot);
    assert_attained(spreads.density_ratio(&context), 3.0, 1e-6);
}
