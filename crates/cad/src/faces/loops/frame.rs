//! The scales in which distances between parameters are measured.

use crate::faces::uses::TrimUse;
use crate::nurbs::Surface;
use glam::DVec3;

/// The largest distance between the ends of neighbouring curves, relative to the size of
/// the loop's box in each parameter, for them to be taken as neighbours without a search.
const NEAR: f64 = 1e-3;

/// The largest distance of joined ends in space, in tolerances of their edges. OpenCASCADE allows
/// each of both edges to end its tolerance away from the vertex, whose own is larger.
const TOLERANCES: f64 = 10.0;

/// The largest distance between ends that are joined whatever the tolerance, relative to
/// the length of the loop's box in space: the precision of files of IGES in float32.
const RELATIVE_TOLERANCE: f64 = 1e-5;

/// The parts of a segment at whose ends its distance from its start is measured: with a period
/// cut in eight, an arc of it leaves its start by at least a third of its width.
const PARTS: usize = 8;

/// The length in space of a step by a period at a pole, relative to that of the same step elsewhere on the
/// loop: one, on a cylinder, however thin that is.
const POLE_RATIO: f64 = 0.1;

/// Measures of a wire's curves on a surface.
pub(super) struct Frame<'a> {
    surface: &'a Surface,
    extents: [f64; 2],
    periods: [Option<f64>; 2],
    pub(super) closures: [Option<f64>; 2],
    /// The diagonal, in space, of the box of the curves' ends.
    size: f64,
    /// The starts of the curves.
    starts: Vec<DVec3>,
}

impl<'a> Frame<'a> {
    pub(super) fn of(uses: &[TrimUse], surface: &'a Surface) -> Self {
        let points = || uses.iter().flat_map(|trim_use| trim_use.curve.points());
        let low = points().fold(DVec3::INFINITY, DVec3::min);
        let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
        let middles = uses.iter().map(|trim_use| {
            let [start, end] = trim_use.curve.domain();
            trim_use.curve.point(0.5 * (start + end))
        });
        let in_space = || {
            let ends = uses.iter().map(|trim_use| trim_use.curve.start());
            ends.chain(middles.clone()).map(|point| surface.point(point.x, point.y))
        };
        let size =
            in_space().fold(DVec3::NEG_INFINITY, DVec3::max) - in_space().fold(DVec3::INFINITY, DVec3::min);
        Self {
            surface,
            extents: [0, 1].map(|axis| (high[axis] - low[axis]).max(f64::MIN_POSITIVE)),
            periods: surface.periods(),
            closures: surface.closures(),
            size: size.length(),
            starts: uses.iter().map(|trim_use| trim_use.curve.start()).collect(),
        }
    }

    /// Returns the area of the parameters of a surface closed both ways; `None` for others.
    pub(super) fn whole(&self) -> Option<f64> {
        let [u, v] = self.closures;
        Some(u? * v?)
    }

    /// Returns the turns of u and of v from a start to an end.
    pub(super) fn turns(&self, start: DVec3, end: DVec3) -> [i32; 2] {
        [0, 1].map(|axis| match self.closures[axis] {
            Some(period) => ((end[axis] - start[axis]) / period).round() as i32,
            None => 0,
        })
    }

    /// Returns the whole periods to add to `start` so that it is nearest to `end`.
    pub(super) fn shift(&self, end: DVec3, start: DVec3) -> DVec3 {
        let [u, v] = [0, 1].map(|axis| match self.periods[axis] {
            Some(period) => period * ((end[axis] - start[axis]) / period).round(),
            None => 0.0,
        });
        DVec3::new(u, v, 0.0)
    }

    /// Returns the distance between two points of the parameters, relative to the extents.
    pub(super) fn distance(&self, a: DVec3, b: DVec3) -> f64 {
        let [u, v] = [0, 1].map(|axis| (a[axis] - b[axis]).abs() / self.extents[axis]);
        u.max(v)
    }

    /// Returns the distance up to periods between two points.
    pub(super) fn distance_on_surface(&self, end: DVec3, start: DVec3) -> f64 {
        self.distance(end, start + self.shift(end, start))
    }

    /// Returns whether a relative distance is that of neighbours.
    pub(super) fn is_near(distance: f64) -> bool {
        distance <= NEAR
    }

    /// Returns the distance in space between two points of the parameters.
    pub(super) fn distance_in_space(&self, from: DVec3, to: DVec3) -> f64 {
        self.surface.point(from.x, from.y).distance(self.surface.point(to.x, to.y))
    }

    /// Returns the largest distance in space, at points of a segment, from its start.
    pub(super) fn reach(&self, from: DVec3, to: DVec3) -> f64 {
        let at = |part: usize| from.lerp(to, part as f64 / PARTS as f64);
        (1..=PARTS).map(|part| self.distance_in_space(from, at(part))).fold(0.0, nan_max)
    }

    /// Returns whether a segment across a period may be one point in space: it is shorter there by far than
    /// the same step from other points of the loop. A cylinder that is thinner than the tolerance has
    /// none.
    pub(super) fn may_be_pole(&self, from: DVec3, to: DVec3) -> bool {
        if self.shift(from, to) == DVec3::ZERO {
            return true;
        }
        let elsewhere = self.starts.iter().map(|&start| self.reach(start, start + to - from));
        self.reach(from, to) <= POLE_RATIO * elsewhere.fold(0.0, nan_max)
    }

    /// Returns the largest distance in space by which the ends of two curves are joined.
    pub(super) fn allowed(&self, [last, next]: [&TrimUse; 2]) -> f64 {
        let tolerance = TOLERANCES * (last.tolerance + next.tolerance);
        // Both ends lie in the ball of a common vertex.
        let joined = last.vertices[1].is_some() && last.vertices[1] == next.vertices[0];
        let at_vertex = if joined { 2.0 * last.end_tolerance } else { 0.0 };
        // A curve made from an edge ends as far from the edge's end as the gap.
        let made = [last, next].map(|one| if one.is_placed { 0.0 } else { one.gap.length });
        tolerance.max(at_vertex).max(RELATIVE_TOLERANCE * self.size) + made[0] + made[1]
    }
}

/// The larger of two numbers, NaN if one is.
fn nan_max(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}
