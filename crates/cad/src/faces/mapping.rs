//! Curves taken from the parameters of the file to those of the exact NURBS.

use super::fit::fit;
use super::gap::Gap;
use super::metric::Metric;
use super::uses::TrimUse;
use crate::nurbs::{ParameterMap, Spline, SurfaceNet};
use glam::DVec3;
use nurbs_hausdorff::workspace::MAX_DEGREE;

/// The tolerance of fits in space, relative to the size of the surface: far below the
/// tolerances of files, at about ten pieces a turn.
const FIT_TOLERANCE: f64 = 1e-9;

/// The deviation, relative to the domain, below which a curve is a parameter line: files
/// state parameters to 15 digits, and joints are made to meet within as much.
const LINE_TOLERANCE: f64 = 1e-9;

/// An upper bound on the derivatives of parameter maps: a / sin a ≤ 1.12 of circles' pieces of
/// half range a ≤ π / 4, less of hyperbolas'.
const LARGEST_SLOPE: f64 = 2.0;

/// A trimming curve in the parameters of the NURBS.
#[derive(Debug, Clone)]
pub(super) struct Mapped {
    pub(super) curve: Spline,
    pub(super) edge: Option<u32>,
    pub(super) gap: Gap,
    pub(super) fitted: bool,
    /// Whether u and v are constant.
    pub(super) constant: [bool; 2],
}

/// Maps a curve. None for a curve of no length.
pub(super) fn map(trim_use: TrimUse, net: &SurfaceNet, metric: &Metric) -> Option<Mapped> {
    let TrimUse { curve, edge, gap, fitted, section, deviation, .. } = trim_use;
    // A curve that is an offset is approximated, and compared at points.
    let approximation = metric.length(DVec3::splat(LARGEST_SLOPE * deviation));
    let gap = if deviation > 0.0 { gap.plus(Gap::measured(approximation)) } else { gap };
    let low = curve.points().fold(DVec3::INFINITY, DVec3::min);
    let high = curve.points().fold(DVec3::NEG_INFINITY, DVec3::max);
    let domain = net.domain();
    let constant =
        [0, 1].map(|axis| high[axis] - low[axis] <= LINE_TOLERANCE * (domain[axis][1] - domain[axis][0]));
    if let Some(axis) = [0, 1].into_iter().find(|&axis| constant[axis])
        && is_line(&curve, 1 - axis)
    {
        if low[1 - axis] == high[1 - axis] {
            return None;
        }
        let value = if low[axis] == high[axis] { low[axis] } else { 0.5 * (low[axis] + high[axis]) };
        let image = |point: DVec3| DVec3::new(net.maps[0].apply(point.x), net.maps[1].apply(point.y), 0.0);
        let end = |mut point: DVec3| {
            point[axis] = value;
            image(point)
        };
        // Every point of the curve moves to the line along one parameter: maps are monotone.
        let map = |value: f64| net.maps[axis].apply(value);
        let mut moved = DVec3::ZERO;
        moved[axis] = (map(high[axis]) - map(value)).max(map(value) - map(low[axis]));
        let moved = metric.length(moved);
        // A segment at a pole, which no edge of the file is, stands for one point.
        let is_closing = edge.is_none() && gap.is_measured;
        let gap =
            if is_closing { Gap::bounded(metric.across(axis, map(value)), gap.length, metric) } else { gap };
        let mut constant = [false; 2];
        constant[axis] = true;
        let curve = Spline::segment(curve.domain(), end(curve.start()), end(curve.end()));
        return Some(Mapped { curve, edge, gap: gap.plus(Gap::proven(moved)), fitted: false, constant });
    }
    let constant = [false; 2];
    if let Some((section, gap)) = section {
        let ends = [curve.start(), curve.end()].map(|end| net.maps[0].apply(end.x));
        if let Some(curve) = section.on_net(net, ends) {
            return Some(Mapped { curve, edge, gap, fitted: false, constant });
        }
    }
    let exact = net.maps.iter().all(|map| *map == ParameterMap::Identity);
    if exact && curve.degree <= MAX_DEGREE {
        return Some(Mapped { curve, edge, gap, fitted, constant });
    }
    let fit = fit(&curve, &net.maps, metric, FIT_TOLERANCE * metric.size);
    Some(Mapped { curve: fit.curve, edge, gap: gap.plus(Gap::proven(fit.error)), fitted: true, constant })
}

/// Returns whether a coordinate of the control points increases or decreases throughout,
/// so that the curve passes a line once if the other coordinate is constant.
fn is_line(curve: &Spline, axis: usize) -> bool {
    let values: Vec<f64> = curve.points().map(|point| point[axis]).collect();
    values.is_sorted() || values.iter().rev().is_sorted()
}
