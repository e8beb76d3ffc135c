//! The points of the pieces are those of the surface at the maps' parameters, to the limit.
//!
//! On a part of size h × k, f = piece - surface∘map differs from the bilinear function of its
//! corners' values by at most (h² |f_ss| + k² |f_tt|) / 8, and that function is at most as large as
//! the largest value. The second derivatives are bounded by the control nets.

use super::map::{Map, Ruled};
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

/// Upper bound on (1 + 2 MAX_EXCESS)^60, by which the bounds of a patch of degrees up to 15, of its
/// quotients and of their derivatives grow where it is continued.
const GROWTH: f64 = 1.001;

/// The piece's patch in its parameters over [0, 1]², with the map from there.
struct Place<'a> {
    net: &'a Net,
    map: &'a Map,
    /// The box of the piece's parameters that the patch is over.
    ranges: [[f64; 2]; 2],
}

/// Proves the statement for all pieces.
pub(super) fn check(face: &Face, pieces: &Model, maps: &[&Map]) -> Finding {
    let mut found = Finding::PROVED;
    for Patch { net, surface, ranges } in &patches(pieces, &face.frame, &Motion::IDENTITY) {
        let map = maps[*surface];
        let place = Place { net, map, ranges: *ranges };
        found = found.and(|| patch(face, &place, *surface));
    }
    found
}

fn patch(face: &Face, place: &Place<'_>, index: usize) -> Finding {
    let mut found = Finding::PROVED;
    let mut open: Vec<([[f64; 2]; 2], u32)> = vec![([[0.0, 1.0]; 2], 0)];
    while let Some((part, halvings)) = open.pop() {
        let corners = place.corners(face, part);
        if corners.lo > face.limit {
            let at = place.parameters(part.map(|range| Interval::point(range[0]))).map(Interval::mid);
            return Finding::refuted(format!("piece {index} is off the surface near ({}, {})", at[0], at[1]));
        }
        let bends = place.bends(face, part);
        if corners.hi + bends[0] + bends[1] <= face.limit {
            continue;
        }
        if halvings == MAX_HALVINGS || face.is_late() {
            found = Finding::OPEN;
            continue;
        }
        let axis = usize::from(bends[1] > bends[0] || (bends[1] == bends[0] && halvings % 2 == 1));
        let [low, high] = part[axis];
        let middle = 0.5 * (low + high);
        for range in [[low, middle], [middle, high]] {
            let mut half = part;
            half[axis] = range;
            open.push((half, halvings + 1));
        }
    }
    found
}

impl Place<'_> {
    /// The face's parameters over a part of the patch.
    fn parameters(&self, part: Box2) -> Box2 {
        self.map.image(std::array::from_fn(|axis| {
            let [start, end] = self.ranges[axis].map(Interval::point);
            start + part[axis] * (end - start)
        }))
    }

    /// The largest distance at the corners: the lower end holds for one of them.
    fn corners(&self, face: &Face, part: [[f64; 2]; 2]) -> Interval {
        let mut largest = Interval::ZERO;
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let at = [part[0][i], part[1][j]].map(Interval::point);
            let (own, image) = (self.net.evaluate(at), self.parameters(at));
            let Some(other) = on_surface(face, &image) else {
                return Interval { lo: 0.0, hi: f64::INFINITY };
            };
            let distance = norm(&difference(&own, &other));
            largest = Interval { lo: largest.lo.max(distance.lo), hi: largest.hi.max(distance.hi) };
        }
        largest
    }

    /// Bounds of `h² |f_ss| / 8` and `k² |f_tt| / 8`, infinite where the part's image leaves the
    /// knot rectangle of its middle.
    fn bends(&self, face: &Face, part: [[f64; 2]; 2]) -> [f64; 2] {
        let sizes = part.map(|[low, high]| high - low);
        let own = SecondDerivatives::of(&self.net.restrict(0, part[0]).restrict(1, part[1]));
        let Some(image) = self.image_bends(face, part) else { return [f64::INFINITY; 2] };
        // The net over the part has the part's size for its unit.
        std::array::from_fn(|axis| {
            let curve = Interval::point(own.pure[axis])
                + Interval::point(sizes[axis]).square() * Interval::point(image[axis]);
            (curve * Interval::point(0.125)).hi
        })
    }

    /// Bounds of the second derivatives of surface∘map by the patch's parameters.
    fn image_bends(&self, face: &Face, part: [[f64; 2]; 2]) -> Option<[f64; 2]> {
        let image = self.parameters(part.map(|[low, high]| Interval { lo: low, hi: high }));
        let number = rectangle(face, image.map(Interval::mid))?;
        let patch = &face.patches[number];
        let local: Vec<Interval> = (0..2)
            .map(|axis| {
                let [start, end] = patch.ranges[axis].map(Interval::point);
                (image[axis] - start) / (end - start)
            })
            .collect();
        if local.iter().any(|at| at.lo < -MAX_EXCESS || at.hi > 1.0 + MAX_EXCESS) {
            return None;
        }
        let surface = &face.bends[number];
        let steps = self.steps(part);
        let lengths: [Interval; 2] = std::array::from_fn(|axis| {
            Interval::point(patch.ranges[axis][1]) - Interval::point(patch.ranges[axis][0])
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

    /// Bounds of the first and second derivatives of the face's u and v by the patch's parameters,
    /// `[axis][order][u or v]`.
    fn steps(&self, part: [[f64; 2]; 2]) -> [[[f64; 2]; 2]; 2] {
        let scale: [f64; 2] = std::array::from_fn(|axis| {
            let [start, end] = self.ranges[axis].map(Interval::point);
            (end - start).hi
        });
        let Map::Ruled(Ruled { sides, domain, transposed, .. }) = self.map else {
            return [[[scale[0], 0.0], [0.0; 2]], [[0.0, scale[1]], [0.0; 2]]];
        };
        let lengths = domain.map(|[start, end]| (Interval::point(end) - Interval::point(start)).hi);
        let along = usize::from(!*transposed);
        let nets = sides.each_ref().map(|side| side.restrict(1, part[along]));
        let boxes = nets.each_ref().map(Net::bounding_box);
        let size = part[along][1] - part[along][0];
        let mut across_first = [0.0; 2];
        let (mut along_first, mut along_second) = ([0.0; 2], [0.0; 2]);
        for k in 0..2 {
            let unit = if *transposed { 1 - k } else { k };
            across_first[k] = (boxes[1][unit] - boxes[0][unit]).magnitude() * lengths[k];
            for net in &nets {
                let bounds = SecondDerivatives::of(net);
                along_first[k] = f64::max(along_first[k], bounds.first[1] / size * lengths[k] * GROWTH);
                along_second[k] =
                    f64::max(along_second[k], bounds.pure[1] / (size * size) * lengths[k] * GROWTH);
            }
        }
        let (across, along_both) = ([across_first, [0.0; 2]], [along_first, along_second]);
        if *transposed { [along_both, across] } else { [across, along_both] }
    }
}

/// The number of the surface's patch over the knot rectangle that contains these parameters, or
/// of the nearest one.
fn rectangle(face: &Face, parameters: [f64; 2]) -> Option<usize> {
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
fn on_surface(face: &Face, parameters: &Box2) -> Option<Vector> {
    let patch = &face.patches[rectangle(face, parameters.map(Interval::mid))?];
    let local = std::array::from_fn(|axis| {
        let [start, end] = patch.ranges[axis].map(Interval::point);
        ((parameters[axis] - start) / (end - start)).in_unit()
    });
    Some(patch.net.evaluate(local))
}
