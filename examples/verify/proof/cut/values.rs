//! The points of the pieces are those of the surface at the maps' parameters, to the limit.
//!
//! On a part of size h × k, f = piece - surface∘map differs from the bilinear function of its
//! corners' values by at most (h² |f_ss| + k² |f_tt|) / 8, and that function is at most as large as
//! the largest value. The second derivatives are bounded by the control nets.

use super::map::Map;
use super::same::is_same;
use super::{Box2, Face, Finding};
use crate::proof::bezier::{Net, Patch, SecondDerivatives, patches};
use crate::proof::frame::Motion;
use crate::proof::interval::Interval;
use crate::proof::surface::Model;
use crate::proof::vector::{Vector, difference, norm};

/// The halvings of a piece's parameters after which a part is given up.
const MAX_HALVINGS: u32 = 40;

/// The part of a knot rectangle by which a map may leave it: its patch is continued there.
const MAX_EXCESS: f64 = 1e-6;

/// Upper bound on (1 + 2 MAX_EXCESS 2^region::MAX_HALVINGS)^60, by which the bounds of a region's patch of
/// degrees up to 15, of its quotients and of their derivatives grow where it is continued.
const GROWTH: f64 = 1.01;

/// A patch of a piece over [0, 1]².
struct Place<'a> {
    map: &'a Map,
    /// The box of the piece's parameters that the patch is over.
    ranges: [[f64; 2]; 2],
}

/// A part of a patch with its own control points.
struct Part {
    parameters: [[f64; 2]; 2],
    net: Net,
    halvings: u32,
}

/// Proves the statement for all pieces.
pub(super) fn check(face: &Face<'_>, pieces: &Model, maps: &[&Map]) -> Finding {
    let mut found = Finding::PROVED;
    for Patch { net, surface, ranges } in &patches(pieces, &face.frame, &Motion::IDENTITY) {
        let map = maps[*surface];
        if matches!(map, Map::Ruled(_)) && *ranges != [[0.0, 1.0]; 2] {
            return found.and(|| Finding::OPEN);
        }
        if matches!(map, Map::Identity { .. }) && is_same(face, net, *ranges) {
            continue;
        }
        let place = Place { map, ranges: *ranges };
        found = found.and(|| patch(face, &place, net, *surface));
    }
    found
}

fn patch(face: &Face<'_>, place: &Place<'_>, net: &Net, index: usize) -> Finding {
    let mut found = Finding::PROVED;
    let mut open = vec![Part { parameters: [[0.0, 1.0]; 2], net: net.clone(), halvings: 0 }];
    while let Some(part) = open.pop() {
        let corners = place.distance_at_corners(face, &part);
        if corners.lo > face.limit {
            let at = place.corners(part.parameters)[0].map(Interval::mid);
            return Finding::refuted(format!("piece {index} is off the surface near ({}, {})", at[0], at[1]));
        }
        let bends = place.bends(face, &part);
        if corners.hi + bends[0] + bends[1] <= face.limit {
            continue;
        }
        if part.halvings == MAX_HALVINGS || face.is_late() {
            found = Finding::OPEN;
            continue;
        }
        let axis = usize::from(bends[1] > bends[0] || (bends[1] == bends[0] && part.halvings % 2 == 1));
        let [low, high] = part.parameters[axis];
        let middle = 0.5 * (low + high);
        for (net, range) in part.net.split(axis).into_iter().zip([[low, middle], [middle, high]]) {
            let mut parameters = part.parameters;
            parameters[axis] = range;
            open.push(Part { parameters, net, halvings: part.halvings + 1 });
        }
    }
    found
}

impl Place<'_> {
    /// The piece's parameters at a part of a range of the patch.
    fn at(&self, axis: usize, part: f64) -> Interval {
        let [start, end] = self.ranges[axis].map(Interval::point);
        start + Interval::point(part) * (end - start)
    }

    /// The face's parameters at the corners of a part.
    fn corners(&self, part: [[f64; 2]; 2]) -> [Box2; 4] {
        if let Map::Ruled(_) = self.map {
            return self.map.corners(part);
        }
        [[0, 0], [0, 1], [1, 0], [1, 1]].map(|ends| [0, 1].map(|axis| self.at(axis, part[axis][ends[axis]])))
    }

    /// The box of the face's parameters over a part.
    fn image(&self, part: [[f64; 2]; 2]) -> Box2 {
        if let Map::Ruled(_) = self.map {
            return self.map.hull(part);
        }
        [0, 1].map(|axis| self.at(axis, part[axis][0]).hull(self.at(axis, part[axis][1])))
    }

    /// The largest distance at the corners: the lower end holds for one of them.
    fn distance_at_corners(&self, face: &Face<'_>, part: &Part) -> Interval {
        let mut largest = Interval::ZERO;
        for (own, image) in part.net.corners().iter().zip(self.corners(part.parameters)) {
            let Some(other) = on_surface(face, &image) else {
                return Interval { lo: 0.0, hi: f64::INFINITY };
            };
            let distance = norm(&difference(own, &other));
            largest = Interval { lo: largest.lo.max(distance.lo), hi: largest.hi.max(distance.hi) };
        }
        largest
    }

    /// Bounds of `h² |f_ss| / 8` and `k² |f_tt| / 8`, infinite where the part's image leaves the
    /// knot rectangle of its middle.
    fn bends(&self, face: &Face<'_>, part: &Part) -> [f64; 2] {
        let own = SecondDerivatives::of(&part.net);
        let Some(image) = self.image_bends(face, part.parameters) else { return [f64::INFINITY; 2] };
        std::array::from_fn(|axis| {
            ((Interval::point(own.pure[axis]) + Interval::point(image[axis])) * Interval::point(0.125)).hi
        })
    }

    /// Bounds of the second derivatives of surface∘map by the parameters of a part over [0, 1]².
    fn image_bends(&self, face: &Face<'_>, part: [[f64; 2]; 2]) -> Option<[f64; 2]> {
        let image = self.image(part);
        let number = rectangle(face, image.map(Interval::mid))?;
        let patch = &face.patches[number];
        let local: Box2 = std::array::from_fn(|axis| {
            let [start, end] = patch.ranges[axis].map(Interval::point);
            (image[axis] - start) / (end - start)
        });
        if local.iter().any(|at| at.lo < -MAX_EXCESS || at.hi > 1.0 + MAX_EXCESS) {
            return None;
        }
        let (surface, parts) = face.regions[number].around(&local);
        let steps = self.steps(part);
        let lengths: [Interval; 2] = std::array::from_fn(|axis| {
            let [start, end] = patch.ranges[axis].map(Interval::point);
            Interval::point(parts[axis]) * (end - start)
        });
        Some(std::array::from_fn(|axis| {
            let [first, second] = &steps[axis];
            let slope: [Interval; 2] = std::array::from_fn(|k| Interval::point(first[k]) / lengths[k]);
            let bend: [Interval; 2] = std::array::from_fn(|k| Interval::point(second[k]) / lengths[k]);
            let pure = surface.pure.map(Interval::point);
            let sum = pure[0] * slope[0].square()
                + pure[1] * slope[1].square()
                + Interval::point(2.0 * surface.mixed) * slope[0] * slope[1]
                + Interval::point(surface.first[0]) * bend[0]
                + Interval::point(surface.first[1]) * bend[1];
            (sum * Interval::point(GROWTH)).hi
        }))
    }

    /// Bounds of the first and second derivatives of the face's u and v by the parameters of a part over
    /// [0, 1]², `[axis][order][u or v]`.
    fn steps(&self, part: [[f64; 2]; 2]) -> [[[f64; 2]; 2]; 2] {
        let Map::Ruled(ruled) = self.map else {
            let image = self.image(part);
            let [u, v] = image.map(|range| (Interval::point(range.hi) - Interval::point(range.lo)).hi);
            return [[[u, 0.0], [0.0; 2]], [[0.0, v], [0.0; 2]]];
        };
        let (sides, s) = ruled.over(part);
        let size = Interval::point(s[1]) - Interval::point(s[0]);
        let across = [0, 1].map(|k| (size * (sides[1].hull[k] - sides[0].hull[k])).magnitude());
        let (mut first, mut second) = ([0.0; 2], [0.0; 2]);
        for side in sides {
            for k in 0..2 {
                let bounds = SecondDerivatives::of(&side.coordinate(k));
                first[k] = f64::max(first[k], bounds.first[1]);
                second[k] = f64::max(second[k], bounds.pure[1]);
            }
        }
        let mut steps = [[across, [0.0; 2]]; 2];
        steps[ruled.along()] = [first, second];
        steps
    }
}

/// The number of the surface's patch over the knot rectangle that contains these parameters, or
/// of the nearest one.
pub(super) fn rectangle(face: &Face<'_>, parameters: [f64; 2]) -> Option<usize> {
    let outside = |&number: &usize| {
        let patch = &face.patches[number];
        (0..2)
            .map(|axis| {
                let [start, end] = patch.ranges[axis];
                f64::max(0.0, f64::max(start - parameters[axis], parameters[axis] - end)) / (end - start)
            })
            .fold(0.0, f64::max)
    };
    (0..face.patches.len()).min_by(|a, b| outside(a).total_cmp(&outside(b)))
}

/// The surface's point; parameters that leave the domain by rounding are moved onto it.
fn on_surface(face: &Face<'_>, parameters: &Box2) -> Option<Vector> {
    let patch = &face.patches[rectangle(face, parameters.map(Interval::mid))?];
    let local = std::array::from_fn(|axis| {
        let [start, end] = patch.ranges[axis].map(Interval::point);
        ((parameters[axis] - start) / (end - start)).in_unit()
    });
    Some(patch.net.evaluate(local))
}
