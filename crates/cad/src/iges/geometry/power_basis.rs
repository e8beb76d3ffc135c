//! Piecewise cubic curves and surfaces by the coefficients of powers, types 112 and 114.

use super::Scale;
use crate::iges::file::{Entity, Found};
use crate::nurbs::{Basis, Spline, SplineCurve, SplineSurface, Surface};
use glam::{DVec3, DVec4};

/// The most pieces along a parameter. The parameters that follow bound it further.
const MAX_PIECES: usize = 1 << 20;

/// The distance, relative to the coordinates, by which pieces may miss each other: files state
/// the coefficients to single precision.
const MEETS: f64 = 1e-5;

/// Reads a curve of cubic pieces. Where two miss each other, the later one begins where the earlier one ends, as on
/// [surfaces](surface).
pub(super) fn curve(entity: &Entity, scale: Scale) -> Found<SplineCurve> {
    let count = entity.items(4, 12)?;
    let breaks = breaks(entity, 5, count)?;
    let numbers = entity.reals(5 + count + 1, 12 * count)?;
    let mut controls: Vec<DVec4> = Vec::with_capacity(3 * count + 1);
    let mut error = 0.0_f64;
    for (piece, pair) in numbers.chunks_exact(12).zip(breaks.windows(2)) {
        let powers = [0, 1, 2, 3].map(|order| DVec3::new(piece[order], piece[4 + order], piece[8 + order]));
        let bezier = bezier(powers, pair[1] - pair[0]).map(|point| (scale.0 * point).extend(1.0));
        error = error.max(append(entity, &mut controls, &bezier)?);
    }
    let spline = Spline { degree: 3, knots: knots(&breaks), controls };
    Ok(SplineCurve::from(spline).with_error(error))
}

/// Reads a surface of bicubic pieces.
///
/// Where two pieces miss each other, the later one is moved to the earlier one: the control points on its first
/// sides are replaced. The points of a piece are convex combinations of its control points, so no point moves farther
/// than the control point that moves the most.
pub(super) fn surface(entity: &Entity, scale: Scale) -> Found<Surface> {
    let counts = [entity.count(3, MAX_PIECES)?, entity.count(4, MAX_PIECES)?];
    let first = 5 + counts[0] + 1;
    let breaks = [breaks(entity, 5, counts[0])?, breaks(entity, first, counts[1])?];
    let start = first + counts[1] + 1;
    // Behind each column and the last row stand coefficients that belong to no piece.
    let at = |i: usize, j: usize| start + 48 * (i * (counts[1] + 1) + j);
    entity.reals(start, at(counts[0] - 1, counts[1]).saturating_sub(start))?;
    let columns = 3 * counts[1] + 1;
    let mut poles: Vec<DVec4> = Vec::with_capacity((3 * counts[0] + 1) * columns);
    let [mut jump_along_u, mut jump_along_v] = [0.0_f64; 2];
    for i in 0..counts[0] {
        let mut rows: [Vec<DVec4>; 4] = Default::default();
        for j in 0..counts[1] {
            let numbers = entity.reals(at(i, j), 48)?;
            // X, Y and Z have 16 coefficients each, with the powers of u fastest.
            let power =
                |s: usize, t: usize| DVec3::from([0, 1, 2].map(|axis| numbers[16 * axis + s + 4 * t]));
            let lengths = [breaks[0][i + 1] - breaks[0][i], breaks[1][j + 1] - breaks[1][j]];
            let along_u = [0, 1, 2, 3].map(|t| bezier([0, 1, 2, 3].map(|s| power(s, t)), lengths[0]));
            for (s, row) in rows.iter_mut().enumerate() {
                let net = bezier([0, 1, 2, 3].map(|t| along_u[t][s]), lengths[1]);
                jump_along_v =
                    jump_along_v.max(append(entity, row, &net.map(|point| (scale.0 * point).extend(1.0)))?);
            }
        }
        let before = poles.len().checked_sub(columns);
        if let Some(before) = before {
            let pairs = poles[before..].iter().zip(&rows[0]);
            if !pairs.clone().all(|(a, b)| meet(*a, *b)) {
                return Err(entity.fault(1, "a surface of pieces that meet"));
            }
            jump_along_u = pairs.fold(jump_along_u, |largest, (a, b)| largest.max(a.distance(*b)));
        }
        poles.extend(rows[usize::from(before.is_some())..].iter().flatten());
    }
    let bases = [0, 1].map(|axis| {
        let count = 3 * counts[axis] + 1;
        Basis::with_knots(3, knots(&breaks[axis]), count)
    });
    // A corner is moved along both.
    Ok(Surface::Spline(SplineSurface {
        error: jump_along_u + jump_along_v,
        ..SplineSurface::new(bases, poles)
    }))
}

/// Reads the increasing ends of pieces, at least one.
fn breaks(entity: &Entity, index: usize, count: usize) -> Found<Vec<f64>> {
    let breaks = entity.reals(index, count + 1)?;
    if count > 0 && breaks.is_sorted_by(|a, b| a < b) {
        Ok(breaks)
    } else {
        Err(entity.fault(index, "the first of increasing breakpoints"))
    }
}

/// Returns the knots of cubic pieces that meet in points.
fn knots(breaks: &[f64]) -> Vec<f64> {
    let last = breaks.len() - 1;
    let times = |index: usize| if index == 0 || index == last { 4 } else { 3 };
    breaks.iter().enumerate().flat_map(|(index, &knot)| std::iter::repeat_n(knot, times(index))).collect()
}

/// Returns the control points of the cubic with these coefficients of powers over [0, length].
fn bezier([a, b, c, d]: [DVec3; 4], length: f64) -> [DVec3; 4] {
    let [b, c, d] = [length * b, length * length * c, length.powi(3) * d];
    [a, a + b / 3.0, a + 2.0 / 3.0 * b + c / 3.0, a + b + c + d]
}

/// Appends the control points of a piece that begins where the last one ends, and returns the distance of both.
fn append(entity: &Entity, controls: &mut Vec<DVec4>, piece: &[DVec4; 4]) -> Found<f64> {
    let Some(&last) = controls.last() else {
        controls.extend(piece);
        return Ok(0.0);
    };
    if !meet(last, piece[0]) {
        return Err(entity.fault(1, "a spline of pieces that meet"));
    }
    controls.extend(&piece[1..]);
    Ok(last.distance(piece[0]))
}

fn meet(a: DVec4, b: DVec4) -> bool {
    a.distance(b) <= MEETS * (a.abs() + b.abs()).max_element()
}
