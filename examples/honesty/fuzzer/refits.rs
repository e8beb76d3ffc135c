//! Near copies with other knots, as fitters and translators make them.

use super::partners::{cut, near, refined};
use super::surfaces::{Weights, magnitude, surface};
use fastrand::Rng;
use nurbs_hausdorff::shapes::operations::refit_surface;
use nurbs_hausdorff::{NurbsSurface, SurfaceArrays};

/// A model with a near copy.
pub(crate) struct Refit {
    pub(crate) a: Vec<SurfaceArrays>,
    pub(crate) b: Vec<SurfaceArrays>,
}

/// Returns a random model and a refit of it, a copy that is cut elsewhere and
/// edited, or a closed surface and its copy that starts at another point; in
/// either order.
pub(crate) fn refit(rng: &mut Rng) -> Refit {
    let (a, b) = match rng.u8(0..3) {
        0 => refitted(rng),
        1 => cut_elsewhere(rng),
        _ => closed(rng),
    };
    if rng.bool() { Refit { a, b } } else { Refit { a: b, b: a } }
}

/// One surface interpolated by a bicubic spline, exactly where it is one cubic.
fn refitted(rng: &mut Rng) -> (Vec<SurfaceArrays>, Vec<SurfaceArrays>) {
    let weights = if rng.bool() { Weights::Equal } else { Weights::Moderate };
    let a = surface(rng, weights);
    let counts = [rng.usize(4..14), rng.usize(4..14)];
    let refit = refit_surface(&NurbsSurface::new(0, a.clone()).unwrap(), counts).unwrap();
    (vec![a], vec![refit.into_arrays()])
}

/// Copies with further knots, in pieces, and with control points moved by a little or
/// not at all.
fn cut_elsewhere(rng: &mut Rng) -> (Vec<SurfaceArrays>, Vec<SurfaceArrays>) {
    let weights = if rng.bool() { Weights::Equal } else { Weights::Moderate };
    let original = vec![surface(rng, weights)];
    let copy = |rng: &mut Rng| {
        let mut copy = original.clone();
        for _ in 0..rng.usize(0..3) {
            copy = if rng.bool() { refined(rng, &copy) } else { cut(rng, &copy) };
        }
        let size = magnitude(rng, -16.0, -2.0);
        if rng.bool() { near(rng, &copy, size) } else { copy }
    };
    (copy(rng), copy(rng))
}

/// A surface that is closed along u, of uniform knots, and the same with its
/// control points numbered from another one, refined or edited.
fn closed(rng: &mut Rng) -> (Vec<SurfaceArrays>, Vec<SurfaceArrays>) {
    let degree = [rng.usize(2..5), rng.usize(1..4)];
    let counts = [degree[0] + 1 + rng.usize(1..6), degree[1] + 1 + rng.usize(0..3)];
    let is_rational = rng.bool();
    let noise = 0.3 * rng.f64();
    let around = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / counts[0] as f64;
        [angle.cos(), angle.sin()]
    };
    let mut net = Vec::with_capacity(counts[0] * counts[1]);
    for i in 0..counts[0] {
        let [x, y] = around(i);
        for j in 0..counts[1] {
            let radius = 1.0 + noise * rng.f64();
            let weight = if is_rational { 0.3 + rng.f64() } else { 1.0 };
            net.push([radius * x, radius * y, j as f64 / degree[1] as f64 + noise * rng.f64(), weight]);
        }
    }
    let from = |start: usize| {
        let rows = counts[0] + degree[0];
        let points = (0..rows).flat_map(|i| {
            let row = (start + i) % counts[0] * counts[1];
            net[row..row + counts[1]].to_vec()
        });
        let clamped = |count: usize, degree: usize| {
            (0..=count + degree).map(move |k| k.clamp(degree, count) as f64).collect::<Vec<_>>()
        };
        SurfaceArrays {
            degree,
            knots: [(0..=rows + degree[0]).map(|k| k as f64).collect(), clamped(counts[1], degree[1])],
            counts: [rows, counts[1]],
            control_points: points.collect(),
        }
    };
    let a = vec![from(0)];
    let mut b = vec![from(rng.usize(0..counts[0]))];
    if rng.bool() {
        b = refined(rng, &b);
    }
    let size = magnitude(rng, -12.0, -3.0);
    let b = if rng.bool() { near(rng, &b, size) } else { b };
    (a, b)
}
