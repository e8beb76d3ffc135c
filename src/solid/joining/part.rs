//! Parts of edges.

use super::edges::{Edge, EdgePlace};
use crate::bvh::Aabb;
use crate::solid::curve::Curve;

/// A part of an edge between two groups of points.
#[derive(Debug)]
pub(super) struct EdgePart {
    pub(super) surface: usize,
    pub(super) place: EdgePlace,
    /// The parameters of its start and its end on that side.
    pub(super) range: [f64; 2],
    pub(super) curve: Curve,
    /// The numbers of its ends among the points.
    pub(super) ends: [u32; 2],
    pub(super) forward: bool,
    /// The shell that the surface belongs to in its source, if that is known.
    pub(super) shell: Option<u32>,
}

impl EdgePart {
    /// Returns the whole of an edge, of which the ends have numbers that follow from its own.
    pub(super) fn whole(index: u32, Edge { surface, place, curve, forward, shell }: Edge) -> Self {
        let ends = [2 * index, 2 * index + 1];
        Self { surface, place, range: [0.0, 1.0], curve, ends, forward, shell }
    }

    /// Returns the diagonal of the box around the control points.
    pub(super) fn extent(&self) -> f64 {
        self.curve.points().fold(Aabb::EMPTY, Aabb::with).diagonal()
    }

    /// Returns whether the part is a whole edge.
    pub(super) fn is_whole(&self) -> bool {
        (self.range[0] - self.range[1]).abs() == 1.0
    }

    /// Returns the same part from its other end.
    pub(super) fn reversed(self) -> Self {
        let (curve, forward) = (self.curve.reversed(), !self.forward);
        let ([from, to], [start, end]) = (self.range, self.ends);
        Self { range: [to, from], curve, ends: [end, start], forward, ..self }
    }

    /// Returns the parts before and after a parameter of its own, which meet in the point of this number.
    pub(super) fn split(self, t: f64, number: u32) -> [Self; 2] {
        let ([low, high], [from, to], [start, end]) = (self.curve.split(t), self.range, self.ends);
        let middle = from + t * (to - from);
        let Self { surface, place, forward, shell, .. } = self;
        [(low, [from, middle], [start, number]), (high, [middle, to], [number, end])]
            .map(|(curve, range, ends)| Self { surface, place, range, curve, ends, forward, shell })
    }
}

/// Turns the second of two closed arcs round where that runs against the first.
pub(super) fn in_one_direction([a, b]: [EdgePart; 2]) -> [EdgePart; 2] {
    if a.ends[0] != a.ends[1] {
        return [a, b];
    }
    let [early, late] = [0.25, 0.75].map(|t| b.curve.closest(a.curve.point(t)).0);
    if early <= late {
        return [a, b];
    }
    [a, b.reversed()]
}
