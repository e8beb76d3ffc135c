//! The composition of a surface with a ruled map, as one Bézier patch.

mod proof;

use super::cells::ruling::Ruling;
use super::curve::{Curve, casteljau, divided, restricted};
use super::face::UnitFace;
use crate::approximation::bernstein::binomial;
use crate::approximation::chebyshev::{MAX_NODES, coefficients, nodes, to_bernstein};
use crate::axis::Axis;
use crate::bezier::{Patch, extract, power_of_two_below};
use crate::error::Result;
use crate::limits::MAX_WEIGHT_RATIO;
use crate::model::{Model, NurbsSurface, SurfaceArrays};
use crate::param_box::ParamBox;
use crate::rounding::upper_max;
use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};
use proof::Composition;

/// The highest degree in t of a fit; a cell that needs more is halved.
const MAX_FIT_DEGREE: usize = 12;

/// The estimated error of a fit, relative to the tolerance, for which the proof is tried: it
/// gives up to eight times the largest error, the product of the node factors of s and of t.
const ESTIMATE: f64 = 0.125;

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
/// degree D. Their Chebyshev series of degree D, found from D + 1 values, is truncated. The
/// deviation is that which [`Composition::deviation`] proves of the finished patch.
/// O(p (p q + q²) D + p D²).
pub(super) fn composed(face: &UnitFace, ruling: &Ruling) -> Option<Composed> {
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
    let composition = Composition { face, patch, ruling, degree: [order - 1, degree] };
    let radius = composition.radius();
    let least = rows.iter().flatten().map(|value| value.w).fold(f64::INFINITY, f64::min);
    let remainder = |from: usize| {
        let size = |c: &DVec4| c.xyz().length() + if is_polynomial { 0.0 } else { radius * c.w.abs() };
        let tail = |series: &Vec<DVec4>| series[from..].iter().map(size).sum::<f64>();
        series.iter().map(tail).fold(0.0, f64::max)
    };
    for fit in 1..=degree.clamp(1, MAX_FIT_DEGREE) {
        if fit < degree && remainder(fit + 1) > ESTIMATE * face.tolerances.fit * least {
            continue;
        }
        let mut controls: Vec<Vec<DVec4>> = series.iter().map(|series| to_bernstein(series, fit)).collect();
        if is_polynomial {
            controls.iter_mut().flatten().for_each(|control| control.w = patch.controls[0].w);
        }
        let weights = controls.iter().flatten().map(|control| control.w);
        let (low, high) = weights.fold((f64::INFINITY, 0.0_f64), |(low, high), w| (low.min(w), high.max(w)));
        if !(low > 0.0 && high < MAX_WEIGHT_RATIO * low) {
            continue;
        }
        let surface = NurbsSurface::new(face.index, arrays(&patch, &controls, fit)).ok()?;
        let deviation = composition.deviation(surface.degree(), &relative(&surface, patch.center));
        if deviation <= face.tolerances.fit || fit >= degree {
            return deviation.is_finite().then_some(Composed { surface, deviation });
        }
    }
    None
}

/// Returns an upper bound on the distance between `cut` and the part of the face's `surface` over a
/// rectangle of normalised parameters that its domain stands for. O(spans × nodes × controls).
pub(super) fn rectangle_deviation(
    face: &UnitFace,
    surface: &NurbsSurface,
    cut: &NurbsSurface,
    part: ParamBox,
) -> Result<f64> {
    let domain = cut.domain();
    // Extraction divides weights by a power of 2 near the largest.
    let unit = |surface: &NurbsSurface| {
        power_of_two_below(surface.control_points().iter().map(|point| point[3]).fold(0.0, f64::max))
    };
    let scale = unit(cut) / unit(surface);
    let at = |axis: Axis, value: f64| {
        let [start, end] = domain[axis];
        let [low, high] = part[axis];
        let share = (value - start) / (end - start);
        (1.0 - share) * low + share * high
    };
    let pieces = extract(&Model::new(None, vec![cut.clone()])?);
    let deviations = (0..pieces.patches.len()).map(|index| {
        let piece = pieces.patches.patch(index);
        let [us, vs] = Axis::BOTH.map(|axis| piece.domain[axis].map(|value| at(axis, value)));
        let side = |u: f64| Curve::line(DVec2::new(u, vs[0]), DVec2::new(u, vs[1]));
        let rectangle =
            [face.span(Axis::U, 0.5 * (us[0] + us[1])), face.span(Axis::V, 0.5 * (vs[0] + vs[1]))];
        let ruling = Ruling::between_lines(us.map(side), rectangle);
        let composition =
            Composition { face, patch: face.patch(rectangle), ruling: &ruling, degree: piece.degree };
        let shift = piece.center - composition.patch.center;
        let controls: Vec<DVec4> =
            piece.controls.iter().map(|c| (c.xyz() + c.w * shift).extend(c.w) * scale).collect();
        composition.deviation(piece.degree, &controls)
    });
    Ok(deviations.fold(pieces.point_error.after(0), upper_max))
}

/// Returns the homogeneous controls of a surface relative to a point.
fn relative(surface: &NurbsSurface, center: DVec3) -> Vec<DVec4> {
    let control = |&[x, y, z, w]: &[f64; 4]| ((DVec3::new(x, y, z) - center) * w).extend(w);
    surface.control_points().iter().map(control).collect()
}

/// Returns whether patch and map are polynomials, so that all weights are equal.
fn is_polynomial(face: &UnitFace, patch: &Patch<'_>, ruling: &Ruling) -> bool {
    let sides = ruling.left.is_polynomial() && ruling.right.is_polynomial();
    sides && (face.affine || !patch.rational)
}

/// Returns the degree in t of the composition's homogeneous form.
fn composed_degree(face: &UnitFace, patch: &Patch<'_>, ruling: &Ruling) -> usize {
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
fn across(face: &UnitFace, patch: &Patch<'_>, ruling: &Ruling, t: f64) -> Vec<DVec4> {
    let [left, right] = [&ruling.left, &ruling.right].map(|curve: &Curve| curve.at(t));
    let [p, q] = patch.degree;
    let is_matched = ruling.height.is_some();
    if face.affine {
        let c = patch.controls;
        let at = |side: DVec3| side.z * c[0] + side.x * (c[2] - c[0]) + side.y * (c[1] - c[0]);
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
        return restricted(&line, [from.x, to.x]).into_iter().map(|control| weight * control).collect();
    }
    // The diagonal of the patch restricted to the ruling's box: the product of Bernstein
    // polynomials of degrees p and q is a multiple of one of degree p + q.
    let rows: Vec<Vec<DVec4>> = columns.map(|row| restricted(row, [from.y, to.y])).collect();
    let mut controls = vec![DVec4::ZERO; p + q + 1];
    for j in 0..=q {
        let line: Vec<DVec4> = rows.iter().map(|row| row[j]).collect();
        for (i, control) in restricted(&line, [from.x, to.x]).into_iter().enumerate() {
            let share = binomial(p, i) * binomial(q, j) / binomial(p + q, i + j);
            controls[i + j] += weight * share * control;
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
