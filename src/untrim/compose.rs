//! The composition of a surface with a ruled map, as one Bézier patch.

use super::curve::{Curve, blossom, casteljau, divided};
use super::face::Face;
use super::ruling::Ruling;
use crate::bezier::Patch;
use crate::chebyshev::{MAX_NODES, coefficients, nodes, to_bernstein};
use crate::limits::MAX_WEIGHT_RATIO;
use crate::model::{NurbsSurface, SurfaceArrays};
use crate::rounding::gamma;
use glam::{DVec2, DVec4, Vec4Swizzles};

/// The highest degree in t of a fit; a cell that needs more is halved.
const MAX_FIT_DEGREE: usize = 12;

/// A patch, and an upper bound on its distance from the composition.
pub(super) struct Composed {
    pub(super) surface: NurbsSurface,
    pub(super) deviation: f64,
}

/// Returns the patch of least degree in t within the tolerance, `None` where no degree
/// allowed reaches it.
///
/// For each t the composition along s is a Bézier curve whose homogeneous controls are
/// blossoms of the surface at the ends of the ruling; they are polynomials in t of a known
/// degree D. Their Chebyshev series of degree D, found from D + 1 values, is truncated: the
/// remainder is the proven error (lemma T4). O(p (p q + q²) D + p D²).
pub(super) fn composed(face: &Face, ruling: &Ruling) -> Option<Composed> {
    let patch = face.patch(ruling.rectangle);
    let degree = composed_degree(face, &patch, ruling);
    if degree >= MAX_NODES {
        return None;
    }
    let rows: Vec<Vec<DVec4>> = nodes(degree + 1).map(|t| across(face, &patch, ruling, t)).collect();
    let order = rows[0].len();
    let series: Vec<Vec<DVec4>> =
        (0..order).map(|i| coefficients(&rows.iter().map(|row| row[i]).collect::<Vec<_>>())).collect();
    let is_polynomial = is_polynomial(face, &patch, ruling);
    let radius = patch.local_points().map(|point| point.length()).fold(0.0, f64::max);
    let least = rows.iter().flatten().map(|value| value.w).fold(f64::INFINITY, f64::min);
    let remainder = |from: usize| {
        let tail = |series: &Vec<DVec4>| {
            series[from..]
                .iter()
                .map(|c| c.xyz().length() + if is_polynomial { 0.0 } else { radius * c.w.abs() })
                .sum::<f64>()
        };
        series.iter().map(tail).fold(0.0, f64::max)
    };
    for fit in 1..=degree.clamp(1, MAX_FIT_DEGREE) {
        // The estimate by sampled weights spares conversions; the bound below is proven.
        let error = if fit >= degree { 0.0 } else { remainder(fit + 1) };
        if error > face.tolerances.fit * least {
            continue;
        }
        let mut controls: Vec<Vec<DVec4>> = series.iter().map(|series| to_bernstein(series, fit)).collect();
        if is_polynomial {
            controls.iter_mut().flatten().for_each(|control| control.w = patch.controls[0].w);
        }
        let weights = controls.iter().flatten().map(|control| control.w);
        let (low, high) = weights.fold((f64::INFINITY, 0.0_f64), |(low, high), w| (low.min(w), high.max(w)));
        if !(low > 0.0 && high < MAX_WEIGHT_RATIO * low && error <= face.tolerances.fit * low) {
            continue;
        }
        let rounding = rounding(&patch, &series, fit, degree, radius, low);
        let arrays = arrays(&patch, &controls, fit);
        let surface = NurbsSurface::new(face.index, arrays).ok()?;
        let twist = if face.affine { face.twist } else { 0.0 };
        return Some(Composed { surface, deviation: error / low + rounding + twist });
    }
    None
}

/// Returns whether patch and map are polynomials, so that all weights are equal.
fn is_polynomial(face: &Face, patch: &Patch<'_>, ruling: &Ruling) -> bool {
    let sides = ruling.left.is_polynomial() && ruling.right.is_polynomial();
    sides && (face.affine || !patch.rational)
}

/// Returns the degree in t of the composition's homogeneous form.
fn composed_degree(face: &Face, patch: &Patch<'_>, ruling: &Ruling) -> usize {
    let [p, q] = patch.degree;
    let (left, right) = (ruling.left.degree(), ruling.right.degree());
    let polynomial = ruling.left.is_polynomial() && ruling.right.is_polynomial();
    match ruling.height {
        Some(_) if face.affine => left,
        Some(height) if polynomial => p * left + q * height,
        Some(_) => left * (p + q),
        None if face.affine && polynomial => left.max(right),
        None if polynomial => (p + q) * left.max(right),
        None if face.affine => left + right,
        None => (p + q) * (left + right),
    }
}

/// Returns the homogeneous controls in s of the composition at t, times a power of the
/// sides' weights that makes them polynomials in t.
fn across(face: &Face, patch: &Patch<'_>, ruling: &Ruling, t: f64) -> Vec<DVec4> {
    let [left, right] = [&ruling.left, &ruling.right].map(|curve: &Curve| curve.at(t));
    let [p, q] = patch.degree;
    let is_matched = ruling.height.is_some();
    if face.affine {
        let c = patch.controls;
        let at = |side: glam::DVec3| side.z * c[0] + side.x * (c[2] - c[0]) + side.y * (c[1] - c[0]);
        let factors = if is_matched { [1.0; 2] } else { [right.z, left.z] };
        return vec![at(left) * factors[0], at(right) * factors[1]];
    }
    let rectangle = face.rectangle(ruling.rectangle);
    let (low, lengths) = (DVec2::from(rectangle.low()), DVec2::from(rectangle.lengths()));
    let [from, to] = [left, right].map(|side| (divided(side) - low) / lengths);
    let weight = (if is_matched { left.z } else { left.z * right.z }).powi((p + q) as i32);
    let columns = patch.controls.chunks_exact(q + 1);
    if is_matched {
        let line: Vec<DVec4> = columns.map(|row| casteljau(row, from.y)).collect();
        return (0..=p).map(|k| weight * blossom(&line, [from.x, to.x], k)).collect();
    }
    // The diagonal of the patch restricted to the ruling's box: the product of Bernstein
    // polynomials of degrees p and q is a multiple of one of degree p + q.
    let rows: Vec<Vec<DVec4>> =
        columns.map(|row| (0..=q).map(|k| blossom(row, [from.y, to.y], k)).collect()).collect();
    let mut controls = vec![DVec4::ZERO; p + q + 1];
    for j in 0..=q {
        let line: Vec<DVec4> = rows.iter().map(|row| row[j]).collect();
        for i in 0..=p {
            let share = crate::chebyshev::binomial(p, i) * crate::chebyshev::binomial(q, j)
                / crate::chebyshev::binomial(p + q, i + j);
            controls[i + j] += weight * share * blossom(&line, [from.x, to.x], i);
        }
    }
    controls
}

/// Returns the arrays of a Bézier patch with these homogeneous controls.
fn arrays(patch: &Patch<'_>, controls: &[Vec<DVec4>], degree: usize) -> SurfaceArrays {
    let along_s = controls.len() - 1;
    let clamped = |degree: usize| {
        let mut knots = vec![0.0; degree + 1];
        knots.extend(vec![1.0; degree + 1]);
        knots
    };
    let control_points = controls
        .iter()
        .flatten()
        .map(|control| (control.xyz() / control.w + patch.center).extend(control.w).to_array())
        .collect();
    SurfaceArrays {
        degree: [along_s, degree],
        knots: [clamped(along_s), clamped(degree)],
        counts: [along_s + 1, degree + 1],
        control_points,
    }
}

/// Returns an upper bound on the rounding of a composed patch (lemma T7): of the values at
/// the nodes, of the series and of its conversion.
fn rounding(
    patch: &Patch<'_>,
    series: &[Vec<DVec4>],
    fit: usize,
    degree: usize,
    radius: f64,
    least_weight: f64,
) -> f64 {
    let [p, q] = patch.degree;
    let size = |c: &DVec4| c.xyz().length() + radius * c.w.abs();
    let largest = series
        .iter()
        .map(|series| {
            series[..=fit.min(degree)]
                .iter()
                .enumerate()
                .map(|(j, c)| conversion_size(j) * size(c))
                .sum::<f64>()
        })
        .fold(0.0, f64::max);
    let roundings = 2.0 * (fit + 1) as f64 * (24.0 * (p + q) as f64 + degree as f64 + 8.0) + 8.0;
    gamma(roundings) * largest / least_weight + gamma(4.0) * (radius + patch.center.length())
}

/// Returns an upper bound on the largest Bernstein coefficient of `T_j(2x - 1)` of any
/// degree from j on: `C(2j, 2i) / C(j, i)` is largest in the middle, and below 2^j.
fn conversion_size(j: usize) -> f64 {
    (j as f64).exp2()
}
