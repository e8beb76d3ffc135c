//! Projections of control points onto the frame's plane.

use super::super::frame::Frame;
use super::super::piece::Piece;
use crate::certified::rounding::gamma;
use crate::rounding::{lower_min, upper_max};
use glam::DVec2;

/// Roundings of a projection, relative to its distance from the origin; several times what they are, so that the
/// angle under which a segment is seen is less than π after rounding as well.
const PROJECTION_ROUNDINGS: f64 = 64.0;

/// Points whose convex hull contains a projection, up to an error.
#[derive(Debug, Clone)]
pub(super) struct Shadow {
    pub(super) points: Vec<DVec2>,
    pub(super) error: f64,
}

impl Shadow {
    pub(super) fn of(piece: &Piece, frame: &Frame<'_>) -> Self {
        let [x, y] = frame.tangents;
        let points = piece.points().map(|point| DVec2::new(x.dot(point), y.dot(point))).collect();
        Self::new(points, piece.error + gamma(PROJECTION_ROUNDINGS) * piece.radius)
    }

    pub(super) fn new(points: Vec<DVec2>, error: f64) -> Self {
        Self { points, error }
    }

    /// The same moved by a vector, with its rounding.
    pub(super) fn moved(&self, by: DVec2) -> Self {
        let points = self.points.iter().map(|point| *point + by).collect();
        Self::new(points, self.error + gamma(PROJECTION_ROUNDINGS) * by.length())
    }

    pub(super) fn middle(&self) -> DVec2 {
        self.points.iter().sum::<DVec2>() / self.points.len() as f64
    }

    /// The largest distance of its points from the origin.
    pub(super) fn radius(&self) -> f64 {
        self.points.iter().fold(0.0, |radius, point| upper_max(radius, point.length()))
    }

    /// Returns true only if a line separates the hulls of both, each at more than half of the gap from it.
    pub(super) fn is_apart(&self, other: &Self, gap: f64) -> bool {
        let chord = self.points[self.points.len() - 1] - self.points[0];
        let between = self.middle() - other.middle();
        let across = chord.perp();
        let across = if across.dot(between) < 0.0 { -across } else { across };
        [across, between].into_iter().any(|direction| {
            let direction = direction.normalize_or_zero();
            let along = |point: &DVec2| direction.dot(*point);
            let least = self.points.iter().map(along).fold(f64::INFINITY, lower_min);
            let largest = other.points.iter().map(along).fold(f64::NEG_INFINITY, upper_max);
            least - largest > gap + self.error + other.error
        })
    }
}
