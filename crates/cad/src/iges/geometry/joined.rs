//! Composite curves, and pairs of curves, as B-splines of one degree.

use super::curves::Leaf;
use super::placement::frame_before;
use crate::iges::file::Found;
use crate::nurbs::{Curve, Spline, SplineCurve, project};
use glam::DVec4;
use nurbs_hausdorff::workspace::elevated;

/// Returns curves head to tail as one curve, whose parameter counts the lengths of theirs from 0,
/// and its range. A single curve keeps its parameter.
pub(super) fn joined(leaves: &[Leaf]) -> Found<Option<(Curve, [f64; 2])>> {
    if let [Leaf { curve, range, location }] = leaves {
        return Ok(Some((curve.clone().in_frame(&frame_before(location)), *range)));
    }
    let mut error = leaves.iter().map(|leaf| leaf.curve.error()).fold(0.0, f64::max);
    let mut parts = Vec::with_capacity(leaves.len());
    for leaf in leaves {
        parts.push(spline(leaf)?);
    }
    let degree = parts.iter().map(|part| part.degree).max().unwrap_or(1);
    let mut joined: Option<Spline> = None;
    let mut jump = 0.0_f64;
    for part in parts {
        let part = raised(&part, degree);
        let length = part.domain()[1] - part.domain()[0];
        let Some(whole) = &mut joined else {
            joined = Some(over(part, [0.0, length]));
            continue;
        };
        let at = whole.domain()[1];
        let part = over(part, [at, at + length]);
        // The homogeneous points of both sides of the joint are multiples of each other.
        let (last, first) = (whole.controls[whole.controls.len() - 1], part.controls[0]);
        let factor = last.w / first.w;
        // The first control point is moved to the last one, and no point of the curve farther.
        jump = jump.max(project(last).distance(project(first)));
        whole.knots.pop();
        whole.knots.extend(&part.knots[degree + 1..]);
        whole.controls.extend(part.controls[1..].iter().map(|&control| factor * control));
    }
    error += jump;
    Ok(joined.map(|spline| {
        let range = spline.domain();
        (Curve::Spline(SplineCurve::from(spline).with_error(error)), range)
    }))
}

/// Returns a leaf as a clamped B-spline in the coordinates of what it stands in.
pub(in crate::iges) fn spline(leaf: &Leaf) -> Found<Spline> {
    let curve = leaf.curve.clone().in_frame(&frame_before(&leaf.location));
    Ok(curve.spline(leaf.range)?.0)
}

/// Returns a clamped B-spline over another range.
pub(in crate::iges) fn over(mut spline: Spline, [start, end]: [f64; 2]) -> Spline {
    let [low, high] = spline.domain();
    let (first, last) = (spline.degree, spline.controls.len());
    for (index, knot) in spline.knots.iter_mut().enumerate() {
        *knot = match index {
            _ if index <= first => start,
            _ if index >= last => end,
            _ => start + (*knot - low) / (high - low) * (end - start),
        };
    }
    spline
}

/// Returns a curve as Bézier pieces of a higher degree, over knots of that multiplicity.
pub(super) fn raised(spline: &Spline, degree: usize) -> Spline {
    let pieces = spline.pieces();
    let mut knots = vec![spline.domain()[0]; degree + 1];
    let mut controls: Vec<DVec4> = Vec::new();
    for piece in pieces {
        let shared = usize::from(!controls.is_empty());
        knots.extend(vec![piece.domain()[1]; degree]);
        controls.extend(&elevated(piece.controls, degree)[shared..]);
    }
    knots.push(spline.domain()[1]);
    Spline { degree, knots, controls }
}
