//! The parts that a model is made of, with bounds on their distances.

use super::formula::{moved, oriented, points_of};
use crate::area::Area;
use crate::axis::Axis;
use crate::certified::{
    Cell, CellSpread, Density, Lemma, LinearBounds, Pair, SpreadRefutation, SpreadStart, Spreads,
};
use crate::facets::{FacetTarget, Spread, Weighted};
use crate::normals::{NormalCone, OrientedPoint, Shape};
use crate::param_box::ParamBox;
use crate::rounding::{gamma, upper_min};
use crate::solid::longer_axis_of_controls;
use glam::DVec3;
use std::ops::Range;

/// Half of the width of a cell that float64 does not usefully halve further.
const MIN_HALF_WIDTH: f64 = 1.0 / (1_u64 << 40) as f64;

/// The points of a cell that are always looked at in an audit: the corners and the middle.
const CORNERS_OF_CELL: usize = 5;

/// The roundings of the part of a triangle's area that a cell takes.
const PART_ROUNDINGS: f64 = 8.0;

/// A model in parts, which are halved.
pub(in crate::engine) trait Cover: Sync {
    type Part: Weighted + Copy + Send + Sync;

    /// The number of parts at first.
    fn len(&self) -> usize;

    /// What rounding adds to both sides of every bound on a distance.
    fn rounding(&self) -> f64;

    /// Returns the bounds of a range of the first parts, from when `is_late` on those of [`Self::unmeasured`]; `None`
    /// for a B without pieces.
    fn first(&self, range: Range<usize>, is_late: &dyn Fn() -> bool) -> Option<Vec<Self::Part>>;

    /// Returns the bounds of one of the first parts that hold without looking at B: where the time is over.
    fn unmeasured(&self, index: usize) -> Self::Part;

    /// Returns the halves of a part; `None` for a part that float64 does not halve.
    fn halves(&self, part: &Self::Part) -> Option<[Self::Part; 2]>;

    /// Returns the halves of a part along its longer side, and those along the other side where there are two; `None`
    /// where float64 does not halve it. They have the distances of the whole part, and at most its area.
    fn cuts(&self, part: &Self::Part) -> [Option<[Self::Part; 2]>; 2];

    /// Returns a half that [`Self::cuts`] made with its own distances and area.
    fn measured(&self, half: &Self::Part) -> Self::Part;

    /// Returns a half that [`Self::cuts`] made with its own area.
    fn weighed(&self, half: &Self::Part) -> Self::Part;

    /// Returns where a part is, moved, and a cone about its normals.
    fn shape(&self, part: &Self::Part) -> Shape;

    /// Returns points of a part, moved, by its formula: the corners and the middle.
    fn points(&self, part: &Self::Part) -> Vec<DVec3>;

    /// Returns the middle of a part, moved, and a point of B near it, by their formulas; `None` where none is known, or a
    /// normal.
    fn beside(&self, part: &Self::Part) -> Option<[OrientedPoint; 2]>;

    /// The lemma that the bounds rest on.
    fn lemma(&self) -> Lemma;

    /// The number of a part's corners, with its middle where that is looked at.
    fn corners(&self) -> usize;

    /// Looks at the corners of a part and `further` points of it, and where `mean` is set at the mean by a rule;
    /// returns in words what refutes the part's bounds.
    fn refutation(&self, part: &Self::Part, further: usize, mean: bool) -> Option<String>;

    /// Bounds parts from now on without that lemma, by the triangle inequality.
    fn strike(&mut self);
}

/// Cells of patches or of triangles, measured to patches.
pub(in crate::engine) struct Cells<'a> {
    pair: Pair<'a>,
    spreads: Spreads<'a>,
    /// The triangles with the error of their corners, if the patches of A are those.
    triangles: Option<(&'a FacetTarget, f64)>,
}

/// A cell with its bounds.
#[derive(Debug, Clone, Copy)]
pub(in crate::engine) struct WeightedCell {
    cell: Cell,
    weight: Area,
    spread: Spread,
    linear: Option<LinearBounds>,
    axis: Axis,
    start: SpreadStart,
}

impl WeightedCell {
    /// Returns the halves along an axis with the distances of the whole cell, and at most its area; `None` for a cell
    /// that float64 does not halve.
    fn cut(&self, axis: Axis) -> Option<[Self; 2]> {
        if self.cell.half[axis as usize] < MIN_HALF_WIDTH {
            return None;
        }
        let Spread { lower, upper, .. } = self.spread;
        let spread = Spread::exact([lower, upper]);
        let weight = Area { lower: 0.0, upper: self.weight.upper };
        let cells = self.cell.halves(Axis::BOTH.map(|one| one == axis));
        let mut halves = cells.map(|cell| Self { cell, weight, spread, linear: None, ..*self });
        Some([halves.next()?, halves.next()?])
    }
}

impl Weighted for WeightedCell {
    fn weight(&self) -> Area {
        self.weight
    }

    fn spread(&self) -> Spread {
        self.spread
    }

    fn beyond(&self, limit: f64) -> [f64; 2] {
        match (self.spread.beyond(limit), &self.linear) {
            ([0.0, 1.0], Some(linear)) => linear.beyond(limit),
            (by_ends, _) => by_ends,
        }
    }

    fn thickness(&self) -> f64 {
        let range = self.spread.upper - self.spread.lower;
        self.linear.map_or(range, |linear| upper_min(range, linear.thickness()))
    }
}

impl<'a> Cells<'a> {
    /// Cells within `sufficient` of B are not halved.
    pub(in crate::engine) fn new(
        pair: Pair<'a>,
        triangles: Option<(&'a FacetTarget, f64)>,
        sufficient: f64,
    ) -> Self {
        let density = if triangles.is_some() { Density::OfTriangle } else { Density::OfPatch };
        Self { pair, spreads: Spreads::new(pair, density, sufficient), triangles }
    }

    fn bounded(&self, cell: Cell, start: &SpreadStart) -> WeightedCell {
        let CellSpread { all: [lower, upper], mean, square, linear, axis, start } =
            self.spreads.of(cell, start);
        let rounding = self.spreads.rounding();
        let spread = Spread { lower, upper, mean, square }.widened(rounding);
        let linear = linear.map(|linear| linear.widened(rounding));
        WeightedCell { cell, weight: self.area(&cell), spread, linear, axis, start }
    }

    fn area(&self, cell: &Cell) -> Area {
        let [s, t] = cell.ranges();
        let Some((triangles, _)) = self.triangles else {
            return self.pair.area_of_a(cell.patch, ParamBox::new(s, t));
        };
        let patch = self.pair.patch_of_a(cell.patch);
        // At s the triangle is as wide as s.
        let part = (s[1] * s[1] - s[0] * s[0]) * (t[1] - t[0]);
        let Area { lower, upper } = triangles.area(patch.surface as u32);
        let rounding = gamma(PART_ROUNDINGS);
        Area { lower: lower * part * (1.0 - rounding), upper: upper * part * (1.0 + rounding) }
    }

    /// Returns the area of a triangle, or an interval that contains that of a whole patch: it ends at the product of the
    /// bounds on the first derivatives.
    fn rough_area(&self, cell: &Cell) -> Area {
        if self.triangles.is_some() {
            return self.area(cell);
        }
        let [by_s, by_t] = self.pair.patch_of_a(cell.patch).derivative_bounds().first;
        Area { lower: 0.0, upper: by_s * by_t * (1.0 + gamma(1.0)) }
    }
}

impl Cover for Cells<'_> {
    type Part = WeightedCell;

    fn len(&self) -> usize {
        self.pair.a.patches().len()
    }

    fn rounding(&self) -> f64 {
        self.spreads.rounding()
    }

    fn first(&self, range: Range<usize>, is_late: &dyn Fn() -> bool) -> Option<Vec<WeightedCell>> {
        let mut start = self.spreads.start();
        let next = |index: usize| {
            // The first is always measured, so that the model has an area.
            if index > 0 && is_late() {
                return self.unmeasured(index);
            }
            let part = self.bounded(Cell::whole(index as u32), &start);
            start.foot = part.start.foot;
            part
        };
        Some(range.map(next).collect())
    }

    fn unmeasured(&self, index: usize) -> WeightedCell {
        let cell = Cell::whole(index as u32);
        let spread = Spread::exact([0.0, self.spreads.farthest()]);
        let (weight, start) = (self.rough_area(&cell), self.spreads.start());
        WeightedCell { cell, weight, spread, linear: None, axis: Axis::U, start }
    }

    fn halves(&self, part: &WeightedCell) -> Option<[WeightedCell; 2]> {
        Some(part.cut(part.axis)?.map(|half| self.measured(&half)))
    }

    fn cuts(&self, part: &WeightedCell) -> [Option<[WeightedCell; 2]>; 2] {
        let patch = self.pair.patch_of_a(part.cell.patch);
        let [s, t] = part.cell.ranges();
        let longer = longer_axis_of_controls(patch.degree, &patch.restricted(s, t));
        [longer, longer.other()].map(|axis| part.cut(axis))
    }

    fn measured(&self, half: &WeightedCell) -> WeightedCell {
        let Spread { lower, upper, .. } = half.spread;
        let found = self.bounded(half.cell, &half.start);
        WeightedCell { spread: found.spread.within([lower, upper]), ..found }
    }

    fn weighed(&self, half: &WeightedCell) -> WeightedCell {
        WeightedCell { weight: self.area(&half.cell), ..*half }
    }

    fn shape(&self, part: &WeightedCell) -> Shape {
        let patch = self.pair.patch_of_a(part.cell.patch);
        let [s, t] = part.cell.ranges();
        let (range, transform) = (ParamBox::new(s, t), &self.pair.transform);
        match self.triangles {
            // A triangle has no normal at the side that is a corner, and one plane.
            Some((triangles, error)) => {
                let cone = NormalCone::of_facet(triangles, patch.surface as u32, error);
                Shape::with_cone(&patch, range, transform, cone)
            }
            None => Shape::of_part(&patch, range, transform),
        }
    }

    fn points(&self, part: &WeightedCell) -> Vec<DVec3> {
        let [s, t] = part.cell.ranges();
        points_of(&self.pair.patch_of_a(part.cell.patch), ParamBox::new(s, t), &self.pair.transform)
    }

    fn beside(&self, part: &WeightedCell) -> Option<[OrientedPoint; 2]> {
        let Self { pair, .. } = self;
        let WeightedCell { cell, start: SpreadStart { foot, .. }, .. } = part;
        let [s, t] = cell.ranges();
        let middle = oriented(&pair.patch_of_a(cell.patch), ParamBox::new(s, t).middle())?;
        let near = oriented(&pair.b.patches().patch(foot.patch as usize), foot.parameters)?;
        Some([moved(middle, &pair.transform), near])
    }

    fn lemma(&self) -> Lemma {
        Lemma::Spread
    }

    fn corners(&self) -> usize {
        CORNERS_OF_CELL
    }

    fn refutation(&self, part: &WeightedCell, further: usize, mean: bool) -> Option<String> {
        let Spread { lower, upper, mean: stated, .. } = part.spread;
        let all = [lower, upper];
        let of_points = self.spreads.refutation(&part.cell, (all, part.linear.as_ref()), further);
        if let Some([stated, found]) = self.spreads.density_refutation(&part.cell, further) {
            let Cell { patch, center, .. } = part.cell;
            return Some(format!(
                "the ratio {stated:?} of densities about {center:?} of patch {patch}, found {found:?}"
            ));
        }
        let of_mean = || mean.then(|| self.spreads.refutation_of_mean(&part.cell, all, stated)).flatten();
        let SpreadRefutation { patch, parameters, is_mean, stated, found } = of_points.or_else(of_mean)?;
        let what = if is_mean { "mean about" } else { "point" };
        let surface = self.pair.patch_of_a(patch).surface;
        Some(format!(
            "{stated:?} at the {what} {parameters:?} of patch {patch} of surface {surface}, found {found:?}"
        ))
    }

    fn strike(&mut self) {
        self.spreads.strike();
    }
}
