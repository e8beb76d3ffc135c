//! Pieces of patches, made when they are first needed.

use super::audit::Grid;
use super::directions::{Direction, Directions, Net};
use crate::axis::Axis;
use crate::bezier::{Patch, PatchSet};
use crate::bvh::Aabb;
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
    /// The axis and the parameter of a corner that others have strictly inside a side of this piece: it is divided there.
    pub(super) place: Option<(Axis, f64)>,
    cut: OnceCell<Cut>,
    /// The number of divisions from the patch.
    pub(super) level: u32,
    pub(super) halves: Option<[u32; 2]>,
    along: [OnceCell<Directions>; 2],
    grid: OnceCell<Grid>,
}

/// Where a piece is divided.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cut {
    /// How much is gained by it.
    pub(super) gain: f64,
    /// The axis and the parameter.
    pub(super) at: (Axis, f64),
}

/// The turn that counts as much as all the length of a piece, which decides where it is plane.
const LENGTH_SHARE: f64 = 0.1;

impl Piece {
    /// Makes the piece of a patch over these parameters, which is divided at the first of these places that is strictly
    /// inside one of its sides, or else in its middle. O(p q (p + q)).
    pub(super) fn new(
        patch: &Patch<'_>,
        index: u32,
        range: ParamBox,
        level: u32,
        places: impl Iterator<Item = [f64; 2]>,
    ) -> Self {
        let controls = patch.restricted(range[Axis::U], range[Axis::V]);
        let points: Vec<DVec3> =
            controls.iter().map(|control| patch.center + control.xyz() / control.w).collect();
        let radius = patch.local_points().map(DVec3::length).fold(0.0, upper_max);
        let aabb = points.iter().copied().fold(Aabb::EMPTY, Aabb::with);
        let place = place_on_side(&range, places);
        Self {
            patch: index,
            range,
            controls,
            degree: patch.degree,
            rational: patch.rational,
            radius,
            points,
            aabb,
            place,
            cut: OnceCell::new(),
            level,
            halves: None,
            along: Default::default(),
            grid: OnceCell::new(),
        }
    }

    /// Returns where the piece is divided: at the place of a corner, or else in the middle of the axis along which it turns
    /// more. O(p q), at first use, as most pieces are never divided.
    pub(super) fn cut(&self) -> Cut {
        *self.cut.get_or_init(|| {
            let [turn_u, turn_v] = turns(self.degree, &self.points, MIN_LEG * self.radius);
            let [long_u, long_v] = lengths(self.degree, &self.points);
            let lengths = [long_u, long_v].map(|length| LENGTH_SHARE * length / (long_u + long_v));
            let axis = Axis::of_larger([turn_u + lengths[0], turn_v + lengths[1]]);
            Cut {
                gain: (upper_max(turn_u, turn_v) + LENGTH_SHARE) * self.aabb.diagonal(),
                at: self.place.unwrap_or((axis, self.range.middle()[axis])),
            }
        })
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

    /// Returns the points at the ends and the middles of both parameters, evaluated on the patch.
    pub(super) fn grid(&self, patches: &PatchSet) -> &Grid {
        self.grid.get_or_init(|| {
            let patch = patches.patch(self.patch as usize);
            let shares = [0.0, 0.5, 1.0];
            shares.map(|u| shares.map(|v| patch.point(self.range.at([u, v]))))
        })
    }

    /// Returns a corner by the ends of both parameters.
    pub(super) fn corner(&self, [u, v]: [usize; 2]) -> DVec3 {
        let [p, q] = self.degree;
        self.points[u * p * (q + 1) + v * q]
    }
}

/// The least length of a leg, relative to the patch's radius: a shorter leg may be rounding, and has no direction.
const MIN_LEG: f64 = 1e-9;

/// Returns the first place strictly inside a side of a rectangle, by the axis along that and the parameter.
fn place_on_side(range: &ParamBox, mut places: impl Iterator<Item = [f64; 2]>) -> Option<(Axis, f64)> {
    places.find_map(|place| {
        let axis = Axis::BOTH.into_iter().find(|&axis| {
            let ([low, high], other) = (range[axis], axis.other());
            low < place[axis] && place[axis] < high && range[other].contains(&place[other])
        })?;
        Some((axis, place[axis]))
    })
}

/// Returns, for each axis, how much the legs of a net turn along its lines: those of these lines and those across them. An
/// estimate of how far directions there are from each other. Shorter legs than the least one are left out.
fn turns([p, q]: [usize; 2], points: &[DVec3], least: f64) -> [f64; 2] {
    let columns = q + 1;
    let unit = |from: usize, to: usize| {
        let leg = points[to] - points[from];
        (leg.length() > least).then(|| leg.normalize())
    };
    let turn = |legs: Vec<DVec3>| legs.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>();
    let at = |i: usize, j: usize| i * columns + j;
    let largest = |turns: Vec<f64>| turns.into_iter().fold(0.0, upper_max);
    let of_lines = |count: usize, others: usize, place: &dyn Fn(usize, usize) -> usize| {
        let along = (0..=others)
            .map(|j| turn((0..count).filter_map(|i| unit(place(i, j), place(i + 1, j))).collect()));
        let across = (0..others)
            .map(|j| turn((0..=count).filter_map(|i| unit(place(i, j), place(i, j + 1))).collect()));
        largest(along.collect()) + largest(across.collect())
    };
    [of_lines(p, q, &at), of_lines(q, p, &|j, i| at(i, j))]
}

/// Returns the mean length of the lines of a net along each axis, as the distance of their ends.
fn lengths([p, q]: [usize; 2], points: &[DVec3]) -> [f64; 2] {
    let columns = q + 1;
    let at = |i: usize, j: usize| points[i * columns + j];
    let along_u: f64 = (0..=q).map(|j| at(0, j).distance(at(p, j))).sum();
    let along_v: f64 = (0..=p).map(|i| at(i, 0).distance(at(i, q))).sum();
    // A point has no longer lines.
    [along_u / (q + 1) as f64 + f64::MIN_POSITIVE, along_v / (p + 1) as f64]
}
