//! A proven upper bound on the distance between a curve on a surface and its edge in space.
//!
//! A part of the curve corresponds to a part of the edge by an affine map of the parameters.
//! The difference f of the points is analytic, so that its polynomial at Chebyshev
//! nodes and a bound on f at complex parameters bound it at all real ones (docs/trimming.md,
//! T9). Parts are cut until the bound is near the largest distance found.

mod cells;
mod correspondence;
mod discs;
mod interpolant;
mod local;
mod majorant;
mod nearest;
mod part;

use super::nurbs::{Curve, Surface};
use glam::{DAffine3, DVec3};
use part::GapPart;
use std::collections::BinaryHeap;

/// The bound is at most this factor above the largest distance found, unless it is below the resolution or
/// near its rounding, or the parts run out.
const TIGHTNESS: f64 = 1.1;

/// Cuts end where the bound is at most this factor above its least rounding error: they cannot halve such a bound.
const NEAR_ROUNDING: f64 = 2.0;

/// The accuracy of the bound relative to the size of the edge, below that of any fit.
const RESOLUTION: f64 = 1e-10;

/// That of the bound for a curve that is exact, near the rounding that every bound contains.
const RESOLUTION_OF_EXACT: f64 = 1e-13;

/// The most parts that are bounded. Curves of real files need from one to a few dozen and
/// one for each knot that they cross.
const MAX_PARTS: usize = 1 << 13;

/// The parts that are added for a tighter bound once every part has one.
const MAX_REFINEMENTS: usize = 256;

/// A curve on a surface, and the edge in space that it stands for.
pub(super) struct Lifted<'a> {
    pub(super) surface: &'a Surface,
    pub(super) surface_location: DAffine3,
    pub(super) curve: &'a Curve,
    pub(super) range: [f64; 2],
    pub(super) edge: &'a Curve,
    pub(super) edge_location: DAffine3,
    pub(super) edge_range: [f64; 2],
}

impl Lifted<'_> {
    /// Returns a bound on the distance between the edge and the file's.
    pub(super) fn edge_error(&self) -> f64 {
        self.edge_location.matrix3.determinant().abs().cbrt() * self.edge.error()
    }

    /// Returns an upper bound on the distance from every point of either curve to the other,
    /// with rounding; `None` if none is found.
    pub(super) fn gap(&self) -> Option<f64> {
        Some(self.bound(RESOLUTION)).filter(|bound| bound.is_finite())
    }

    /// As [`Self::gap`], for curves that are equal but for rounding.
    pub(super) fn gap_of_exact(&self) -> Option<f64> {
        Some(self.bound(RESOLUTION_OF_EXACT)).filter(|bound| bound.is_finite())
    }

    /// As [`Self::gap`], but infinite if none is found, and accurate to this part of the
    /// edge's size.
    fn bound(&self, resolution: f64) -> f64 {
        let whole = [(self.range[0], self.edge_range[0]), (self.range[1], self.edge_range[1])];
        let mut lower = self.measured();
        let floor = resolution * self.size();
        let first = GapPart::new(self, whole, floor.max(lower));
        lower = lower.max(first.lower);
        let mut parts = BinaryHeap::from([first]);
        let mut refinements = 0;
        while let Some(worst) = parts.peek() {
            let bound = worst.upper;
            refinements += usize::from(bound.is_finite());
            if bound <= floor.max(TIGHTNESS * lower).max(NEAR_ROUNDING * worst.least_rounding)
                || parts.len() > MAX_PARTS
                || refinements > MAX_REFINEMENTS
            {
                return bound;
            }
            let halves = worst.halves(self);
            if halves.is_empty() {
                return bound;
            }
            parts.pop();
            for ends in halves {
                let part = GapPart::new(self, ends, floor.max(lower));
                lower = lower.max(part.lower);
                parts.push(part);
            }
        }
        f64::INFINITY
    }

    /// Returns about the largest distance of some points of the curve from the edge, below
    /// which no bound need be tight.
    pub(super) fn measured(&self) -> f64 {
        let at = |[start, end]: [f64; 2], index: usize| start + (end - start) * index as f64 / SAMPLES as f64;
        let distance = |index: usize| {
            let (t, s) = (at(self.range, index), at(self.edge_range, index));
            let is_end = index == 0 || index == SAMPLES;
            self.difference(t, if is_end { s } else { self.nearest(t, s, self.edge_range) }).length()
        };
        (0..=SAMPLES).map(distance).fold(0.0, f64::max)
    }

    /// As [`Self::measured`], at as many points of each interval on which both curves are analytic.
    pub(super) fn measured_by_spans(&self) -> f64 {
        let measured = |part: &[f64]| {
            let ends = [part[0], part[1]];
            let edge_range = ends.map(|t| self.corresponding(t));
            Self { range: ends, edge_range, ..*self }.measured()
        };
        self.breaks().windows(2).map(measured).fold(0.0, f64::max)
    }

    /// Returns the ends of the curve's range and the parameters between them at which it or the edge
    /// is not analytic, in their order.
    fn breaks(&self) -> Vec<f64> {
        let mut breaks = self.range.to_vec();
        let ([t0, t1], [s0, s1]) = (self.range, self.edge_range);
        let mut add = |curve: &Curve, range: [f64; 2]| {
            let mut open = vec![range];
            while let Some([from, to]) = open.pop() {
                let (low, high) = (from.min(to), from.max(to));
                let cell = curve.cell(0.5 * (low + high));
                for knot in cell.into_iter().filter(|&knot| low < knot && knot < high) {
                    breaks.push(t0 + (t1 - t0) * ((knot - range[0]) / (range[1] - range[0])));
                    open.push(if knot == cell[0] { [low, knot] } else { [knot, high] });
                }
            }
        };
        add(self.curve, [t0, t1]);
        add(self.edge, [s0, s1]);
        breaks.sort_by(f64::total_cmp);
        if t1 < t0 {
            breaks.reverse();
        }
        breaks.dedup();
        breaks
    }

    /// Returns the point on the surface less the point of the edge, in space.
    fn difference(&self, t: f64, s: f64) -> DVec3 {
        self.on_surface(t) - self.on_edge(s)
    }

    fn on_surface(&self, t: f64) -> DVec3 {
        let at = self.curve.point(t);
        self.surface_location.transform_point3(self.surface.point(at.x, at.y))
    }

    fn on_edge(&self, s: f64) -> DVec3 {
        self.edge_location.transform_point3(self.edge.point(s))
    }

    /// Returns the diagonal of the box of points of the edge.
    fn size(&self) -> f64 {
        let [start, end] = self.edge_range;
        let points = [0.0, 0.25, 0.5, 0.75, 1.0].map(|x| self.on_edge(start + x * (end - start)));
        let [low, high] = [
            points.into_iter().fold(DVec3::INFINITY, DVec3::min),
            points.into_iter().fold(DVec3::NEG_INFINITY, DVec3::max),
        ];
        low.distance(high)
    }
}

/// The points of a curve that the search begins with are one more than this number.
const SAMPLES: usize = 8;

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::nurbs::{Basis, Frame, SplineCurve};
    use glam::DVec4;

    /// A polyline through points at these parts of [0, 1] whose point `outlier` is off by 1e-3.
    fn polyline(knots: &[f64], outlier: Option<usize>) -> Curve {
        let height = |index: usize| if Some(index) == outlier { 1e-3 } else { 0.0 };
        let poles = knots.iter().enumerate().map(|(index, &x)| DVec4::new(x, height(index), 0.0, 1.0));
        let last = knots.len() - 1;
        let pairs: Vec<(f64, usize)> = knots
            .iter()
            .enumerate()
            .map(|(index, &knot)| (knot, if index % last == 0 { 2 } else { 1 }))
            .collect();
        Curve::Spline(SplineCurve::new(Basis::new(1, knots.len(), &pairs, false).unwrap(), poles.collect()))
    }

    /// Nine points of the whole miss a spike between knots, on the curve as on the edge.
    #[test]
    fn a_spike_between_knots_is_measured() {
        let knots = [0.0, 0.55, 0.56, 0.57, 1.0];
        let plane = Surface::Plane(Frame { origin: DVec3::ZERO, x: DVec3::X, y: DVec3::Y, z: DVec3::Z });
        for (on_curve, on_edge) in [(Some(2), None), (None, Some(2))] {
            let (curve, edge) = (polyline(&knots, on_curve), polyline(&knots, on_edge));
            for range in [[0.0, 1.0], [1.0, 0.0]] {
                let lifted = Lifted {
                    surface: &plane,
                    surface_location: DAffine3::IDENTITY,
                    curve: &curve,
                    range,
                    edge: &edge,
                    edge_location: DAffine3::IDENTITY,
                    edge_range: range,
                };
                assert_eq!(lifted.measured(), 0.0);
                let found = lifted.measured_by_spans();
                assert!((found - 1e-3).abs() < 1e-5, "{found}");
            }
        }
    }
}
