//! What the patches of a body have in common by their joined edges: sides and corners.

mod corners;
mod edge;
mod rim;

pub(super) use corners::{CornerPlace, Place, Touch};
pub(super) use edge::SharedEdge;
pub(super) use rim::{RimArc, pinch_of};

use super::piece::{Piece, Side};
use crate::axis::Axis;
use crate::bezier::{BezierModel, PatchGrid};
use crate::solid::{EdgePlace, JoinedArc};
use corners::Corners;
use glam::DVec3;
use rim::add_rims;
use std::collections::HashMap;

/// The patches of a body, with what joined edges identify.
#[derive(Debug)]
pub(super) struct Complex {
    /// By the lower patch and the higher one.
    edges: HashMap<[u32; 2], Vec<SharedEdge>>,
    /// The places of each patch.
    places: Vec<Vec<CornerPlace>>,
    /// The diagonal of a box about the points of each corner.
    spreads: Vec<f64>,
    /// The edges of each patch that were joined to one of a trimmed face, by the surface of that.
    edges_with: HashMap<(u32, usize), Vec<EdgeKey>>,
    /// A place of a trimmed face at each corner that it has.
    corners_of: HashMap<(u32, usize), (u32, Place)>,
    /// What the rims of trimmed faces consist of.
    rims: Vec<RimArc>,
    /// Two neighbouring patches of a surface that meet in a point and not along a side, with that point.
    pinch: Option<([u32; 2], DVec3)>,
}

/// An edge by its patches and its place among theirs.
type EdgeKey = ([u32; 2], usize);

impl Complex {
    /// Makes the complex of patches whose surfaces are joined at these arcs. `sheet` names the surface of the trimmed face
    /// that a patch lies on, if it lies on one. Arcs of one face that are joined to each other and known to be at most `near`
    /// apart are no rim of it. O(patches + arcs).
    pub(super) fn new(
        model: &BezierModel,
        joined: Vec<JoinedArc>,
        sheet: impl Fn(u32) -> Option<usize>,
        near: f64,
    ) -> Self {
        let mut corners = Corners::new(model.patches.len());
        let mut edges: HashMap<[u32; 2], Vec<SharedEdge>> = HashMap::new();
        let mut pinch = None;
        for grid in &model.grids {
            for (patches, axis) in neighbours(model, grid) {
                if let Some(point) = pinch_of(&model.patches.patch(patches[0] as usize), axis) {
                    pinch = Some((patches, point));
                }
                let sides = [Side { axis, end: 1 }, Side { axis, end: 0 }];
                for along in [0.0, 1.0] {
                    corners.join([0, 1].map(|k| (patches[k], on_side(sides[k], along))));
                }
                edges.entry(patches).or_default().push(SharedEdge { sides, arcs: None });
            }
        }
        let mut rims = Vec::new();
        for JoinedArc { one, other, .. } in joined {
            add_rims(&mut rims, [Some(&one), other.as_ref()], &sheet, near);
            corners.cover(&one);
            let Some(other) = other else { continue };
            corners.cover(&other);
            for end in 0..2 {
                corners.join(
                    [&one, &other].map(|arc| (arc.place.index, on_side(side(arc.place), arc.range[end]))),
                );
            }
            let arcs = if one.place.index <= other.place.index { [one, other] } else { [other, one] };
            let sides = [0, 1].map(|k| side(arcs[k].place));
            let patches = [0, 1].map(|k| arcs[k].place.index);
            edges.entry(patches).or_default().push(SharedEdge { sides, arcs: Some(arcs) });
        }
        let (places, spreads) = corners.into_places(model);
        let (mut edges_with, mut corners_of): (HashMap<_, Vec<EdgeKey>>, HashMap<_, _>) = Default::default();
        for (&patches, list) in &edges {
            let [a, b] = patches.map(&sheet);
            for (index, _) in list.iter().enumerate().filter(|(_, edge)| edge.arcs.is_some()) {
                for (patch, other) in [(patches[0], b), (patches[1], a)] {
                    if let Some(other) = other {
                        edges_with.entry((patch, other)).or_default().push((patches, index));
                    }
                }
            }
        }
        for (patch, list) in places.iter().enumerate() {
            let Some(sheet) = sheet(patch as u32) else { continue };
            for place in list {
                corners_of.insert((place.corner, sheet), (patch as u32, place.at));
            }
        }
        for rim in &mut rims {
            let ends = rim.range.map(|along| on_side(rim.side, along));
            let at = |end| places[rim.patch as usize].iter().find(|place| place.point() == Some(end));
            rim.corners = ends.map(|end| Some(at(end)?.corner));
        }
        Self { edges, places, spreads, edges_with, corners_of, rims, pinch }
    }

    /// Returns two neighbouring patches of a surface that meet in a point and not along a side, with that point.
    pub(super) fn pinch(&self) -> Option<([u32; 2], DVec3)> {
        self.pinch
    }

    /// Returns the arcs at which trimmed faces end.
    pub(super) fn rims(&self) -> &[RimArc] {
        &self.rims
    }

    /// Returns the edges of a patch that were joined to one of a trimmed face, with the number of the patch's side in each
    /// and the patch on the other side.
    pub(super) fn edges_with(
        &self,
        patch: u32,
        sheet: usize,
    ) -> impl Iterator<Item = (&SharedEdge, usize, u32)> {
        let keys = self.edges_with.get(&(patch, sheet)).into_iter().flatten();
        keys.filter_map(move |&(patches, index)| {
            let own = usize::from(patches[0] != patch);
            Some((self.edges.get(&patches)?.get(index)?, own, patches[1 - own]))
        })
    }

    /// Returns a place of a trimmed face at a corner, with its patch, if it has one.
    pub(super) fn place_of(&self, corner: u32, sheet: usize) -> Option<(u32, Place)> {
        self.corners_of.get(&(corner, sheet)).copied()
    }

    /// Returns the edges that two parts of these patches may share, each with the parts in the order of its sides. Parts of
    /// one patch may have either side.
    pub(super) fn edges<T: Copy>(
        &self,
        [a, b]: [u32; 2],
        [one, other]: [T; 2],
    ) -> impl Iterator<Item = ([T; 2], &SharedEdge)> {
        let orders = if a > b { [[other, one], [one, other]] } else { [[one, other], [other, one]] };
        let count = if a == b { 2 } else { 1 };
        let edges = self.edges.get(&[a.min(b), a.max(b)]).into_iter().flatten();
        edges.flat_map(move |edge| orders.into_iter().take(count).map(move |order| (order, edge)))
    }

    /// Returns the corners of a patch.
    pub(super) fn places(&self, patch: u32) -> &[CornerPlace] {
        &self.places[patch as usize]
    }

    /// Returns an upper bound on the distance of the points of a corner, but for rounding.
    pub(super) fn spread(&self, corner: u32) -> f64 {
        self.spreads[corner as usize]
    }
}

fn ascending([from, to]: [f64; 2]) -> [f64; 2] {
    if from > to { [to, from] } else { [from, to] }
}

fn side(place: EdgePlace) -> Side {
    Side { axis: place.axis, end: usize::from(place.end) }
}

/// Returns the parameters of a point of a side.
fn on_side(Side { axis, end }: Side, along: f64) -> [f64; 2] {
    match axis {
        Axis::U => [end as f64, along],
        Axis::V => [along, end as f64],
    }
}

/// Returns the pairs of patches of a surface that share a side, with the parameter that is constant along it.
fn neighbours(model: &BezierModel, grid: &PatchGrid) -> Vec<([u32; 2], Axis)> {
    let [rows, columns] = grid.counts();
    let index = |row: usize, column: usize| (grid.first + row * columns + column) as u32;
    let is_joined = |axis: Axis, line: usize| {
        let degree = model.patches.patch(grid.first).degree[axis];
        usize::from(grid.multiplicities[axis][line]) <= degree
    };
    let mut found = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            if row + 1 < rows && is_joined(Axis::U, row + 1) {
                found.push(([index(row, column), index(row + 1, column)], Axis::U));
            }
            if column + 1 < columns && is_joined(Axis::V, column + 1) {
                found.push(([index(row, column), index(row, column + 1)], Axis::V));
            }
        }
    }
    found
}
