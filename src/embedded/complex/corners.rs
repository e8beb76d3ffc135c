//! Corners of patches, and which of them are one.

use super::{Piece, Side, ascending, on_side, side};
use crate::axis::Axis;
use crate::bezier::BezierModel;
use crate::bvh::Aabb;
use crate::param_box::ParamBox;
use crate::solid::{Arc, Clusters};
use crate::sorting::sort_by_number;
use std::collections::HashMap;

/// A place of a patch at a corner that it may share with others.
#[derive(Debug, Clone, Copy)]
pub(in crate::embedded) struct CornerPlace {
    pub(in crate::embedded) corner: u32,
    pub(in crate::embedded) at: Place,
}

/// A point of a patch's rim, or a side that is a point.
#[derive(Debug, Clone, Copy)]
pub(in crate::embedded) enum Place {
    Point([f64; 2]),
    Side(Side),
}

/// The way in which a piece has a place.
#[derive(Debug, Clone, Copy)]
pub(in crate::embedded) enum Touch {
    /// A corner of it, by the ends of both parameters.
    Corner([usize; 2]),
    /// A side of it, which is a point.
    Side(Side),
}

impl Touch {
    /// Returns whether a side of the piece begins or ends there.
    pub(in crate::embedded) fn is_end_of(self, side: Side) -> bool {
        match self {
            Self::Corner(ends) => ends[side.axis] == side.end,
            Self::Side(point) => point.axis != side.axis,
        }
    }
}

impl CornerPlace {
    /// Returns the way in which a piece of the patch has the place at a corner or as a whole side, if it does.
    pub(in crate::embedded) fn touch(&self, piece: &Piece) -> Option<Touch> {
        match self.at {
            Place::Side(side) => piece.touches(side).then_some(Touch::Side(side)),
            Place::Point(point) => {
                let end = |axis: usize| piece.range[axis].iter().position(|&end| end == point[axis]);
                Some(Touch::Corner([end(0)?, end(1)?]))
            }
        }
    }

    /// Returns the parameters of a point.
    pub(in crate::embedded) fn point(&self) -> Option<[f64; 2]> {
        match self.at {
            Place::Point(point) => Some(point),
            Place::Side(_) => None,
        }
    }
}

/// A place by its patch and the bits of its parameters.
type Key = (u32, [u64; 2]);

/// The corners of patches, and which of them are one.
pub(super) struct Corners {
    numbers: HashMap<Key, u32>,
    joined: Vec<[u32; 2]>,
    /// The parts of the sides of each patch that are arcs.
    covered: Vec<[Vec<[f64; 2]>; 4]>,
}

impl Corners {
    pub(super) fn new(patches: usize) -> Self {
        let mut corners =
            Self { numbers: HashMap::new(), joined: Vec::new(), covered: vec![Default::default(); patches] };
        for patch in 0..patches as u32 {
            for at in [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]] {
                corners.number(patch, at);
            }
        }
        corners
    }

    fn number(&mut self, patch: u32, at: [f64; 2]) -> u32 {
        let next = self.numbers.len() as u32;
        *self.numbers.entry((patch, at.map(f64::to_bits))).or_insert(next)
    }

    /// Makes one corner of two places.
    pub(super) fn join(&mut self, places: [(u32, [f64; 2]); 2]) {
        let both = places.map(|(patch, at)| self.number(patch, at));
        self.joined.push(both);
    }

    /// Notes that a part of a side is an arc.
    pub(super) fn cover(&mut self, arc: &Arc) {
        let Side { axis, end } = side(arc.place);
        let range = ascending(arc.range);
        self.covered[arc.place.index as usize][2 * axis.index() + end].push(range);
        for along in range {
            self.number(arc.place.index, on_side(Side { axis, end }, along));
        }
    }

    /// Returns the places of each patch, and the spread of each corner. The parts between the arcs of a side of a surface
    /// are points, and so is a side without arcs.
    pub(super) fn into_places(mut self, model: &BezierModel) -> (Vec<Vec<CornerPlace>>, Vec<f64>) {
        let mut whole = Vec::new();
        for (patch, side) in rims(model) {
            let mut parts =
                std::mem::take(&mut self.covered[patch as usize][2 * side.axis.index() + side.end]);
            sort_by_number(&mut parts, |&[low, _]| low);
            if parts.is_empty() {
                whole.push((patch, side));
            }
            let mut known = 0.0;
            for [low, high] in parts.into_iter().chain([[1.0, 1.0]]) {
                if low > known {
                    self.join([known, low].map(|along| (patch, on_side(side, along))));
                }
                known = high;
            }
        }
        let Self { numbers, joined, .. } = self;
        let mut classes = Clusters::separate(numbers.len());
        joined.into_iter().for_each(|[a, b]| classes.join(a, b));
        let mut places = vec![Vec::new(); model.patches.len()];
        let mut boxes = vec![Aabb::EMPTY; numbers.len()];
        for (&(patch, bits), &number) in &numbers {
            let (corner, at) = (classes.of(number), bits.map(f64::from_bits));
            boxes[corner as usize] =
                boxes[corner as usize].with(model.patches.patch(patch as usize).point(at));
            places[patch as usize].push(CornerPlace { corner, at: Place::Point(at) });
        }
        for (patch, side) in whole {
            let number = numbers.get(&(patch, on_side(side, 0.0).map(f64::to_bits)));
            let Some(corner) = number.map(|&number| classes.of(number)) else { continue };
            let of_patch = model.patches.patch(patch as usize);
            let piece = Piece::new(&of_patch, patch, ParamBox::UNIT, 0, std::iter::empty());
            let points = piece.side_points(side);
            boxes[corner as usize] = points.into_iter().fold(boxes[corner as usize], Aabb::with);
            places[patch as usize].push(CornerPlace { corner, at: Place::Side(side) });
        }
        for list in &mut places {
            // A table has no order of its own.
            list.sort_by_key(|place| (place.corner, place.point().map(|point| point.map(f64::to_bits))));
        }
        (
            places,
            boxes.into_iter().map(|aabb| if aabb == Aabb::EMPTY { 0.0 } else { aabb.diagonal() }).collect(),
        )
    }
}

/// Returns the sides of patches at which their surfaces end.
fn rims(model: &BezierModel) -> Vec<(u32, Side)> {
    let mut found = Vec::new();
    for grid in &model.grids {
        let [rows, columns] = grid.counts();
        for index in 0..rows * columns {
            let place = [index / columns, index % columns];
            let patch = (grid.first + index) as u32;
            let degree = model.patches.patch(patch as usize).degree;
            for axis in Axis::BOTH {
                for end in 0..2 {
                    let line = place[axis] + end;
                    let is_end = line == 0 || line == grid.counts()[axis];
                    if is_end || usize::from(grid.multiplicities[axis][line]) > degree[axis] {
                        found.push((patch, Side { axis, end }));
                    }
                }
            }
        }
    }
    found
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn a_corner_is_an_end_of_the_two_sides_that_meet_there() {
        let ends_of = |touch: Touch| {
            let sides = Axis::BOTH.into_iter().flat_map(|axis| [0, 1].map(|end| Side { axis, end }));
            sides.filter(|&side| touch.is_end_of(side)).map(|side| (side.axis, side.end)).collect::<Vec<_>>()
        };
        assert_eq!(ends_of(Touch::Corner([0, 1])), [(Axis::U, 0), (Axis::V, 1)]);
        let point = Side { axis: Axis::U, end: 1 };
        assert_eq!(ends_of(Touch::Side(point)), [(Axis::V, 0), (Axis::V, 1)], "those across from a pole");
    }
}
