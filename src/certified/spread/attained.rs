//! Cells in which the bounds of lemmas S1 to S4 are attained: each term that is left out falsifies one.

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

/// The weight of a cell of a surface over a plane.
fn weight(net: Net, cell: Cell) -> Weight {
    let [a, b] = [net, plane([-2.0, 3.0])].map(|net| PatchModel::new(&[net]));
    let pair = pair(&a, &b);
    let spreads = Spreads::new(pair, Density::OfPatch, 1e-6);
    let context = CellContext::new(&pair, &spreads.nearest, cell, &spreads.start().foot);
    Weight::new(Density::OfPatch, &context)
}

/// The surface (x(s), y(t), z(s, t)) of cubics by the powers of s and t in x and y, and of the quadratic z = turn (s − 1/2)²;
/// with `is_turned` s and t are exchanged.
fn surface([x, y]: [[f64; 4]; 2], turn: f64, is_turned: bool) -> Net {
    // The Bernstein coefficients of a cubic by its powers.
    let controls = |[a, b, c, d]: [f64; 4]| [a, a + b / 3.0, a + 2.0 * b / 3.0 + c / 3.0, a + b + c + d];
    let ([x, y], z) = ([x, y].map(controls), controls([0.25 * turn, -turn, turn, 0.0]));
    let control = |i: usize, j: usize| {
        let [s, t] = if is_turned { [j, i] } else { [i, j] };
        DVec4::new(x[s], y[t], z[s], 1.0)
    };
    ([3, 3], (0..4).flat_map(|i| (0..4).map(move |j| control(i, j))).collect())
}

const LINEAR: [f64; 4] = [0.0, 1.0, 0.0, 0.0];

/// S3: the density of (s², t) is 2 s, which the weight of the cell is in proportion to.
#[test]
fn a_linear_density_has_no_ratio() {
    let squares = [[0.0, 0.0, 1.0, 0.0], LINEAR];
    let cell = Cell { half: [0.25; 2], ..WHOLE };
    for is_turned in [false, true] {
        let Weight { tilt, ratio } = weight(surface(squares, 0.0, is_turned), cell);
        let [along, across] = if is_turned { [tilt[1], tilt[0]] } else { tilt };
        assert!((along - 0.5).abs() < 1e-9 && across.abs() < 1e-9, "{tilt:?}");
        assert_attained(ratio, 1.0, 1e-9);
    }
}

/// S3, attained: the density of a cubic x with its turning point at the cell's centre, 1 + 3 (s − 1/2)², is that of its
/// remainder.
#[test]
fn the_remainder_of_a_derivative_is_in_the_ratio() {
    // s + (s − 1/2)³.
    let cubic = [-0.125, 1.75, -1.5, 1.0];
    let h = 0.25;
    for is_turned in [false, true] {
        let Weight { tilt, ratio } =
            weight(surface([cubic, LINEAR], 0.0, is_turned), Cell { half: [h; 2], ..WHOLE });
        assert!(tilt.iter().all(|part| part.abs() < 1e-9), "{tilt:?}");
        // The bound takes the remainder to either side.
        let rest = 3.0 * h * h;
        assert_attained(ratio, (1.0 + rest) / (1.0 - rest), 1e-6);
    }
}

/// S3, attained: (x, y) = (s + s²/2, t + t²/2) about 0 has the density (1 + s)(1 + t), whose product of changes is that of the
/// corner.
#[test]
fn the_product_of_changes_is_in_the_ratio() {
    let half = 0.125;
    // About the centre 1/2, with derivatives 1 and second derivatives 1.
    let square = [0.0, 0.5, 0.5, 0.0];
    let Weight { tilt, ratio } = weight(surface([square; 2], 0.0, false), Cell { half: [half; 2], ..WHOLE });
    assert!(tilt.iter().all(|part| (part - half).abs() < 1e-9), "{tilt:?}");
    let least = 1.0 - 2.0 * half;
    assert_attained(ratio, (least + half * half) / (least - half * half), 1e-6);
}

/// S3, attained up to the fourth order: the normal of a cylinder turns across itself, and its density is √(1 + 4c²(s − 1/2)²).
#[test]
fn a_turn_across_the_normal_is_in_the_ratio() {
    let (turn, h) = (0.5, 0.25);
    for is_turned in [false, true] {
        let cell = Cell { half: [h; 2], ..WHOLE };
        let Weight { tilt, ratio } = weight(surface([LINEAR; 2], turn, is_turned), cell);
        assert!(tilt.iter().all(|part| part.abs() < 1e-9), "{tilt:?}");
        let across = 2.0 * turn * h;
        assert!(ratio >= (1.0 + across * across).sqrt(), "{ratio}");
        assert_attained(ratio, 1.0 + 0.5 * across * across, 1e-6);
    }
}

/// S4, attained: the distances of a plane cell above a plane are linear, so that each share is that of a formula; by the
/// ends of the cell all of it would be open.
#[test]
fn the_shares_of_a_slope_are_known() {
    let a = bilinear([[0.0, 0.0, 1.0], [0.0, 1.0, 1.25], [1.0, 0.0, 1.5], [1.0, 1.0, 1.75]]);
    let found = spread(&a, &plane([-2.0, 3.0]), WHOLE, (Density::OfPatch, 1e-6), FAR);
    let linear = found.linear.unwrap();
    // An apex that is not infinitely far takes the square of the radius over twice its distance.
    assert!(linear.thickness() <= 2.0 / FAR, "{linear:?}");
    // z − 1 is x / 2 + y / 4: below 1/4 there is a triangle with the sides 1/2 and 1, above 1/2 the same.
    for (limit, share) in [(1.25, 0.75), (1.375, 0.5), (1.5, 0.25)] {
        let [less, more] = linear.beyond(limit);
        assert!(less <= share && share <= more && more - less <= 8.0 / FAR, "{less} {share} {more}");
    }
}

/// S4: between its bounds are the distances of all places of a cell of a sphere that another one crosses, at the slopes that
/// they have there.
#[test]
fn distances_of_a_cell_are_between_its_linear_bounds() {
    use crate::certified::testing::Surfaces;
    use crate::model::RigidTransform;
    use crate::shapes::sphere;
    let center = DVec3::new(0.25, -0.125, 0.5);
    let [a, b] = [(DVec3::ZERO, 1.0), (center, 1.125)]
        .map(|(center, radius)| Surfaces::of(&sphere(center, radius).unwrap()));
    let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
    let spreads = Spreads::new(pair, Density::OfPatch, 1e-6);
    let random = &mut fastrand::Rng::with_seed(21);
    let (mut known, mut small, mut narrow) = (0, 0, 0);
    for _ in 0..300 {
        let half = [0; 2].map(|_| 0.5_f64.powi(random.i32(3..9)));
        let place = [0, 1].map(|axis| half[axis] + (1.0 - 2.0 * half[axis]) * random.f64());
        let cell = Cell { patch: random.u32(0..8), center: place, half };
        let Some(linear) = spreads.of(cell, &spreads.start()).linear else { continue };
        known += 1;
        for index in 0..81 {
            let at = [index / 9, index % 9].map(|k| f64::from(k) / 4.0 - 1.0);
            let distance = (pair.point_of_a(cell.patch, cell.at(at)).distance(center) - 1.125).abs();
            let [low, high] = linear.at(at);
            assert!(low <= distance + 1e-12 && distance <= high + 1e-12, "{low} {distance} {high}");
        }
        if half.iter().all(|half| *half < 0.01) {
            small += 1;
            narrow += u32::from(linear.thickness() < 3e-3);
        }
    }
    // Distances of a small cell differ by up to 0.02. Beside a pole of the other sphere a foot is no map.
    assert!(known > 150 && narrow > 20 && 10 * narrow >= 9 * small, "{known} {narrow} {small}");
}
