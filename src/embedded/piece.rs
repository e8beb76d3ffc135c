//! Pieces of patches, made when they are first needed.

use super::directions::{Direction, Directions, Net};
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::bvh::Aabb;
use crate::clearance::bend;
use crate::param_box::ParamBox;
use crate::rounding::upper_max;
use glam::{DVec3, DVec4, Vec4Swizzles};
use std::cell::OnceCell;

/// A side of a piece: the parameter that is constant along it, and which end of it, 0 or 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Side {
    pub(super) axis: Axis,
    pub(super) end: usize,
}

/// A rectangular part of a patch.
#[derive(Debug)]
pub(super) struct Piece {
    pub(super) patch: u32,
    pub(super) range: ParamBox,
    controls: Vec<DVec4>,
    degree: [usize; 2],
    rational: bool,
    radius: f64,
    /// The control points, t fastest.
    pub(super) points: Vec<DVec3>,
    pub(super) aabb: Aabb,
    /// How much is gained by dividing it.
    pub(super) size: f64,
    /// The axis along which dividing it gains more.
    axis: Axis,
    /// The number of divisions from the patch.
    pub(super) level: u32,
    pub(super) halves: Option<[u32; 2]>,
    along: [OnceCell<Directions>; 2],
}

/// The part of a piece's diagonal that counts as its size where it is plane.
const FLAT_SIZE: f64 = 0.05;

impl Piece {
    /// Makes the piece of a patch over these parameters. O(p q (p + q)).
    pub(super) fn new(patch: &Patch<'_>, index: u32, range: ParamBox, level: u32) -> Self {
        let controls = patch.restricted(range[Axis::U], range[Axis::V]);
        let points: Vec<DVec3> =
            controls.iter().map(|control| patch.center + control.xyz() / control.w).collect();
        let radius = patch.local_points().map(DVec3::length).fold(0.0, upper_max);
        let aabb = points.iter().copied().fold(Aabb::EMPTY, Aabb::with);
        let (bend, axis) = bend(patch.degree, &points);
        Self {
            patch: index,
            range,
            controls,
            degree: patch.degree,
            rational: patch.rational,
            radius,
            points,
            aabb,
            size: bend + FLAT_SIZE * aabb.diagonal(),
            axis,
            level,
            halves: None,
            along: Default::default(),
        }
    }

    /// Returns the directions of the derivative along an axis.
    pub(super) fn along(&self, axis: Axis) -> &Directions {
        self.along[axis.index()].get_or_init(|| {
            let &Self { ref controls, degree, rational, radius, .. } = self;
            Net { controls, degree, rational, radius }.along(axis)
        })
    }

    /// Returns the directions of a side along its parameter.
    pub(super) fn along_side(&self, side: Side) -> Directions {
        let controls: Vec<DVec4> = self.of_side(side, &self.controls);
        let degree = [0, controls.len() - 1];
        let &Self { rational, radius, .. } = self;
        Net { controls: &controls, degree, rational, radius }.along(Axis::V)
    }

    /// Returns the control points of a side.
    pub(super) fn side_points(&self, side: Side) -> Vec<DVec3> {
        self.of_side(side, &self.points)
    }

    fn of_side<T: Copy>(&self, side: Side, net: &[T]) -> Vec<T> {
        let columns = self.degree[1] + 1;
        match side.axis {
            Axis::U => net[side.end * (net.len() - columns)..][..columns].to_vec(),
            Axis::V => net.iter().skip(side.end * (columns - 1)).step_by(columns).copied().collect(),
        }
    }

    /// Returns the directions from a side into the piece.
    pub(super) fn inwards(&self, side: Side) -> impl Iterator<Item = Direction> + '_ {
        self.along(side.axis).turned(side.end == 1)
    }

    /// Returns whether the piece has points of the side of its patch.
    pub(super) fn touches(&self, side: Side) -> bool {
        self.range[side.axis][side.end] == side.end as f64
    }

    /// Returns a corner by the ends of both parameters.
    pub(super) fn corner(&self, [u, v]: [usize; 2]) -> DVec3 {
        let [p, q] = self.degree;
        self.points[u * p * (q + 1) + v * q]
    }

    /// Returns the axis and the parameter at which the piece is divided: that of a corner of others on its sides, if it
    /// has one of these places strictly inside a side, or else its middle.
    pub(super) fn division(&self, places: impl Iterator<Item = [f64; 2]>) -> (Axis, f64) {
        let on_side = |place: [f64; 2]| {
            Axis::BOTH.into_iter().find(|&axis| {
                let ([low, high], other) = (self.range[axis], axis.other());
                low < place[axis] && place[axis] < high && self.range[other].contains(&place[other])
            })
        };
        let mut found = places.filter_map(|place| on_side(place).map(|axis| (axis, place[axis])));
        found.next().unwrap_or_else(|| (self.axis, self.range.middle()[self.axis]))
    }
}
