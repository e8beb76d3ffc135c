//! What the patches of a body have in common by their joined edges: sides and corners.

use super::piece::{Piece, Side};
use crate::axis::Axis;
use crate::bezier::{BezierModel, Patch, PatchGrid};
use crate::bvh::Aabb;
use crate::param_box::ParamBox;
use crate::rounding::{upper_max, upper_min};
use crate::solid::{Arc, Clusters, Curve, EdgePlace, JoinedArc, edge_width};
use glam::DVec3;
use std::collections::HashMap;

/// A side that two patches have in common, or two sides of one patch.
#[derive(Debug)]
pub(super) struct SharedEdge {
    /// The side of each.
    pub(super) sides: [Side; 2],
    /// The arcs of two faces that were joined, in one direction; none of neighbours in a surface, which have the same
    /// parameters there.
    pub(super) arcs: Option<[Arc; 2]>,
}

/// A place of a patch at a corner that it may share with others.
#[derive(Debug, Clone, Copy)]
pub(super) struct CornerPlace {
    pub(super) corner: u32,
    pub(super) at: Place,
}

/// A point of a patch's rim, or a side that is a point.
#[derive(Debug, Clone, Copy)]
pub(super) enum Place {
    Point([f64; 2]),
    Side(Side),
}

/// The way in which a piece has a place.
#[derive(Debug, Clone, Copy)]
pub(super) enum Touch {
    /// A corner of it, by the ends of both parameters.
    Corner([usize; 2]),
    /// A side of it, which is a point.
    Side(Side),
}

/// A part of a side of a patch at which a trimmed face ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct RimArc {
    pub(super) sheet: usize,
    pub(super) patch: u32,
    pub(super) side: Side,
    /// The parameters along the side, the lesser first.
    pub(super) range: [f64; 2],
    /// The corners at its ends.
    pub(super) corners: [Option<u32>; 2],
}

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
    /// Two patches of a surface whose common side is a point, and that point.
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

    /// Returns two patches of a surface whose common side is a point, at which the surface is none, and that point.
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

    /// Returns the edges that two patches share, with whether the first of an edge's sides is the second patch's.
    pub(super) fn edges(&self, [a, b]: [u32; 2]) -> (&[SharedEdge], bool) {
        let key = [a.min(b), a.max(b)];
        (self.edges.get(&key).map_or(&[], Vec::as_slice), a > b)
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

impl CornerPlace {
    /// Returns the way in which a piece of the patch has the place at a corner or as a whole side, if it does.
    pub(super) fn touch(&self, piece: &Piece) -> Option<Touch> {
        match self.at {
            Place::Side(side) => piece.touches(side).then_some(Touch::Side(side)),
            Place::Point(point) => {
                let end = |axis: usize| piece.range[axis].iter().position(|&end| end == point[axis]);
                Some(Touch::Corner([end(0)?, end(1)?]))
            }
        }
    }

    /// Returns the parameters of a point.
    pub(super) fn point(&self) -> Option<[f64; 2]> {
        match self.at {
            Place::Point(point) => Some(point),
            Place::Side(_) => None,
        }
    }
}

impl SharedEdge {
    /// Returns the part of the other patch's side that corresponds to that of a piece, which has this one of both sides,
    /// and an upper bound on the distance of points that correspond; none if the piece's side is not within its arc.
    pub(super) fn image_of(&self, piece: &Piece, own: usize, narrow: f64) -> Option<([f64; 2], f64)> {
        let arcs = self.arcs.as_ref()?;
        image(&arcs[own], piece.range[self.sides[own].axis.other()], &arcs[1 - own], narrow)
    }

    /// Returns whether the side of a piece, which has this one of both sides, is within its arc.
    pub(super) fn has_side(&self, piece: &Piece, own: usize) -> bool {
        let Some(arcs) = &self.arcs else { return true };
        let [[low, high], [from, to]] = [piece.range[self.sides[own].axis.other()], arcs[own].range];
        if from < to { from <= low && high <= to } else { to <= low && high <= from }
    }

    /// Returns an upper bound on the distance of each point of one piece's side from a point of the other one's such that
    /// both and those of the edge between them follow each other, and whether the sides run against each other; none if
    /// the pieces have no parts of the edge that meet. `first` is the number of the piece whose side is within its arc.
    ///
    /// Where the parts of the edge only end at the same point, that is the distance of both ends.
    pub(super) fn width(&self, pieces: [&Piece; 2], first: usize, narrow: f64) -> Option<(f64, bool)> {
        let interval = |k: usize| pieces[k].range[self.sides[k].axis.other()];
        let Some(arcs) = &self.arcs else {
            let [a, b] = [interval(0), interval(1)];
            return (a[0] <= b[1] && b[0] <= a[1]).then_some((0.0, false));
        };
        let second = 1 - first;
        let [inner, outer] = [&arcs[first], &arcs[second]];
        let is_reversed = (inner.range[0] > inner.range[1]) != (outer.range[0] > outer.range[1]);
        let (image, width) = image(inner, interval(first), outer, narrow)?;
        let own = interval(second);
        if own[0] <= image[1] && image[0] <= own[1] {
            return Some((width, is_reversed));
        }
        // Next to each other but for rounding: the ends that are nearest.
        let is_before = own[1] < image[0];
        let apart = if is_before { image[0] - own[1] } else { own[0] - image[1] };
        let corner = |k: usize, high: bool| {
            let Side { axis, end } = self.sides[k];
            let mut ends = [usize::from(high); 2];
            ends[axis] = end;
            pieces[k].corner(ends)
        };
        let ends = [corner(second, is_before), corner(first, is_before == is_reversed)];
        (apart < MAX_APART).then(|| (ends[0].distance(ends[1]), is_reversed))
    }
}

/// The distance of parameters up to which two parts of an edge that were found to end beside each other may end at the
/// same point: that distance is measured.
const MAX_APART: f64 = 1e-3;

/// Returns the part of an arc's side that corresponds to a part of its partner's, and an upper bound on the distance of
/// points that correspond (lemma S5 of docs/solids.md). A bound of at most `narrow` is not improved. Returns none if that
/// part is not within the partner.
fn image(inner: &Arc, interval: [f64; 2], outer: &Arc, narrow: f64) -> Option<([f64; 2], f64)> {
    let [from, to] = inner.range;
    let local = |t: f64| (t - from) / (to - from);
    let mut ends = interval.map(local);
    if from > to {
        ends.reverse();
    }
    let [low, high] = ends;
    if !(0.0 <= low && low < high && high <= 1.0) {
        return None;
    }
    let image_of =
        |t: f64| if t == 0.0 || t == 1.0 { t } else { outer.curve.closest(inner.curve.point(t)).0 };
    let found = [low, high].map(image_of);
    let width = width_of([&inner.curve, &outer.curve], [[low, high], found], (narrow, MAX_WIDTH_DIVISIONS))?;
    let [from, to] = outer.range;
    let mut image = found.map(|t| if t == 1.0 { to } else { from + t * (to - from) });
    if from > to {
        image.reverse();
    }
    Some((image, width))
}

/// The largest number of times that a part is divided for a smaller bound on the width. Each division leaves an eighth of
/// the bound.
const MAX_WIDTH_DIVISIONS: u32 = 4;

/// Returns an upper bound on the distance of points that correspond on parts of two curves, divided at points of the second
/// one that are closest to the middles of the first; none if these do not follow each other.
fn width_of(
    curves: [&Curve; 2],
    [one, other]: [[f64; 2]; 2],
    (narrow, divisions): (f64, u32),
) -> Option<f64> {
    if other[0].partial_cmp(&other[1]) != Some(std::cmp::Ordering::Less) {
        return None;
    }
    let width = edge_width([curves[1].part(other), curves[0].part(one)]);
    if width <= narrow || divisions == 0 {
        return Some(width);
    }
    let middle = 0.5 * (one[0] + one[1]);
    let image = curves[1].closest(curves[0].point(middle)).0;
    let halves = [[[one[0], middle], [other[0], image]], [[middle, one[1]], [image, other[1]]]];
    let widths = halves.map(|half| width_of(curves, half, (narrow, divisions - 1)));
    match widths {
        [Some(low), Some(high)] => Some(upper_min(width, upper_max(low, high))),
        _ => Some(width),
    }
}

/// Returns the point that the last side of a patch along an axis is, if it is one.
pub(super) fn pinch_of(patch: &Patch<'_>, axis: Axis) -> Option<DVec3> {
    let piece = Piece::new(patch, 0, ParamBox::UNIT, 0, std::iter::empty());
    let side = Side { axis, end: 1 };
    piece
        .along_side(side)
        .list
        .is_empty()
        .then(|| piece.corner([usize::from(axis == Axis::U), usize::from(axis == Axis::V)]))
}

/// Adds the arcs of an edge at which trimmed faces end, with corners that are not known yet.
fn add_rims(
    rims: &mut Vec<RimArc>,
    arcs: [Option<&Arc>; 2],
    sheet: impl Fn(u32) -> Option<usize>,
    near: f64,
) {
    let sheets = arcs.map(|arc| sheet(arc?.place.index));
    if let [Some(one), Some(other)] = arcs
        && sheets[0] == sheets[1]
        && is_within(one, other, near)
    {
        return;
    }
    for (arc, sheet) in arcs.into_iter().zip(sheets) {
        let Some((arc, sheet)) = arc.zip(sheet) else { continue };
        let range = ascending(arc.range);
        rims.push(RimArc { sheet, patch: arc.place.index, side: side(arc.place), range, corners: [None; 2] });
    }
}

/// Returns whether the points of two arcs that correspond are known to be at most `near` apart.
fn is_within(one: &Arc, other: &Arc, near: f64) -> bool {
    let widths = [[one, other], [other, one]].map(|[inner, outer]| {
        let (_, width) = image(inner, ascending(inner.range), outer, near)?;
        Some(width)
    });
    widths.into_iter().flatten().any(|width| width <= near)
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

/// A place by its patch and the bits of its parameters.
type Key = (u32, [u64; 2]);

/// The corners of patches, and which of them are one.
struct Corners {
    numbers: HashMap<Key, u32>,
    joined: Vec<[u32; 2]>,
    /// The parts of the sides of each patch that are arcs.
    covered: Vec<[Vec<[f64; 2]>; 4]>,
}

impl Corners {
    fn new(patches: usize) -> Self {
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
    fn join(&mut self, places: [(u32, [f64; 2]); 2]) {
        let both = places.map(|(patch, at)| self.number(patch, at));
        self.joined.push(both);
    }

    /// Notes that a part of a side is an arc.
    fn cover(&mut self, arc: &Arc) {
        let Side { axis, end } = side(arc.place);
        let range = ascending(arc.range);
        self.covered[arc.place.index as usize][2 * axis.index() + end].push(range);
        for along in range {
            self.number(arc.place.index, on_side(Side { axis, end }, along));
        }
    }

    /// Returns the places of each patch, and the spread of each corner. The parts between the arcs of a side of a surface
    /// are points, and so is a side without arcs.
    fn into_places(mut self, model: &BezierModel) -> (Vec<Vec<CornerPlace>>, Vec<f64>) {
        let mut whole = Vec::new();
        for (patch, side) in rims(model) {
            let mut parts =
                std::mem::take(&mut self.covered[patch as usize][2 * side.axis.index() + side.end]);
            parts.sort_by(|a, b| a[0].total_cmp(&b[0]));
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

impl Curve {
    /// Returns the part over an interval of positive length in [0, 1].
    fn part(&self, [low, high]: [f64; 2]) -> Self {
        let mut part = self.clone();
        if high < 1.0 {
            [part, _] = part.split(high);
        }
        if low > 0.0 {
            [_, part] = part.split(low / high);
        }
        part
    }
}
