//! Random surfaces, simple and as degenerate as validation allows.

use fastrand::Rng;
use glam::DVec3;
use nurbs_hausdorff::SurfaceArrays;

/// The distribution of the weights of a pair's surfaces.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Weights {
    Equal,
    /// 0.2 to 5.
    Moderate,
    /// 10^-4 to 10^4.
    Extreme,
    /// 1, and one of them 10^-6 to 10^6.
    OneOdd,
}

pub(crate) fn weights(rng: &mut Rng) -> Weights {
    match rng.u8(0..10) {
        0..3 => Weights::Equal,
        3..8 => Weights::Moderate,
        8 => Weights::Extreme,
        _ => Weights::OneOdd,
    }
}

pub(crate) fn direction(rng: &mut Rng) -> DVec3 {
    loop {
        let inside = DVec3::new(rng.f64(), rng.f64(), rng.f64()) * 2.0 - DVec3::ONE;
        if inside.length() > 0.1 {
            return inside.normalize();
        }
    }
}

/// Returns 10 to the power of a random number between the two.
pub(crate) fn magnitude(rng: &mut Rng, low: f64, high: f64) -> f64 {
    10_f64.powf(low + (high - low) * rng.f64())
}

/// Returns a random surface of degrees 1 to 7; one in four is degenerate.
pub(crate) fn surface(rng: &mut Rng, weights: Weights) -> SurfaceArrays {
    let degree = [rng.usize(1..=7), rng.usize(1..=7)];
    let counts = degree.map(|degree| degree + 1 + rng.usize(0..=3));
    surface_of_degree(rng, weights, degree, counts)
}

/// Returns a random surface of these degrees and numbers of control points.
pub(crate) fn surface_of_degree(
    rng: &mut Rng,
    weights: Weights,
    degree: [usize; 2],
    counts: [usize; 2],
) -> SurfaceArrays {
    let knots = [0, 1].map(|axis| knots(rng, degree[axis], counts[axis]));
    let (height, noise) = (rng.f64(), rng.f64() * 0.3);
    let shift = direction(rng) * rng.f64();
    let odd = rng.usize(0..counts[0] * counts[1]);
    let mut control_points = Vec::with_capacity(counts[0] * counts[1]);
    for index in 0..counts[0] * counts[1] {
        let at = |k: usize, count: usize| k as f64 / (count - 1) as f64;
        let (x, y) = (at(index / counts[1], counts[0]), at(index % counts[1], counts[1]));
        let z = height * (x * 5.0).sin() * (y * 4.0).cos();
        let point = DVec3::new(x, y, z) + direction(rng) * noise * rng.f64() + shift;
        let weight = match weights {
            Weights::Moderate => 0.2 * 25_f64.powf(rng.f64()),
            Weights::Extreme => magnitude(rng, -4.0, 4.0),
            Weights::OneOdd if index == odd => magnitude(rng, -6.0, 6.0),
            Weights::Equal | Weights::OneOdd => 1.0,
        };
        control_points.push([point.x, point.y, point.z, weight]);
    }
    if rng.u8(0..4) == 0 {
        degenerate(rng, counts, &mut control_points);
    }
    SurfaceArrays { degree, knots, counts, control_points }
}

/// Returns random knots, clamped or not, with repeated and almost coincident knots,
/// over any part of the parameter axis.
fn knots(rng: &mut Rng, degree: usize, count: usize) -> Vec<f64> {
    let clamped = rng.u8(0..4) != 0;
    let close = rng.u8(0..8) == 0;
    let mut knots: Vec<f64> = Vec::with_capacity(count + degree + 1);
    let (mut last, mut run) = (rng.f64() * 4.0 - 2.0, 0);
    for index in 0..count + degree + 1 {
        let at_end = clamped && (1..=degree).contains(&(index % count));
        // An inner knot is repeated at most degree times: a crease, not a gap.
        let inside = index > degree + 1 && index < count;
        let repeated = at_end || (run < degree && inside && rng.u8(0..6) == 0);
        if !repeated {
            last += if inside && close && rng.bool() { magnitude(rng, -9.0, -3.0) } else { 0.05 + rng.f64() };
            run = 0;
        }
        run += 1;
        knots.push(last);
    }
    if rng.u8(0..8) == 0 {
        let scale = magnitude(rng, -5.0, 5.0);
        for knot in &mut knots {
            *knot *= scale;
        }
    }
    knots
}

/// Makes a net degenerate: poles, rows of no length, creases, slivers, curves, points.
pub(crate) fn degenerate(rng: &mut Rng, [rows, columns]: [usize; 2], points: &mut [[f64; 4]]) {
    let copy = |points: &mut [[f64; 4]], from: usize, to: usize| {
        let source = points[from];
        points[to][..3].copy_from_slice(&source[..3]);
    };
    match rng.u8(0..8) {
        // An edge, or two opposite edges, collapse to a point.
        kind @ 0..3 => {
            let along_u = rng.bool();
            let edges = if kind == 0 { [0, 1] } else { [rng.usize(0..2); 2] };
            for edge in edges {
                for k in 0..if along_u { rows } else { columns } {
                    let at = |k: usize| {
                        if along_u {
                            k * columns + edge * (columns - 1)
                        } else {
                            edge * (rows - 1) * columns + k
                        }
                    };
                    copy(points, at(0), at(k));
                }
            }
        }
        // A row equals the one before: a crease, or no first derivative at an edge.
        3 => {
            let row = rng.usize(1..rows);
            for k in 0..columns {
                copy(points, (row - 1) * columns + k, row * columns + k);
            }
        }
        // All first derivatives vanish at a corner.
        4 => {
            for to in [1, columns, columns + 1] {
                copy(points, 0, to);
            }
        }
        // A sliver, a curve or almost one.
        5 => {
            let thin = if rng.bool() { 0.0 } else { magnitude(rng, -12.0, -3.0) };
            for row in points.chunks_exact_mut(columns) {
                let [base, others @ ..] = row else { continue };
                for point in others {
                    for (x, base) in point[..3].iter_mut().zip(&*base) {
                        *x = *base + thin * (*x - *base);
                    }
                }
            }
        }
        // The surface is folded onto itself.
        6 => {
            for row in 0..rows {
                for k in 0..columns / 2 {
                    copy(points, row * columns + k, row * columns + columns - 1 - k);
                }
            }
        }
        // All control points coincide.
        _ => {
            for to in 1..points.len() {
                copy(points, 0, to);
            }
        }
    }
}
