//! A part of a curve and its bound.

use super::cells::Crossed;
use super::correspondence::Correspondence;
use super::discs::Discs;
use super::interpolant::{largest, points};
use super::local::{Ends, Local, LocalCurve, LocalSurface};
use super::majorant::CurveMajorant;
use super::{Lifted, NEAR_ROUNDING};
use glam::DVec3;
use nurbs_hausdorff::workspace::ordered_by;

/// A part of the curve that corresponds to one of the edge.
pub(super) struct GapPart {
    ends: Ends,
    /// An upper bound on the distance of corresponding points.
    pub(super) upper: f64,
    /// About the distance of the farthest node from the edge, which no bound depends on.
    pub(super) lower: f64,
    /// The largest distance of corresponding points at nodes.
    sampled: f64,
    /// The rounding error that the upper bound of every part of it contains, however short the part is.
    pub(super) least_rounding: f64,
    cut: Cut,
}

/// Where to cut a part: at a parameter of the curve, of the edge, or in the middle.
#[derive(Debug, Clone, Copy)]
enum Cut {
    Curve(f64),
    Edge(f64),
    Middle,
}

/// Part of the distance found by which the interpolation may be off.
const REMAINDER_PART: f64 = 0.02;

impl GapPart {
    /// Bounds a part. `found` is a distance near which the bound need not be more accurate.
    pub(super) fn new(lifted: &Lifted<'_>, ends: Ends, found: f64) -> Self {
        let unbounded =
            |cut| Self { ends, upper: f64::INFINITY, lower: 0.0, sampled: 0.0, least_rounding: 0.0, cut };
        let [(t0, s0), (t1, s1)] = ends;
        let [t, s] = [0.5 * (t0 + t1), 0.5 * (s0 + s1)];
        if let Some(knot) = knot_inside(lifted.curve.cell(t), [t0, t1]) {
            return unbounded(Cut::Curve(knot));
        }
        if let Some(knot) = knot_inside(lifted.edge.cell(s), [s0, s1]) {
            return unbounded(Cut::Edge(knot));
        }
        let local_curve = LocalCurve::new(lifted.curve, t, t);
        let center = local_curve.point(t);
        let curve = CurveMajorant::new(&local_curve, t);
        let reach = curve.radii(0.5 * (t1 - t0));
        let crossed = [0, 1].map(|axis| Crossed::new(lifted, center, reach, axis));
        for axis in [0, 1] {
            if let Some(knot) = crossed[axis].far {
                return unbounded(
                    crossing(&local_curve, axis, knot, [t0, t1]).map_or(Cut::Middle, Cut::Curve),
                );
            }
        }
        let at = [center.x, center.y];
        let local = Local {
            lifted,
            curve: local_curve,
            surface: LocalSurface::new(lifted.surface, at, at),
            edge: LocalCurve::new(lifted.edge, s, s),
        };
        let discs = Discs::new(&local, ends, center, curve, &crossed);
        let affine = Correspondence::affine([s0, s1]);
        // Every bound contains this rounding error, so that a smaller distance need not be resolved.
        let least_rounding = discs.least_rounding();
        let enough = found.max(NEAR_ROUNDING * least_rounding);
        let found = found.max(least_rounding);
        let mut part = Self::bounded(&local, ends, &discs, &affine, found);
        // Curves that coincide with other parameters have a small distance only between
        // their nearest points.
        if part.upper > enough
            && part.sampled > super::TIGHTNESS * part.lower
            && let Some(nearest) = Correspondence::nearest(&local, ends)
        {
            let other = Self::bounded(&local, ends, &discs, &nearest, found);
            if other.upper < part.upper {
                part = other;
            }
        }
        part
    }

    fn bounded(local: &Local<'_>, ends: Ends, discs: &Discs, edge: &Correspondence, found: f64) -> Self {
        let [(t0, _), (t1, _)] = ends;
        let parameters = |x: f64| (0.5 * (t0 + t1) + 0.5 * (t1 - t0) * x, edge.parameter(x));
        let difference = |x: f64| {
            let (t, s) = parameters(x);
            local.difference(t, s)
        };
        // No difference is farther from that of the middles than the discs of real parameters.
        let middle = local.difference(0.5 * (t0 + t1), edge.middle);
        let mut upper = middle.length() + discs.moved(1.0, edge);
        let (mut lower, mut sampled) = (0.0, f64::INFINITY);
        if upper > found
            && let Some((count, remainder)) = discs.nodes(edge, REMAINDER_PART * found)
        {
            let values: Vec<DVec3> = points(count).map(difference).collect();
            // f64::min leaves out NaN.
            upper = upper.min(largest(&values) + remainder);
            if upper > found {
                let farthest = values.iter().zip(points(count)).map(|(value, x)| (value.length(), x));
                let (distance, x) = farthest.fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a });
                let (t, s) = parameters(x);
                sampled = distance;
                let lifted = local.lifted;
                lower = lifted.difference(t, lifted.nearest(t, s, lifted.edge_range)).length();
            }
        }
        upper += discs.rounding(edge);
        let upper = if upper.is_nan() { f64::INFINITY } else { upper };
        Self { ends, upper, lower, sampled, least_rounding: discs.least_rounding(), cut: Cut::Middle }
    }

    /// Returns the ends of both parts, or none where float64 has no parameter between them.
    pub(super) fn halves(&self, lifted: &Lifted<'_>) -> Vec<Ends> {
        let [(t0, s0), (t1, s1)] = self.ends;
        let on_edge = |t: f64| lifted.nearest(t, s0 + (s1 - s0) * ((t - t0) / (t1 - t0)), [s0, s1]);
        let (t, s) = match self.cut {
            Cut::Edge(s) => {
                let margin = CUT_MARGIN * (t1 - t0);
                let affine = t0 + (t1 - t0) * ((s - s0) / (s1 - s0));
                (lifted.nearest_on_curve(s, affine, [t0 + margin, t1 - margin]), s)
            }
            Cut::Curve(t) => (t, on_edge(t)),
            Cut::Middle => (0.5 * (t0 + t1), on_edge(0.5 * (t0 + t1))),
        };
        if t0 < t && t < t1 { vec![[(t0, s0), (t, s)], [(t, s), (t1, s1)]] } else { Vec::new() }
    }
}

// The worst part is cut first.
ordered_by!(GapPart, |part| part.upper);

/// Returns the end of a cell that lies inside of a range by more than the rounding of its ends.
fn knot_inside(cell: [f64; 2], [start, end]: [f64; 2]) -> Option<f64> {
    let (low, high) = (start.min(end), start.max(end));
    let margin = 4.0 * f64::EPSILON * low.abs().max(high.abs());
    cell.into_iter().find(|&knot| low + margin < knot && knot < high - margin)
}

/// Returns where a coordinate of the curve crosses a knot, if its ends are on both sides.
fn crossing(curve: &LocalCurve<'_>, axis: usize, knot: f64, [start, end]: [f64; 2]) -> Option<f64> {
    let value = |t: f64| curve.point(t)[axis];
    let rising = value(start) < knot;
    if rising == (value(end) < knot) {
        return None;
    }
    let (mut low, mut high) = (start, end);
    // The bound does not depend on the place: 52 halvings exhaust the digits of float64.
    for _ in 0..52 {
        let middle = 0.5 * (low + high);
        if (value(middle) < knot) == rising {
            low = middle;
        } else {
            high = middle;
        }
    }
    let margin = CUT_MARGIN * (end - start);
    (low > start + margin && low < end - margin).then_some(low)
}

/// Cuts keep this fraction of the part away from its ends, which are crossings already.
const CUT_MARGIN: f64 = 1e-9;
