//! A part of an edge.

use super::Sharpness;
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::normals::Hull;
use crate::rounding::{gamma, upper_max};
use crate::solid::Curve;
use glam::DVec3;
use std::sync::OnceLock;

/// The roundings of a length, relative to it.
const LENGTH_ROUNDINGS: f64 = 64.0;

/// A part of an edge that may be a feature.
#[derive(Debug)]
pub(crate) struct Piece {
    /// The number of the edge.
    pub(super) edge: u32,
    /// Where the model has it.
    pub(super) curve: Curve,
    /// The fractions of the edge at its ends.
    pub(super) range: [f64; 2],
    pub(super) depth: u32,
    pub(super) sharpness: Sharpness,
    /// The length.
    pub(super) length: Interval,
    /// The control points, moved.
    pub(super) points: Vec<DVec3>,
    pub(super) hull: Hull,
    /// No control point is farther from the segment between its ends.
    pub(super) off: f64,
    pub(super) halves: OnceLock<Option<Box<[Piece; 2]>>>,
}

impl Piece {
    /// Makes the piece of a curve whose control points are off by at most `error`.
    pub(super) fn new(
        (edge, curve, range, depth): (u32, Curve, [f64; 2], u32),
        sharpness: Sharpness,
        transform: &RigidTransform,
        error: f64,
    ) -> Self {
        let [start, end] = curve.ends();
        let rounding = gamma(LENGTH_ROUNDINGS);
        let count = curve.controls.len() as f64;
        let chord = start.distance(end) * (1.0 - rounding) - 2.0 * error;
        // Lemma E2: the chord is no longer, and the polygon no shorter.
        let lower = if chord > 0.0 { chord } else { 0.0 };
        let length = Interval { lower, upper: curve.polygon() * (1.0 + rounding) + 2.0 * count * error };
        let points: Vec<DVec3> = curve.points().map(|point| transform.apply(point)).collect();
        let hull = Hull::of(&points);
        let off = farthest_from(&points, chord_of(&points));
        let halves = OnceLock::new();
        Self { edge, curve, range, depth, sharpness, length, points, hull, off, halves }
    }

    /// Returns the length.
    pub(crate) fn length(&self) -> Interval {
        self.length
    }

    /// Returns what is known of the angle by which the surface turns there.
    pub(crate) fn sharpness(&self) -> Sharpness {
        self.sharpness
    }

    /// Returns an upper bound on the distance of all points of another piece from this one (lemma E3), without rounding.
    pub(super) fn largest_distance_of(&self, other: &Self) -> f64 {
        farthest_from(&other.points, chord_of(&self.points)) + self.off
    }

    /// Returns a lower bound on the distance of both pieces, without rounding.
    pub(super) fn least_distance_of(&self, other: &Self) -> f64 {
        distance_to_segment(other.hull.middle, chord_of(&self.points)) - self.off - other.hull.radius
    }
}

/// Returns the ends of the segment between the first and the last of a curve's control points, of which there are some.
fn chord_of(points: &[DVec3]) -> [DVec3; 2] {
    [points.first(), points.last()].map(|end| end.copied().unwrap_or(DVec3::NAN))
}

/// Returns the largest distance of points from a segment.
fn farthest_from(points: &[DVec3], chord: [DVec3; 2]) -> f64 {
    points.iter().map(|&point| distance_to_segment(point, chord)).fold(0.0, upper_max)
}

/// Returns the distance of a point from the segment between two.
fn distance_to_segment(point: DVec3, [start, end]: [DVec3; 2]) -> f64 {
    let along = end - start;
    let fraction = (point - start).dot(along) / along.length_squared();
    // Of a segment without length any fraction is as good.
    let fraction = if fraction.is_finite() { fraction.clamp(0.0, 1.0) } else { 0.0 };
    (start + along * fraction).distance(point)
}
