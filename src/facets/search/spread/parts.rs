//! Parts of A with bounds on their distances, and their halves.

use super::triangle::{TriangleBounds, spread_by_middle};
use super::{Spread, Weighted};
use crate::area::{Area, area_of_part, negligible_width};
use crate::axis::Axis;
use crate::bezier::PatchSet;
use crate::facets::Facet;
use crate::facets::search::Goal;
use crate::facets::search::part::{MAX_LEVELS, TrianglePart};
use crate::facets::search::patch_cell::{MIN_LENGTH, PatchCell};
use crate::facets::search::slab::Slab;
use crate::facets::search::source::{Measured, Source, Start};
use crate::model::RigidTransform;
use crate::normals::OrientedPoint;
use crate::param_box::ParamBox;
use crate::rounding::gamma;
use glam::DVec3;

/// The roundings of linear bounds at corners, and of means of three, relative to the largest length
/// (lemma F8 of docs/meshes.md).
const SPREAD_ROUNDINGS: f64 = 64.0;

/// The part of a cell's width that its distance from the plane of the nearest facet has to change by for the cell to be
/// halved along the axis where it changes more; else the longer one is halved.
const VARIED_PART: f64 = 0.25;

/// Bounds on the distance of a point of A: little memory, as clouds are large.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BoundedPoint {
    lower: f64,
    upper: f64,
}

/// A part of a triangle or a patch of A with its area.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WeightedPart {
    pub(super) region: WeightedRegion,
    weight: Area,
    /// A facet of B that may be near.
    pub(super) start: u32,
    pub(super) spread: Spread,
}

#[derive(Debug, Clone, Copy)]
pub(super) enum WeightedRegion {
    /// The corners, moved, the number of cuts above it, and the place of the whole triangle.
    Triangle([DVec3; 3], u32, u32),
    Cell(PatchCell),
}

/// What a part is a part of.
#[derive(Debug, Clone, Copy)]
pub(crate) enum PartOf {
    /// Of the triangle at a place: the corners of the part, moved.
    Triangle(u32, [DVec3; 3]),
    /// Of a patch, over a range of its parameters.
    Patch(u32, ParamBox),
}

/// The parts of A, bounded before B.
pub(crate) struct Parts<'a> {
    pub(super) a: Source<'a>,
    pub(super) b: Measured<'a>,
    pub(super) transform: RigidTransform,
    pub(super) goal: Goal,
    /// What is added to both sides of every bound.
    pub(super) rounding: f64,
    /// Parts within this distance of B are not looked at more closely.
    sufficient: f64,
    /// A width of a patch's area that is narrow enough.
    negligible_width: f64,
    /// Whether lemma F8 or F12 was refuted: triangles have the bounds of their middle and their radius then.
    is_struck: bool,
}

impl Weighted for BoundedPoint {
    fn weight(&self) -> Area {
        Area { lower: 1.0, upper: 1.0 }
    }

    fn spread(&self) -> Spread {
        Spread::exact([self.lower, self.upper])
    }
}

impl Weighted for WeightedPart {
    fn weight(&self) -> Area {
        self.weight
    }

    fn spread(&self) -> Spread {
        self.spread
    }
}

impl WeightedPart {
    /// Returns the part with what the ends of its distances tell.
    fn of_ends(&self) -> Self {
        let Spread { lower, upper, .. } = self.spread;
        Self { spread: Spread::exact([lower, upper]), ..*self }
    }

    /// Returns the halves of a cell along an axis; `None` for one that float64 does not halve.
    fn cut_cell(&self, cell: &PatchCell, axis: Axis) -> Option<[Self; 2]> {
        if cell.range.lengths()[axis as usize] < MIN_LENGTH {
            return None;
        }
        let weight = Area { lower: 0.0, upper: self.weight.upper };
        let half = |range| WeightedRegion::Cell(PatchCell { range, ..*cell });
        Some(cell.range.halves(axis).map(|range| Self { region: half(range), weight, ..self.of_ends() }))
    }
}

impl<'a> Parts<'a> {
    /// Parts within `sufficient` of B have no better bounds.
    pub(crate) fn new(a: Source<'a>, b: Measured<'a>, transform: RigidTransform, sufficient: f64) -> Self {
        let goal = Goal::new(&a, &b, &transform, 0.0, None);
        let rounding = goal.bounds + goal.points + gamma(SPREAD_ROUNDINGS) * goal.length;
        let negligible_width = match a {
            Source::Facets { .. } => 0.0,
            Source::Patches { patches, .. } => negligible_width(patches),
        };
        Self { a, b, transform, goal, rounding, sufficient, negligible_width, is_struck: false }
    }

    /// The number of parts at first.
    pub(crate) fn len(&self) -> usize {
        match self.a {
            Source::Facets { facets, .. } => facets.len(),
            Source::Patches { patches, .. } => patches.len(),
        }
    }

    /// What rounding adds to both sides of every bound on a distance.
    pub(crate) fn rounding(&self) -> f64 {
        self.rounding
    }

    /// Returns the bounds of a point of A, at most `gap` apart where rounding allows, searched from a
    /// place on B that may be near, and the place found; `None` for a B without pieces.
    pub(crate) fn point(&self, place: u32, start: Start, gap: f64) -> Option<(BoundedPoint, Start)> {
        let Source::Facets { facets, .. } = self.a else { return None };
        let Facet::Point(point) = facets.facet(place) else { return None };
        let closest = self.b.certified(self.transform.apply(point), start, gap, self.goal.length)?;
        let Spread { lower, upper, .. } =
            Spread::exact([closest.lower, closest.upper]).widened(self.rounding);
        Some((BoundedPoint { lower, upper }, closest.start))
    }

    /// Returns the bounds of a triangle or a patch, searched from a place on B that may be near, and
    /// the place found; `None` for a B without pieces.
    pub(crate) fn first(&self, place: u32, start: Start) -> Option<(WeightedPart, Start)> {
        let (region, weight) = match self.a {
            Source::Facets { facets, .. } => {
                let Facet::Triangle(corners) = facets.facet(place) else { return None };
                let moved = corners.map(|corner| self.transform.apply(corner));
                (WeightedRegion::Triangle(moved, 0, place), facets.area(place))
            }
            Source::Patches { patches, .. } => {
                let cell = PatchCell::whole(place);
                (WeightedRegion::Cell(cell), self.area(patches, &cell))
            }
        };
        let part = self.bounded(region, weight, start.piece)?;
        Some((part, Start { piece: part.start, ..start }))
    }

    /// Returns bounds on a point of A, or on a triangle or a patch, that hold without looking at B: by the boxes of both.
    pub(crate) fn unmeasured_point(&self) -> BoundedPoint {
        BoundedPoint { lower: 0.0, upper: self.farthest() }
    }

    /// The same of a triangle or a patch.
    pub(crate) fn unmeasured(&self, place: u32) -> WeightedPart {
        let (region, weight) = match self.a {
            Source::Facets { facets, .. } => {
                let corner = |weights| self.transform.apply(facets.facet(place).point(weights));
                let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(corner);
                (WeightedRegion::Triangle(corners, 0, place), facets.area(place))
            }
            Source::Patches { patches, .. } => {
                let cell = PatchCell::whole(place);
                (WeightedRegion::Cell(cell), self.area(patches, &cell))
            }
        };
        WeightedPart { region, weight, start: 0, spread: Spread::exact([0.0, self.farthest()]) }
    }

    /// An upper bound on the distance of every point of A from B.
    fn farthest(&self) -> f64 {
        let (a, b) = (self.a.bounding_box(), self.b.bounding_box());
        let far = b.max_distance_squared(self.transform.apply(a.center())).sqrt() + 0.5 * a.diagonal();
        far * (1.0 + gamma(SPREAD_ROUNDINGS)) + 2.0 * self.rounding
    }

    /// Returns the halves of a part, of a cell where its distance from the nearest facet's plane varies most; `None` for a
    /// part that float64 does not halve.
    pub(crate) fn halves(&self, part: &WeightedPart) -> Option<[WeightedPart; 2]> {
        let halves = match (part.region, self.a, self.b) {
            (WeightedRegion::Triangle(..), ..) => self.cut_triangle(part)?,
            (
                WeightedRegion::Cell(cell),
                Source::Patches { patches, .. },
                Measured::Facets { facets: b, .. },
            ) => {
                let net = cell.net(patches, &self.transform);
                let Spread { lower, upper, .. } = part.spread;
                let varied = net.varied_axis(&b.facet(part.start), VARIED_PART * (upper - lower));
                part.cut_cell(&cell, varied.unwrap_or_else(|| net.halved_axis(true)))?
            }
            _ => return None,
        };
        Some(halves.map(|half| self.measured(&half)))
    }

    /// Returns the halves of a triangle along its longest side, or those of a cell of a patch along its longer side and
    /// along the other one; `None` where float64 does not halve it. They have the distances of the whole part, and at most
    /// its area.
    pub(crate) fn cuts(&self, part: &WeightedPart) -> [Option<[WeightedPart; 2]>; 2] {
        match (part.region, self.a) {
            (WeightedRegion::Cell(cell), Source::Patches { patches, .. }) => {
                let longer = cell.net(patches, &self.transform).halved_axis(true);
                [longer, longer.other()].map(|axis| part.cut_cell(&cell, axis))
            }
            _ => [self.cut_triangle(part), None],
        }
    }

    /// Returns a half with its own distances, which are within those that it has, and its own area.
    pub(crate) fn measured(&self, half: &WeightedPart) -> WeightedPart {
        let WeightedPart { region, weight, start, spread: Spread { lower, upper, .. } } = self.weighed(half);
        match self.bounded(region, weight, start) {
            Some(found) => WeightedPart { spread: found.spread.within([lower, upper]), ..found },
            // There is no facet to measure to.
            None => *half,
        }
    }

    /// Returns a half with its own area.
    pub(crate) fn weighed(&self, half: &WeightedPart) -> WeightedPart {
        let weight = match (half.region, self.a) {
            (WeightedRegion::Cell(cell), Source::Patches { patches, .. }) => self.area(patches, &cell),
            _ => half.weight,
        };
        WeightedPart { weight, ..*half }
    }

    fn cut_triangle(&self, part: &WeightedPart) -> Option<[WeightedPart; 2]> {
        let Measured::Facets { facets: b, .. } = self.b else { return None };
        let WeightedRegion::Triangle(corners, level, place) = part.region else { return None };
        let weight = Area { lower: 0.5 * part.weight.lower, upper: 0.5 * part.weight.upper };
        let halves = (level < MAX_LEVELS).then(|| TrianglePart::new(corners, part.start).halves(b))?;
        let region = |of: TrianglePart| WeightedRegion::Triangle(of.corners, level + 1, place);
        Some(halves.map(|of| WeightedPart { region: region(of), weight, ..part.of_ends() }))
    }

    /// Returns what a part is a part of.
    pub(crate) fn part_of(&self, part: &WeightedPart) -> PartOf {
        match part.region {
            WeightedRegion::Triangle(corners, _, place) => PartOf::Triangle(place, corners),
            WeightedRegion::Cell(cell) => PartOf::Patch(cell.patch, cell.range),
        }
    }

    /// Returns model A and its motion.
    pub(crate) fn source(&self) -> (Source<'a>, &RigidTransform) {
        (self.a, &self.transform)
    }

    /// Returns the closest point of the facet of B that was found near a part, with its normal; `None` of a facet without
    /// one, and of patches.
    pub(crate) fn beside(&self, part: &WeightedPart, point: DVec3) -> Option<OrientedPoint> {
        let Measured::Facets { facets, .. } = self.b else { return None };
        let facet = facets.facet(part.start);
        Some(OrientedPoint { point: point + facet.nearest(point).offset, normal: facet.normal()? })
    }

    /// Bounds parts from now on by the triangle inequality alone.
    pub(crate) fn strike(&mut self) {
        self.is_struck = true;
    }

    fn area(&self, patches: &PatchSet, cell: &PatchCell) -> Area {
        area_of_part(&patches.patch(cell.patch as usize), cell.range, self.negligible_width)
    }

    fn bounded(&self, region: WeightedRegion, weight: Area, start: u32) -> Option<WeightedPart> {
        let Measured::Facets { facets: b, .. } = self.b else { return None };
        let spread = |corners: [DVec3; 3], start, sufficient| {
            if self.is_struck {
                return spread_by_middle(b, &corners, start);
            }
            TriangleBounds { b, corners: &corners, allowance: self.rounding, sufficient }.spread(start)
        };
        let (spread, start) = match (region, self.a) {
            (WeightedRegion::Triangle(corners, ..), _) => spread(corners, start, self.sufficient),
            (WeightedRegion::Cell(cell), Source::Patches { patches, .. }) => {
                let net = cell.net(patches, &self.transform);
                let of_corners = self.is_struck;
                let length = self.goal.length;
                let Slab { triangles: [first, second], height } =
                    if of_corners { net.corner_triangles(length) } else { net.slab(length) };
                let left = if height < self.sufficient { self.sufficient - height } else { 0.0 };
                let (one, start) = spread(first, start, left);
                let (other, start) = spread(second, start, left);
                (one.union(other).widened(height), start)
            }
            _ => return None,
        };
        Some(WeightedPart { region, weight, start, spread: spread.widened(self.rounding) })
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::facets::{FacetTarget, TriangleMesh};

    #[test]
    fn halves_have_half_of_the_area_each() {
        let mesh = TriangleMesh::new(&[DVec3::ZERO, DVec3::X, DVec3::Y], &[[0, 1, 2]]);
        let a = FacetTarget::of_mesh(&mesh.unwrap());
        let source = Source::Facets { facets: &a, error: 0.0 };
        let parts =
            Parts::new(source, Measured::Facets { facets: &a, error: 0.0 }, RigidTransform::IDENTITY, 0.0);
        let (whole, _) = parts.first(0, Start::default()).unwrap();
        let half = whole.weight();
        for part in parts.halves(&whole).unwrap() {
            assert_eq!([2.0 * part.weight().lower, 2.0 * part.weight().upper], [half.lower, half.upper]);
        }
    }
}
