//! Pieces of patches, halved when they are first needed and kept for both solids.

use super::carrier::{EXACT, Fitted};
use super::density::Slopes;
use super::solid::{BoundarySide, MAX_DEPTH};
use crate::area::density::Density;
use crate::axis::Axis;
use crate::bezier::{Patch, PatchSet, center_grid, relative, snapped};
use crate::bvh::{Aabb, Bvh};
use crate::facts::{Moments, of_patch};
use crate::model::RigidTransform;
use crate::param_box::ParamBox;
use crate::rounding::{gamma, upper_max};
use crate::solid::{Ruled, longer_axis_of_controls};
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
    pub(super) center: DVec3,
    pub(super) side: BoundarySide,
    /// Whether it is a strip between edges of patches, over which nothing is integrated.
    pub(super) is_strip: bool,
    /// Whether it stands for a corner: its control points' hull contains the strips there, and the patch itself need not.
    pub(super) is_hull: bool,
    /// The distance from the patch within which the other solid's patch lies that takes its place; 0 where none does.
    pub(super) reach: f64,
    pub(super) root: Piece,
    carrier: OnceLock<Option<Fitted>>,
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
    carrier: OnceLock<Option<Fitted>>,
}

/// Upper bounds on the area of a piece and on the distance of its points from the origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weight {
    pub(super) area: f64,
    pub(super) radius: f64,
}

impl Weight {
    /// Returns an upper bound on the integral of |(x − origin)·n| / 3.
    pub(super) fn bound(&self) -> f64 {
        self.area * self.radius / 3.0 * (1.0 + gamma(BOUND_ROUNDINGS))
    }

    /// Returns an upper bound on what moving a part of the piece by at most `moved` changes of the integral of
    /// (x − origin)·n / 3, for a part whose border has at most this length: lemma V3 of docs/facts.md.
    pub(super) fn displacement(&self, moved: f64, border: f64) -> f64 {
        moved * (self.area + self.radius * border / 3.0) * (1.0 + gamma(BOUND_ROUNDINGS))
    }
}

/// The patches of a solid in the common frame.
#[derive(Debug)]
pub(super) struct Patches {
    /// The patches, and after them the strips.
    pub(super) wholes: Vec<Whole>,
    tree: Bvh,
    /// The spacing of the centres of pieces.
    grid: f64,
}

impl Patches {
    /// Moves patches and strips; `side` states to which side the normals of a surface are.
    pub(super) fn new(
        patches: &PatchSet,
        strips: impl Iterator<Item = Ruled>,
        transform: Option<&RigidTransform>,
        side: impl Fn(usize) -> BoundarySide,
    ) -> Self {
        let placed = |center: DVec3, controls: &[DVec4]| {
            let center = transform.map_or(center, |transform| transform.apply(center));
            let rotated = |control: &DVec4| {
                let turned = transform.map_or(control.xyz(), |transform| transform.rotate(control.xyz()));
                turned.extend(control.w)
            };
            (center, Piece::new(center, controls.iter().map(rotated).collect(), 0))
        };
        let whole = |patch: Patch<'_>| {
            let (center, root) = placed(patch.center, patch.controls);
            let Patch { surface, degree, rational, .. } = patch;
            Whole {
                surface,
                degree,
                rational,
                center,
                side: side(surface),
                is_strip: false,
                is_hull: false,
                reach: 0.0,
                root,
                carrier: OnceLock::new(),
            }
        };
        let strip = |strip: Ruled| {
            let (center, root) = placed(strip.center, &strip.controls);
            let (degree, side) = ([1, strip.degree], BoundarySide::Unknown);
            Whole {
                surface: 0,
                degree,
                rational: true,
                center,
                side,
                is_strip: true,
                is_hull: strip.is_hull,
                reach: 0.0,
                root,
                carrier: OnceLock::new(),
            }
        };
        Self::of(patches.iter().map(whole).chain(strips.map(strip)).collect())
    }

    /// Moves all patches by a vector.
    pub(super) fn moved_by(self, vector: DVec3) -> Self {
        let moved = |whole: Whole| {
            let center = whole.center + vector;
            Whole {
                center,
                root: Piece::new(center, whole.root.controls, 0),
                carrier: OnceLock::new(),
                ..whole
            }
        };
        Self::of(self.wholes.into_iter().map(moved).collect())
    }

    fn of(wholes: Vec<Whole>) -> Self {
        let boxes: Vec<Aabb> = wholes.iter().map(|whole| whole.root.aabb).collect();
        let tree = Bvh::new(&boxes);
        let grid = center_grid(boxes.iter().copied().fold(Aabb::EMPTY, Aabb::union).diagonal());
        Self { wholes, tree, grid }
    }

    /// Returns the patches, without strips.
    pub(super) fn faces(&self) -> impl Iterator<Item = &Whole> {
        self.wholes.iter().filter(|whole| !whole.is_strip)
    }

    /// Returns the box of all patches.
    pub(super) fn bounding_box(&self) -> Aabb {
        self.tree.bounding_box()
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

    /// Returns bounds on the cone from `origin` over a piece, whose control points are off by at most `moved`.
    pub(super) fn weight(&self, whole: &Whole, piece: &Piece, origin: DVec3, moved: f64) -> Weight {
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
        Weight { area, radius: radius + moved }
    }

    /// Returns bounds on the derivatives of a piece.
    pub(super) fn slopes(&self, whole: &Whole, piece: &Piece) -> Slopes {
        Slopes::new(whole.degree, &self.centered(whole, piece).1)
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

    /// Returns the quadric that the patch lies on, if there is one.
    pub(super) fn exact_carrier(&self) -> Option<&Fitted> {
        let own = self.carrier.get_or_init(|| Fitted::new(self, &self.root)).as_ref();
        own.filter(|own| own.reach <= EXACT * self.root.radius)
    }

    /// Returns a quadric that a piece lies on or nearly so: that of the patch where the patch lies on it; `None` where
    /// there is none.
    pub(super) fn carrier<'a>(&'a self, piece: &'a Piece) -> Option<&'a Fitted> {
        self.exact_carrier().or_else(|| piece.carrier.get_or_init(|| Fitted::new(self, piece)).as_ref())
    }

    /// Returns the controls of a piece about a point.
    pub(super) fn around(&self, piece: &Piece, origin: DVec3) -> Vec<DVec4> {
        let offset = self.center - origin;
        let moved = |control: &DVec4| (control.xyz() + control.w * offset).extend(control.w);
        piece.controls.iter().map(moved).collect()
    }

    /// Returns the points of a piece at the corners of its parameters.
    pub(super) fn corners(&self, piece: &Piece) -> [DVec3; 4] {
        let columns = self.degree[1];
        let last = piece.points.len() - 1;
        [0, columns, last - columns, last].map(|index| piece.points[index])
    }

    /// Returns the axis along which a piece is halved.
    pub(super) fn axis(&self, piece: &Piece) -> Axis {
        longer_axis_of_controls(self.degree, &piece.controls)
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
            let halves = self.patch(self.center, &piece.controls).halves(self.axis(piece));
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
        Self {
            controls,
            points,
            aabb,
            middle,
            radius,
            depth,
            halves: OnceLock::new(),
            carrier: OnceLock::new(),
        }
    }
}
