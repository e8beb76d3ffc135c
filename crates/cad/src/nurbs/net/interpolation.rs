//! Piecewise polynomials through points of curves and surfaces that are not rational.

use super::super::conversion::Unconvertible;
use super::super::parameter_map::ParameterMap;
use super::super::spline::Spline;
use super::SurfaceNet;
use glam::DVec3;
use nurbs_hausdorff::workspace::{Interpolation, bernstein};
use std::f64::consts::PI;

/// The degree of the pieces. At the tolerance used, higher and lower degrees need more
/// control points on most offsets.
const DEGREE: usize = 7;

/// The tolerance relative to the size of what is approximated.
const TOLERANCE: f64 = 1e-9;

/// The factor between the deviation measured at [`checks`] and that which is stated: between
/// those the deviation is larger by a few per cent, as a polynomial of degree 8 leads it.
const SAFETY: f64 = 2.0;

/// The most pieces along one parameter, and of a surface.
const MAX_PIECES: usize = 1024;
const MAX_CELLS: usize = 4096;

/// The most rounds of halving: the deviation falls by up to 2⁸ a round.
const MAX_ROUNDS: usize = 12;

/// Returns points between the nodes, near the extrema of the product of their distances.
fn checks() -> [f64; DEGREE] {
    std::array::from_fn(|k| 0.5 - 0.5 * (PI * (k as f64 + 0.5) / DEGREE as f64).cos())
}

/// Points, or Bernstein coefficients, of one piece.
type Row = [DVec3; DEGREE + 1];

/// Returns the Bernstein coefficients of the polynomial with these values at the nodes.
fn coefficients(interpolation: &Interpolation, values: &Row) -> Row {
    let coefficients = interpolation.coefficients(values);
    std::array::from_fn(|k| coefficients[k])
}

/// Returns the nodes of [`DEGREE`] on [0, 1].
fn nodes(interpolation: &Interpolation) -> [f64; DEGREE + 1] {
    std::array::from_fn(|k| interpolation.nodes()[k])
}

/// Returns the sum of values with the Bernstein polynomials, which come first, as factors.
fn combined(weights: &[f64], values: &Row) -> DVec3 {
    values.iter().zip(weights).map(|(&value, &weight)| weight * value).sum()
}

fn within([start, end]: [f64; 2], fraction: f64) -> f64 {
    (1.0 - fraction) * start + fraction * end
}

/// Returns a clamped spline of [`DEGREE`] through points of a curve that is analytic between
/// the breaks, and its deviation: twice the largest measured at 7 points a piece.
///
/// # Errors
/// [`Unconvertible::Offset`] where the points are not finite, or too many pieces are needed.
pub(in crate::nurbs) fn curve(
    point: &dyn Fn(f64) -> DVec3,
    breaks: &[f64],
) -> Result<(Spline, ParameterMap, f64), Unconvertible> {
    let interpolation = Interpolation::new(DEGREE);
    let nodes = nodes(&interpolation);
    let mut breaks = breaks.to_vec();
    let size =
        size(breaks.windows(2).flat_map(|pair| nodes.map(|node| point(within([pair[0], pair[1]], node)))));
    let piece = |pair: &[f64]| {
        let range = [pair[0], pair[1]];
        let coefficients = coefficients(&interpolation, &nodes.map(|node| point(within(range, node))));
        let deviation = |check: f64| {
            combined(&bernstein(DEGREE, check), &coefficients).distance(point(within(range, check)))
        };
        (coefficients, largest(checks().into_iter().map(deviation)))
    };
    for round in 0..=MAX_ROUNDS {
        let pieces: Vec<_> = breaks.windows(2).map(piece).collect();
        let deviation = SAFETY * largest(pieces.iter().map(|(_, deviation)| *deviation));
        let fails = |index: usize| pieces[index].1 > TOLERANCE * size / SAFETY;
        if deviation <= TOLERANCE * size {
            let mut controls = vec![pieces[0].0[0].extend(1.0)];
            controls.extend(
                pieces.iter().flat_map(|(coefficients, _)| &coefficients[1..]).map(|c| c.extend(1.0)),
            );
            let spline = Spline { degree: DEGREE, knots: repeated(&breaks), controls };
            return Ok((spline, ParameterMap::Identity, deviation));
        }
        if !deviation.is_finite() || round == MAX_ROUNDS || breaks.len() > MAX_PIECES {
            break;
        }
        breaks = halved(&breaks, fails);
    }
    Err(Unconvertible::Offset)
}

/// Returns the surface of [`DEGREE`] in both parameters through points of one that is analytic
/// between the breaks. Its error is twice the largest deviation measured at 49 points a cell.
///
/// # Errors
/// As of [`curve`].
pub(super) fn surface(
    point: &dyn Fn(f64, f64) -> DVec3,
    mut breaks: [Vec<f64>; 2],
) -> Result<SurfaceNet, Unconvertible> {
    let interpolation = Interpolation::new(DEGREE);
    let nodes = nodes(&interpolation);
    for _ in 0..=MAX_ROUNDS {
        let counts = breaks.each_ref().map(|breaks| breaks.len() - 1);
        if counts[0].saturating_mul(counts[1]) > MAX_CELLS {
            break;
        }
        let mut cells = Vec::with_capacity(counts[0] * counts[1]);
        for u in breaks[0].windows(2) {
            for v in breaks[1].windows(2) {
                let ranges = [[u[0], u[1]], [v[0], v[1]]];
                let at = |s: f64, t: f64| point(within(ranges[0], s), within(ranges[1], t));
                let values = nodes.map(|s| nodes.map(|t| at(s, t)));
                let rows = values.map(|row| coefficients(&interpolation, &row));
                let columns = transposed(&rows).map(|column| coefficients(&interpolation, &column));
                let controls = transposed(&columns);
                cells.push(Cell::new(controls, &values, &interpolation, &at));
            }
        }
        let size = size(cells.iter().flat_map(|cell| cell.controls.as_flattened().iter().copied()));
        let tolerance = TOLERANCE * size / SAFETY;
        let deviation = largest(cells.iter().map(|cell| cell.deviation));
        if deviation <= tolerance {
            return Ok(assembled(&cells, &breaks, SAFETY * deviation));
        }
        if !deviation.is_finite() {
            break;
        }
        let mut fails = counts.map(|count| vec![false; count]);
        for (index, cell) in cells.iter().enumerate().filter(|(_, cell)| cell.deviation > tolerance) {
            let place = [index / counts[1], index % counts[1]];
            // Along the parameter, or both, in which the lines through the nodes deviate.
            let worst = cell.along[0].max(cell.along[1]);
            for axis in [0, 1] {
                fails[axis][place[axis]] |= cell.along[axis] >= worst || cell.along[axis] > tolerance;
            }
        }
        for (breaks, fails) in breaks.iter_mut().zip(&fails) {
            *breaks = halved(breaks, |index| fails[index]);
        }
    }
    Err(Unconvertible::Offset)
}

/// The polynomial over one cell.
struct Cell {
    controls: [Row; DEGREE + 1],
    deviation: f64,
    /// The deviation of the lines through the nodes along u, and of those along v.
    along: [f64; 2],
}

impl Cell {
    fn new(
        controls: [Row; DEGREE + 1],
        values: &[Row; DEGREE + 1],
        interpolation: &Interpolation,
        point: &dyn Fn(f64, f64) -> DVec3,
    ) -> Self {
        let mut deviation = 0.0_f64;
        let at_checks = checks().map(|check| bernstein(DEGREE, check));
        for (u, s) in at_checks.iter().zip(checks()) {
            let row: Row = transposed(&controls).map(|column| combined(u, &column));
            for (v, t) in at_checks.iter().zip(checks()) {
                let found = combined(v, &row).distance(point(s, t));
                deviation = if found.is_nan() { f64::INFINITY } else { deviation.max(found) };
            }
        }
        let middle = DEGREE / 2;
        let corner = interpolation.nodes()[middle];
        let line = |axis: usize| {
            let fixed: Row = if axis == 0 { transposed(values)[middle] } else { values[middle] };
            let coefficients = coefficients(interpolation, &fixed);
            largest(at_checks.iter().zip(checks()).map(|(weights, check)| {
                let on_surface = if axis == 0 { point(check, corner) } else { point(corner, check) };
                combined(weights, &coefficients).distance(on_surface)
            }))
        };
        Self { controls, deviation, along: [line(0), line(1)] }
    }
}

fn transposed<const N: usize>(values: &[[DVec3; N]; N]) -> [[DVec3; N]; N] {
    std::array::from_fn(|i| std::array::from_fn(|j| values[j][i]))
}

/// Returns the net of cells in the order of u, then v. Neighbours share their nodes, and so
/// the control points of their common edge up to rounding.
fn assembled(cells: &[Cell], breaks: &[Vec<f64>; 2], error: f64) -> SurfaceNet {
    let counts = breaks.each_ref().map(|breaks| DEGREE * (breaks.len() - 1) + 1);
    let columns = breaks[1].len() - 1;
    let place = |index: usize, cells: usize| {
        let cell = (index / DEGREE).min(cells - 1);
        (cell, index - cell * DEGREE)
    };
    let mut controls = Vec::with_capacity(counts[0] * counts[1]);
    for i in 0..counts[0] {
        let (row, k) = place(i, breaks[0].len() - 1);
        for j in 0..counts[1] {
            let (column, l) = place(j, columns);
            controls.push(cells[row * columns + column].controls[k][l].extend(1.0));
        }
    }
    SurfaceNet {
        degrees: [DEGREE; 2],
        knots: breaks.each_ref().map(|breaks| repeated(breaks)),
        controls,
        maps: [ParameterMap::Identity, ParameterMap::Identity],
        error,
        is_measured: true,
    }
}

/// Returns clamped knots with the inner breaks of multiplicity [`DEGREE`].
fn repeated(breaks: &[f64]) -> Vec<f64> {
    let mut knots: Vec<f64> = breaks.iter().flat_map(|&knot| [knot; DEGREE]).collect();
    knots.insert(0, breaks[0]);
    knots.push(breaks[breaks.len() - 1]);
    knots
}

fn halved(breaks: &[f64], fails: impl Fn(usize) -> bool) -> Vec<f64> {
    let mut halved = vec![breaks[0]];
    for (index, pair) in breaks.windows(2).enumerate() {
        if fails(index) {
            halved.push(0.5 * (pair[0] + pair[1]));
        }
        halved.push(pair[1]);
    }
    halved
}

/// Returns the largest value; NaN counts as +∞.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |largest, value| if value.is_nan() { f64::INFINITY } else { largest.max(value) })
}

/// Returns the diagonal of the box of points.
fn size(points: impl Iterator<Item = DVec3>) -> f64 {
    let [low, high] = points
        .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], point| [low.min(point), high.max(point)]);
    low.distance(high)
}
