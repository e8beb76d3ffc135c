//! Pieces of patches, halved when they are first needed and kept for both solids.

use super::solid::{BoundarySide, MAX_DEPTH};
use crate::area::density::Density;
use crate::axis::Axis;
use crate::bezier::{Patch, PatchSet, center_grid, relative, snapped};
use crate::bvh::{Aabb, Bvh};
use crate::facts::{Moments, of_patch};
use crate::model::RigidTransform;
use crate::param_box::ParamBox;
use crate::rounding::{gamma, upper_max};
use crate::solid::longer_axis;
use crate::threads::parallel::map;
use glam::{DVec3, DVec4, Vec4Swizzles};
use std::sync::OnceLock;

/// The roundings of the bound on an integral, a product of positive numbers.
const BOUND_ROUNDINGS: f64 = 32.0;

/// The factor by which the error of points changes a derivative, for the square of the degree and, three times, the
/// ratio of weights: Markov's 2 for polynomials on an interval of length 1, for numerators of twice the degree.
const DERIVATIVE_ERRORS: f64 = 16.0;

/// A patch of a solid in the common frame.
#[derive(Debug)]
pub(super) struct Whole {
    surface: usize,
    degree: [usize; 2],
    rational: bool,
    center: DVec3,
    pub(super) side: BoundarySide,
    pub(super) root: Piece,
}

/// A part of a patch.
#[derive(Debug)]
pub(super) struct Piece {
    /// Homogeneous, relative to the patch's centre.
    pub(super) controls: Vec<DVec4>,
    /// The control points.
    pub(super) points: Vec<DVec3>,
    pub(super) aabb: Aabb,
    /// The middle of the box, and the largest distance of a control point from it.
    pub(super) middle: DVec3,
    pub(super) radius: f64,
    pub(super) depth: u32,
    halves: OnceLock<Box<[Piece; 2]>>,
}

/// The patches of a solid in the common frame.
#[derive(Debug)]
pub(super) struct Patches {
    pub(super) wholes: Vec<Whole>,
    tree: Bvh,
    /// The spacing of the centres of pieces.
    grid: f64,
}

impl Patches {
    /// Moves patches, of which `side` states to which side the normals of a surface are.
    pub(super) fn new(
        patches: &PatchSet,
        transform: Option<&RigidTransform>,
        side: impl Fn(usize) -> BoundarySide,
    ) -> Self {
        let whole = |patch: Patch<'_>| {
            let center = transform.map_or(patch.center, |transform| transform.apply(patch.center));
            let rotated = |control: &DVec4| {
                let turned = transform.map_or(control.xyz(), |transform| transform.rotate(control.xyz()));
                turned.extend(control.w)
            };
            let controls: Vec<DVec4> = patch.controls.iter().map(rotated).collect();
            let Patch { surface, degree, rational, .. } = patch;
            let root = Piece::new(center, controls, 0);
            Whole { surface, degree, rational, center, side: side(surface), root }
        };
        let wholes: Vec<Whole> = patches.iter().map(whole).collect();
        let boxes: Vec<Aabb> = wholes.iter().map(|whole| whole.root.aabb).collect();
        let tree = Bvh::new(&boxes);
        let grid = center_grid(boxes.iter().copied().fold(Aabb::EMPTY, Aabb::union).diagonal());
        Self { wholes, tree, grid }
    }

    /// Returns the box of all patches.
    pub(super) fn bounding_box(&self) -> Aabb {
        self.tree.nodes().first().map_or(Aabb::EMPTY, |root| root.aabb)
    }

    /// Returns the patches whose boxes are within `margin` of a box. O(log n) and their number.
    pub(super) fn near(&self, aabb: &Aabb, margin: f64) -> Vec<u32> {
        let nodes = self.tree.nodes();
        let grown = aabb.grown(margin);
        let (mut found, mut stack) = (Vec::new(), vec![0_usize]);
        while let Some(index) = stack.pop() {
            let Some(node) = nodes.get(index).filter(|node| node.aabb.meets(&grown)) else { continue };
            if node.is_leaf() {
                found.push(self.tree.primitive(node));
            } else {
                stack.extend([node.right_child as usize, index + 1]);
            }
        }
        found
    }

    /// Returns the volume and its moments of the cone from `origin` over a piece, whose points are off by at most
    /// `moved`, as its normals are.
    pub(super) fn moments(&self, whole: &Whole, piece: &Piece, origin: DVec3, moved: f64) -> Moments {
        let (center, controls) = self.centered(whole, piece);
        of_patch(&whole.patch(center, &controls), origin, moved)
    }

    /// Returns an upper bound on the integral of |(x − origin)·n| / 3 over a piece, whose control points are off by at
    /// most `moved`.
    pub(super) fn bound(&self, whole: &Whole, piece: &Piece, origin: DVec3, moved: f64) -> f64 {
        let (center, controls) = self.centered(whole, piece);
        let patch = whole.patch(center, &controls);
        let density = Density::new(&patch);
        let [p, q] = whole.degree.map(|degree| degree as f64);
        let weights = controls.iter().map(|control| control.w);
        let heaviest = weights.clone().fold(0.0, upper_max);
        let ratio = heaviest / density.least_weight;
        let degrees = (p * q) * (p * q) * ratio * ratio * ratio;
        let reach = DERIVATIVE_ERRORS * degrees * moved;
        let area = density.upper_bound(density.largest) + reach * (4.0 * degrees * piece.radius + reach);
        let radius = piece.points.iter().map(|point| point.distance(origin)).fold(0.0, upper_max);
        area * (radius + moved) / 3.0 * (1.0 + gamma(BOUND_ROUNDINGS))
    }

    /// Returns the controls of a piece about a centre in it.
    fn centered(&self, whole: &Whole, piece: &Piece) -> (DVec3, Vec<DVec4>) {
        let center = if piece.depth == 0 { whole.center } else { snapped(piece.middle, self.grid) };
        (center, relative(&piece.controls, center - whole.center))
    }
}

impl Whole {
    fn patch<'a>(&self, center: DVec3, controls: &'a [DVec4]) -> Patch<'a> {
        let Self { surface, degree, rational, .. } = *self;
        Patch { surface, degree, domain: ParamBox::UNIT, center, controls, rational }
    }

    /// Returns the degrees.
    pub(super) fn degree(&self) -> [usize; 2] {
        self.degree
    }

    /// Returns the halves of a piece of this patch along its longer axis, or `None` of one that is halved no further.
    pub(super) fn halves<'a>(&self, piece: &'a Piece) -> Option<[&'a Piece; 2]> {
        if piece.depth >= MAX_DEPTH {
            return None;
        }
        let [low, high] = &**piece.halves.get_or_init(|| {
            let axis: Axis = longer_axis(self.degree, &piece.controls);
            let halves = self.patch(self.center, &piece.controls).halves(axis);
            Box::new(halves.map(|half| Piece::new(self.center, half, piece.depth + 1)))
        });
        Some([low, high])
    }
}

impl Piece {
    fn new(center: DVec3, controls: Vec<DVec4>, depth: u32) -> Self {
        let points: Vec<DVec3> = controls.iter().map(|control| center + control.xyz() / control.w).collect();
        let aabb = points.iter().copied().fold(Aabb::EMPTY, Aabb::with);
        let middle = aabb.center();
        let radius = points.iter().map(|point| point.distance(middle)).fold(0.0, upper_max);
        Self { controls, points, aabb, middle, radius, depth, halves: OnceLock::new() }
    }
}

/// Makes the bounds of many pieces.
pub(super) fn bounds(patches: &Patches, origin: DVec3, moved: f64) -> Vec<f64> {
    map(patches.wholes.len(), |index| {
        let whole = &patches.wholes[index];
        patches.bound(whole, &whole.root, origin, moved)
    })
}
