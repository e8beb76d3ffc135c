//! What a curve of a file may be and no edge is: torn, or an offset to no side.

use crate::nurbs::curve::{Curve, SplineCurve};
use crate::nurbs::spline::project;
use glam::DVec3;

/// The sine of the angle between a curve and the direction of its offset below which they are parallel.
const PARALLEL: f64 = 1e-9;

/// The points of each part of an offset's basis between knots at which its side is looked at.
const SIDES: usize = 16;

impl Curve {
    /// Returns the places at which the curve jumps within a range, as the points before and behind each: inner
    /// knots of a multiplicity above the degree. Those of an offset are its basis's. O(control points).
    pub(crate) fn jumps(&self, range: [f64; 2]) -> Vec<[DVec3; 2]> {
        match self {
            Self::Line { .. } | Self::Conic { .. } => Vec::new(),
            Self::Spline(spline) => jumps(spline, range),
            Self::Trimmed { basis, .. } | Self::Offset { basis, .. } => basis.jumps(range),
        }
    }
}

fn jumps(spline: &SplineCurve, range: [f64; 2]) -> Vec<[DVec3; 2]> {
    let Some(over) = spline.over_valid(range) else { return Vec::new() };
    let (knots, degree) = (&over.knots, over.degree);
    let inner = degree + 1..over.controls.len();
    let is_torn = |&start: &usize| knots.get(start + degree).is_some_and(|last| *last == knots[start]);
    let torn = inner.filter(is_torn).map(|start| [start - 1, start].map(|pole| project(over.controls[pole])));
    torn.filter(|[before, behind]| before != behind).collect()
}

/// Returns whether the offset of a curve in direction `C' × normal` has no side somewhere between these
/// parameters: the direction vanishes, or turns round between two of the points that are looked at.
pub(in crate::nurbs) fn lacks_side(basis: &Curve, normal: DVec3, breaks: &[f64]) -> bool {
    let mut last: Option<DVec3> = None;
    for pair in breaks.windows(2) {
        for step in 0..=SIDES {
            let tangent = basis.tangent(pair[0] + (pair[1] - pair[0]) * step as f64 / SIDES as f64);
            let side = tangent.cross(normal);
            // Where the curve stands still nothing is said of its direction.
            if tangent == DVec3::ZERO {
                continue;
            }
            let vanishes = !(side.length() > PARALLEL * tangent.length() * normal.length());
            if vanishes || last.is_some_and(|last| last.dot(side) <= 0.0) {
                return true;
            }
            last = Some(side);
        }
        // A corner of the basis may turn it.
        last = None;
    }
    false
}
