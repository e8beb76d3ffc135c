//! Pairs of pieces, divided until each is decided.

use super::audit::{Audited, FromShared, Ways, from_side, from_touch, points_of};
use super::complex::{Complex, Place, SharedEdge, Touch};
use super::directions::{Direction, EdgeCone, common_side};
use super::division::{Division, Shape, Task, decide};
use super::piece::{Piece, Side};
use super::sheets::{Plane, SheetSearch};
use super::{Limits, Verdict};
use crate::axis::Axis;
use crate::bezier::PatchSet;
use crate::bvh::Aabb;
use crate::clearance::hull_distance;
use crate::param_box::ParamBox;
use crate::rounding::{VANISHING_LENGTH, gamma};
use glam::DVec3;
use std::cell::OnceCell;

/// The roundings of the distance of two hulls (lemma C2 of docs/clearance.md).
const HULL_ROUNDINGS: f64 = 64.0;

/// The search over all pairs of pieces of a body.
pub(super) struct Search<'a> {
    patches: &'a PatchSet,
    complex: &'a Complex,
    sheets: Option<&'a SheetSearch<'a>>,
    pieces: Vec<Piece>,
    audited: Audited,
}

impl<'a> Search<'a> {
    pub(super) fn new(
        patches: &'a PatchSet,
        complex: &'a Complex,
        sheets: Option<&'a SheetSearch<'a>>,
        nearness: f64,
    ) -> Self {
        let whole = |index: usize| new_piece(complex, patches, index as u32, UNIT, 0);
        let pieces: Vec<Piece> = (0..patches.len()).map(whole).collect();
        let aabb = pieces.iter().fold(Aabb::EMPTY, |aabb, piece| aabb.union(piece.aabb));
        let rounding = gamma(HULL_ROUNDINGS) * aabb.farthest_from_origin() + VANISHING_LENGTH;
        Self { patches, complex, sheets, pieces, audited: Audited::new(nearness + rounding) }
    }

    /// Decides all pairs, or returns the first that is not decided.
    pub(super) fn run(self, limits: &Limits<'_>) -> Verdict {
        let wholes = self.pieces.len() as u32;
        decide(self, wholes, |_| true, limits)
    }

    fn piece(&self, index: u32) -> &Piece {
        &self.pieces[index as usize]
    }

    /// Returns the distance up to which points are near each other, with the rounding of distances.
    pub(super) fn apart(&self) -> f64 {
        self.audited.apart()
    }

    /// Returns an upper bound on the way, on the surface of their face, between points of two pieces that are near each other
    /// (lemma S8, a), if both are of one trimmed face.
    fn on_one_sheet(&self, pieces: [&Piece; 2], most: f64) -> Option<f64> {
        let sheets = self.sheets?;
        let [one, other] = pieces.map(|piece| sheets.sheet(piece.patch));
        let sheet = one.filter(|_| one == other)?;
        let together = sheets.together(sheet, pieces)?;
        let ways = Ways { rest: together.ways.rest + 2.0 * sheets.off(), ..together.ways };
        self.audited.stated(ways, most, |slack| together.holds(ways, slack))
    }

    /// Returns an upper bound on the ways from points of two pieces that are near each other to an edge or a corner, if the
    /// first one is of a trimmed face, and the second one leaves the surface of that there (lemma S8, d).
    fn off_sheet(&self, on: &Piece, off: &Piece, most: f64) -> Option<f64> {
        let sheets = self.sheets?;
        let sheet = sheets.sheet(on.patch)?;
        let plane = sheets.plane(sheet);
        let near = 2.0 * sheets.off();
        let image = OnceCell::new();
        let ways = |range: &ParamBox, directions: &[Direction], (steps, rest): (f64, f64)| {
            let image = (*image.get_or_init(|| sheets.image(on.patch, &on.range)))?;
            let ways = sheets.directions(sheet, &image.union(range))?.leaving(directions)?;
            Some(Ways { rest: ways.rest + near + steps + 2.0 * rest, ..ways })
        };
        let from_plane =
            |plane: Plane, points: &[DVec3], directions: &[Direction], (steps, rest): (f64, f64)| {
                let rest = near + plane.off() + plane.distance(points) + steps + 2.0 * rest;
                Some(Ways { margin: plane.leaving(directions)?, rest })
            };
        let stated = |ways: Option<Ways>, of_off: &dyn Fn() -> Vec<FromShared>| {
            self.audited.stated_between(ways?, most, || [points_of(on, self.patches), of_off()])
        };
        let mut on_sheet = Vec::new();
        for (edge, own, other) in self.complex.edges_with(off.patch, sheet) {
            let side = edge.sides[own];
            if !off.touches(side) || !edge.has_side(off, own) {
                continue;
            }
            on_sheet.push(side);
            let (directions, rest) = (off.inwards(side).collect::<Vec<_>>(), off.along(side.axis).rest);
            let found = match plane {
                Some(plane) => from_plane(plane, &off.side_points(side), &directions, (0.0, rest)),
                None => edge.image_of(off, own, self.apart()).and_then(|(part, width)| {
                    let range = sheets.image_of_side(other, edge.sides[1 - own], part)?;
                    ways(&range, &directions, (width, rest))
                }),
            };
            let found = stated(found, &|| from_side(off, side, self.patches));
            if found.is_some() {
                return found;
            }
        }
        for place in self.complex.places(off.patch) {
            let Some(touch) = place.touch(off) else { continue };
            // Along such a side, the piece does not leave the surface.
            if on_sheet.iter().any(|&side| touch.is_end_of(side)) {
                continue;
            }
            let Some((patch, Place::Point([u, v]))) = self.complex.place_of(place.corner, sheet) else {
                continue;
            };
            let (directions, rest) = from_corner(off, touch);
            let spread = self.complex.spread(place.corner);
            let found = match plane {
                Some(plane) => from_plane(plane, &corner_points(off, touch), &directions, (spread, rest)),
                None => sheets
                    .image(patch, &ParamBox::new([u; 2], [v; 2]))
                    .and_then(|range| ways(&range, &directions, (spread, rest))),
            };
            let found = stated(found, &|| from_touch(off, touch, self.patches));
            if found.is_some() {
                return found;
            }
        }
        None
    }

    /// Returns an upper bound on the way between two points of a piece that are near each other (lemma S8, a).
    fn alone(&self, piece: &Piece, most: f64) -> Option<f64> {
        let [along_u, along_v] = Axis::BOTH.map(|axis| piece.along(axis));
        let of = |is_turned: bool| along_u.turned(false).chain(along_v.turned(is_turned)).collect::<Vec<_>>();
        if along_u.list.is_empty() || along_v.list.is_empty() {
            return None;
        }
        let (_, same) = common_side(&of(false))?;
        let (_, opposite) = common_side(&of(true))?;
        let margin = if same < opposite { same } else { opposite };
        let ways = Ways { margin, rest: 2.0 * (along_u.rest + along_v.rest) };
        self.audited.stated(ways, most, |slack| ways.hold_on(piece.grid(self.patches), slack))
    }

    /// Returns an upper bound on the way between points of two pieces that are near each other, 0 if there are none, if one
    /// of at most `most` is found (lemma S8).
    fn of_two(&self, [a, b]: [&Piece; 2], most: f64) -> Option<f64> {
        if !a.aabb.grown(self.apart()).meets(&b.aabb) {
            return Some(0.0);
        }
        let halves = self.sides_of_halves([a, b]);
        let joined = self.joined_sides([a, b]);
        let corners = self.corners([a, b]);
        let is_alone = halves.is_empty() && joined.is_empty() && corners.is_empty();
        if is_alone && self.are_apart(a, b) {
            return Some(0.0);
        }
        let on_sheets = || {
            self.on_one_sheet([a, b], most)
                .or_else(|| self.off_sheet(a, b, most))
                .or_else(|| self.off_sheet(b, a, most))
        };
        let within = on_sheets();
        if within.is_some() || is_alone {
            return within;
        }
        let beside_halves =
            halves.into_iter().filter_map(|(pieces, sides)| self.beside(pieces, sides, (0.0, false), most));
        let beside_edges =
            joined.into_iter().filter_map(|(pieces, edge)| self.beside_edge(pieces, edge, most));
        let about_corners =
            corners.into_iter().filter_map(|(touches, spread)| self.about([a, b], touches, spread, most));
        beside_halves.chain(beside_edges).chain(about_corners).next()
    }

    /// Returns true only if the hulls of two pieces are farther from each other than what is near (lemma S8, e).
    fn are_apart(&self, a: &Piece, b: &Piece) -> bool {
        let start = a.aabb.center() - b.aabb.center();
        hull_distance(&a.points, &b.points, start, 2.0 * self.apart(), 0.0).lower > self.apart()
    }

    /// Returns the sides along which two pieces of one patch meet, with the pieces in the order of these.
    fn sides_of_halves<'p>(&self, [a, b]: [&'p Piece; 2]) -> Vec<([&'p Piece; 2], [Side; 2])> {
        if a.patch != b.patch {
            return Vec::new();
        }
        let orders = [[a, b], [b, a]];
        let all = Axis::BOTH.into_iter().flat_map(|axis| orders.map(|order| (axis, order)));
        let meeting = all.filter(|&(axis, [low, high])| {
            let [one, other] = [low, high].map(|piece| piece.range[axis.other()]);
            low.range[axis][1] == high.range[axis][0] && one[0] <= other[1] && other[0] <= one[1]
        });
        meeting.map(|(axis, order)| (order, [Side { axis, end: 1 }, Side { axis, end: 0 }])).collect()
    }

    /// Returns the edges of patches that two pieces have sides of, with the pieces in the order of these sides.
    fn joined_sides<'p>(&self, [a, b]: [&'p Piece; 2]) -> Vec<([&'p Piece; 2], &SharedEdge)> {
        let all = self.complex.edges([a.patch, b.patch], [a, b]);
        all.filter(|(pieces, edge)| (0..2).all(|k| pieces[k].touches(edge.sides[k]))).collect()
    }

    /// Returns the corners that two pieces share, with how they have them, and the spread of each.
    fn corners(&self, [a, b]: [&Piece; 2]) -> Vec<([Touch; 2], f64)> {
        let places = [a, b].map(|piece| self.complex.places(piece.patch));
        let pairs = places[0].iter().flat_map(|one| {
            places[1].iter().filter(|other| other.corner == one.corner).map(move |other| (one, other))
        });
        let touching = pairs.filter_map(|(one, other)| {
            Some(([one.touch(a)?, other.touch(b)?], self.complex.spread(one.corner)))
        });
        touching.collect()
    }

    /// Returns what [`Self::beside`] does for two pieces at a joined edge.
    fn beside_edge(&self, pieces: [&Piece; 2], edge: &SharedEdge, most: f64) -> Option<f64> {
        let widths = [0, 1].map(|first| edge.width(pieces, first, self.apart()));
        widths.into_iter().flatten().find_map(|width| self.beside(pieces, edge.sides, width, most))
    }

    /// Returns an upper bound on the ways from points of two pieces that are near each other to the side that these share,
    /// whose parts are this far from each other and run against each other or not (lemma S8, b).
    fn beside(
        &self,
        [a, b]: [&Piece; 2],
        sides: [Side; 2],
        (width, is_reversed): (f64, bool),
        most: f64,
    ) -> Option<f64> {
        let edges = [a.along_side(sides[0]), b.along_side(sides[1])];
        let along: Vec<Direction> = edges[0].turned(false).chain(edges[1].turned(is_reversed)).collect();
        let cone = EdgeCone::of(&along)?;
        let turned = b.along(sides[1].axis).turned(sides[1].end == 0);
        let directions: Vec<Direction> = a.inwards(sides[0]).chain(turned).collect();
        let margin = cone.margin(&directions)?;
        let inwards = a.along(sides[0].axis).rest + b.along(sides[1].axis).rest;
        let ways = Ways { margin, rest: width + 2.0 * inwards + edges[0].rest + edges[1].rest };
        self.audited.stated_between(ways, most, || {
            [from_side(a, sides[0], self.patches), from_side(b, sides[1], self.patches)]
        })
    }

    /// Returns an upper bound on the ways from points of two pieces that are near each other to the corner that these
    /// share, whose points are this far from each other (lemma S8, c).
    fn about(&self, pieces: [&Piece; 2], touches: [Touch; 2], spread: f64, most: f64) -> Option<f64> {
        let [(mut directions, rest), (others, other)] = [0, 1].map(|k| from_corner(pieces[k], touches[k]));
        directions.extend(others.into_iter().map(Direction::back));
        let (_, margin) = common_side(&directions)?;
        let ways = Ways { margin, rest: spread + 2.0 * (rest + other) };
        self.audited
            .stated_between(ways, most, || [0, 1].map(|k| from_touch(pieces[k], touches[k], self.patches)))
    }
}

impl Division for Search<'_> {
    fn shape(&self, index: u32) -> Shape {
        let piece = self.piece(index);
        let &Piece { patch, aabb, level, .. } = piece;
        // A piece with a corner of others on a side is no neighbour of theirs before it is divided there.
        Shape { patch, aabb, level, is_first: piece.place.is_some() }
    }

    fn gain(&self, index: u32) -> f64 {
        self.piece(index).cut().gain
    }

    fn halves(&mut self, index: u32) -> [u32; 2] {
        if let Some(halves) = self.piece(index).halves {
            return halves;
        }
        let piece = self.piece(index);
        let (patch, level) = (piece.patch, piece.level + 1);
        let (axis, at) = piece.cut().at;
        let [mut low, mut high] = [piece.range; 2];
        (low[axis][1], high[axis][0]) = (at, at);
        let first = self.pieces.len() as u32;
        let new = |range: ParamBox| new_piece(self.complex, self.patches, patch, range, level);
        self.pieces.extend([low, high].map(new));
        let halves = [first, first + 1];
        self.pieces[index as usize].halves = Some(halves);
        halves
    }

    fn within(&self, task: Task, most: f64) -> Option<f64> {
        match task {
            Task::One(index) => {
                let piece = self.piece(index);
                self.on_one_sheet([piece; 2], most).or_else(|| self.alone(piece, most))
            }
            Task::Two(pieces) => self.of_two(pieces.map(|index| self.piece(index)), most),
        }
    }

    fn audited(&self) -> &Audited {
        &self.audited
    }
}

/// Returns the directions from a corner of a piece, or from a side that is a point, into it, and their rest.
fn from_corner(piece: &Piece, touch: Touch) -> (Vec<Direction>, f64) {
    let mut found = (Vec::new(), 0.0);
    let mut add = |axis: Axis, end: usize| {
        let along = piece.along(axis);
        found.0.extend(along.turned(end == 1));
        found.1 += along.rest;
    };
    match touch {
        Touch::Corner([u, v]) => {
            add(Axis::U, u);
            add(Axis::V, v);
        }
        Touch::Side(Side { axis, end }) => add(axis, end),
    }
    found
}

/// Returns the point of a corner, or those of a side that is one.
fn corner_points(piece: &Piece, touch: Touch) -> Vec<DVec3> {
    match touch {
        Touch::Corner(ends) => vec![piece.corner(ends)],
        Touch::Side(side) => piece.side_points(side),
    }
}

fn new_piece(complex: &Complex, patches: &PatchSet, patch: u32, range: ParamBox, level: u32) -> Piece {
    let places = complex.places(patch).iter().filter_map(|place| place.point());
    Piece::new(&patches.patch(patch as usize), patch, range, level, places)
}

/// All parameters of a patch.
const UNIT: ParamBox = ParamBox::UNIT;
