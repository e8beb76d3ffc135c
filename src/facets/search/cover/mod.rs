//! Covers of a triangle by facets of B that are joined along their edges (lemma F11 of docs/meshes.md).
//!
//! Seen along a direction, facets that are joined all around a triangle have it below an odd number of
//! them everywhere, or nowhere. So one point tells for all, and each facet bounds the part of the
//! triangle that it is above: parts that no search has to find, at one facet each.

mod polygon;
#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;

use super::super::{Facet, FacetTarget, NONE};
use crate::rounding::{gamma, unit, upper_max, upper_min};
use glam::{DVec2, DVec3};
pub(super) use polygon::MAX_CLIPS;
use polygon::{Corner, HalfPlane, MAX_CORNERS, Polygon};

/// The largest number of facets of a cover: a triangle above more of them is halved.
const MAX_FACETS: usize = 256;

/// The height of a triangle over its longest edge, relative to that, below which its normal is not the
/// direction that it is seen along if the facet has a better one.
const MIN_HEIGHT: f64 = 1e-2;

/// The weights of the corners at the point that tells for all: a point in general position, as middles
/// and centres are corners of subdivided meshes.
const INNER_WEIGHTS: [f64; 3] = [0.37, 0.34, 0.29];

/// The roundings of the area of a triangle between corners of clipped polygons, relative to the square of the
/// largest length (lemma F12 of docs/meshes.md).
const AREA_ROUNDINGS: f64 = 256.0;

/// The roundings of a sum over the triangles of all fans, relative to it: four polygons for each of the facets, six
/// triangles for each polygon, and two for each term.
const SUM_ROUNDINGS: f64 = (MAX_FACETS * 4 * 6 * 2) as f64;

/// Returns the point of a triangle that tells for all: a cover begins well with the facet nearest to it.
pub(super) fn inner_point(corners: &[DVec3; 3]) -> DVec3 {
    (0..3).map(|corner| corners[corner] * INNER_WEIGHTS[corner]).sum()
}

/// A bound on the distance of a triangle to B.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cover {
    /// The distance that no point of the triangle exceeds.
    pub(super) upper: f64,
    /// The point of the triangle that is as far from the facet that bounds it.
    pub(super) farthest: DVec3,
    /// That facet.
    pub(super) facet: u32,
}

/// Bounds on the mean of the distances of a triangle's points to B, and on the mean of their squares.
#[derive(Debug, Clone, Copy)]
pub(super) struct Means {
    pub(super) mean: f64,
    pub(super) square: f64,
}

/// Returns the bound on the distance of a triangle by facets around the first one, as long as these
/// cover it. Beyond an edge a facet goes on without the next one where it is within `threshold`.
pub(super) fn cover(b: &FacetTarget, corners: &[DVec3; 3], first: u32, threshold: f64) -> Option<Cover> {
    let mut search = CoverSearch::new(b, corners, first, threshold)?;
    search.run()
}

/// Returns the same bound with those on the means, which rounding of distances has not been added to
/// (lemma F12 of docs/meshes.md).
pub(super) fn cover_with_means(
    b: &FacetTarget,
    corners: &[DVec3; 3],
    first: u32,
    threshold: f64,
) -> Option<(Cover, Means)> {
    let mut search = CoverSearch::new(b, corners, first, threshold)?;
    search.integrals = Some([0.0; 2]);
    let found = search.run()?;
    let upper = found.upper;
    let whole = Means { mean: upper, square: upper * upper };
    let area = search.area(corners, -1.0) * (1.0 - gamma(SUM_ROUNDINGS));
    let means = match search.integrals {
        Some([mean, square]) if area > 0.0 => {
            Means { mean: upper_min(whole.mean, mean / area), square: upper_min(whole.square, square / area) }
        }
        _ => whole,
    };
    Some((found, means))
}
/// The linear map to a plane that images are in.
struct View {
    origin: DVec3,
    axes: [DVec3; 2],
}

impl View {
    /// Sees along the normal of the triangle or, if that is a sliver, of the facet if that is none.
    fn new(corners: &[DVec3; 3], facet: &Facet) -> Option<Self> {
        let of_triangle = Frame::of(corners);
        let of_facet = match facet {
            Facet::Triangle(corners) => Frame::of(corners),
            Facet::Point(_) => return None,
        };
        let is_better = of_triangle.height < MIN_HEIGHT && of_facet.height > of_triangle.height;
        let Frame { along, normal, .. } = if is_better { of_facet } else { of_triangle };
        (normal != DVec3::ZERO).then(|| Self { origin: corners[0], axes: [along, normal.cross(along)] })
    }

    fn image(&self, point: DVec3) -> DVec2 {
        let from = point - self.origin;
        DVec2::from_array(self.axes.map(|axis| axis.dot(from)))
    }
}

/// The longest edge and the normal of a triangle, of length 1 or 0.
struct Frame {
    along: DVec3,
    normal: DVec3,
    /// The height over the longest edge, relative to that.
    height: f64,
}

impl Frame {
    fn of(corners: &[DVec3; 3]) -> Self {
        let [a, b, c] = *corners;
        let edges = [b - a, c - b, a - c];
        let longer = |one: DVec3, other: DVec3| {
            if other.length_squared() > one.length_squared() { other } else { one }
        };
        let longest = longer(longer(edges[0], edges[1]), edges[2]);
        let across = edges[0].cross(edges[1]);
        let height = across.length() / longest.length_squared();
        Self { along: unit(longest), normal: unit(across), height }
    }
}

/// The largest squared distance of a point of the triangle from the facet that bounds it.
#[derive(Clone, Copy)]
struct Bound {
    squared: f64,
    at: DVec3,
    facet: u32,
}

struct CoverSearch<'a> {
    b: &'a FacetTarget,
    neighbours: &'a [[u32; 3]],
    view: View,
    /// The largest length of any point.
    length: f64,
    triangle: [DVec2; 3],
    part: Polygon,
    /// The image of the point that tells for all.
    inner: DVec2,
    threshold_squared: f64,
    facets: Vec<u32>,
    bound: Bound,
    /// Bounds on the integrals of the distance and of its square over the parts so far, if they are wanted.
    integrals: Option<[f64; 2]>,
}

/// A bound on the distances of a polygon by a facet, with those on their integrals.
struct PolygonBound {
    bound: Bound,
    integrals: [f64; 2],
}

impl<'a> CoverSearch<'a> {
    fn new(b: &'a FacetTarget, corners: &[DVec3; 3], first: u32, threshold: f64) -> Option<Self> {
        if b.is_cloud() {
            return None;
        }
        let view = View::new(corners, &b.facet(first))?;
        let part = corners.map(|point| Corner { image: view.image(point), point });
        let inner = view.image(inner_point(corners));
        let of_corners = corners.iter().fold(0.0, |length, corner| upper_max(length, corner.length()));
        let length = upper_max(b.bounding_box().farthest_from_origin(), of_corners);
        Some(Self {
            b,
            neighbours: b.neighbours(),
            view,
            length,
            triangle: part.map(|corner| corner.image),
            part: Polygon::of_triangle(part),
            inner,
            threshold_squared: threshold * threshold,
            facets: vec![first],
            bound: Bound { squared: 0.0, at: corners[0], facet: first },
            integrals: None,
        })
    }

    fn run(&mut self) -> Option<Cover> {
        let (mut is_odd, mut next) = (false, 0);
        while let Some(&facet) = self.facets.get(next) {
            let Facet::Triangle(corners) = self.b.facet(facet) else { return None };
            let image = corners.map(|corner| self.view.image(corner));
            is_odd ^= self.is_above_inner(&image)?;
            let above = self.bound_within(&self.around(&image), facet)?;
            self.include(above);
            for edge in 0..3 {
                self.pass(facet, edge, &image)?;
            }
            next += 1;
        }
        let Bound { squared, at, facet } = self.bound;
        is_odd.then(|| Cover { upper: squared.sqrt(), farthest: at, facet })
    }

    fn include(&mut self, PolygonBound { bound, integrals: [mean, square] }: PolygonBound) {
        if !(bound.squared <= self.bound.squared) {
            self.bound = bound;
        }
        if let Some(sums) = &mut self.integrals {
            *sums = [sums[0] + mean, sums[1] + square];
        }
    }

    /// Returns a bound on the area of a triangle between corners, from above or, with the sign −1, from below.
    fn area(&self, &[a, b, c]: &[DVec3; 3], sign: f64) -> f64 {
        0.5 * (b - a).cross(c - a).length() + sign * gamma(AREA_ROUNDINGS) * self.length * self.length
    }

    /// Returns bounds on the integrals over a polygon of a convex function with these squares at its corners, and
    /// of its square: over each triangle of a fan the mean is at most that of the corners.
    fn integrals_of(&self, corners: &[Corner], squares: &[f64]) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for last in 2..corners.len() {
            let triangle = [0, last - 1, last];
            let area = self.area(&triangle.map(|index| corners[index].point), 1.0) / 3.0;
            let of_corners = triangle.map(|index| squares[index]);
            sums[0] += area * of_corners.into_iter().map(f64::sqrt).sum::<f64>();
            sums[1] += area * of_corners.into_iter().sum::<f64>();
        }
        sums
    }

    /// Returns half-planes with a facet's image in all of them: those of its edges, or of a box along
    /// its longest edge where rounding hides the side of its third corner.
    fn around(&self, image: &[DVec2; 3]) -> [HalfPlane; 4] {
        let [a, b, c] = *image;
        let edges = [[a, b], [b, c], [c, a]].map(|[from, to]| HalfPlane::left_of(from, to));
        if let Some(is_left) = edges[0].is_inside(c, self.length) {
            let [one, other, last] = if is_left { edges } else { edges.map(HalfPlane::opposite) };
            return [one, other, last, last];
        }
        let squared = |start: usize| image[start].distance_squared(image[(start + 1) % 3]);
        let longest = (1..3).fold(0, |long, start| if squared(start) > squared(long) { start } else { long });
        let [from, to, apex] = [0, 1, 2].map(|turn| image[(longest + turn) % 3]);
        let edge = HalfPlane::left_of(from, to);
        let through_apex = HalfPlane::left_of(apex, apex + (to - from));
        let is_left = edge.side(apex) >= 0.0;
        let [below, above] =
            if is_left { [edge, through_apex.opposite()] } else { [edge.opposite(), through_apex] };
        [below, above, HalfPlane::before(from, to), HalfPlane::before(to, from)]
    }

    /// Returns whether the facet is above the point that tells for all; `None` if that is too near its
    /// border.
    fn is_above_inner(&self, image: &[DVec2; 3]) -> Option<bool> {
        let mut is_above = Some(true);
        for side in self.around(image) {
            match side.is_inside(self.inner, self.length) {
                Some(false) => return Some(false),
                Some(true) => {}
                None => is_above = None,
            }
        }
        let [a, b, c] = *image;
        // A box is larger than the facet.
        HalfPlane::left_of(a, b).is_inside(c, self.length).and(is_above)
    }

    /// Returns the bound of the part of the triangle in all half-planes by a facet (lemma F5).
    fn bound_within(&self, sides: &[HalfPlane], facet: u32) -> Option<PolygonBound> {
        let mut part = self.part;
        for side in sides {
            part = part.clipped(side, self.length)?;
        }
        let mut bound = Bound { squared: 0.0, at: DVec3::ZERO, facet };
        let mut squares = [0.0; MAX_CORNERS];
        for (&Corner { point, .. }, squared) in part.corners().iter().zip(&mut squares) {
            *squared = self.b.distance_squared(facet, point);
            if !(*squared <= bound.squared) {
                bound = Bound { squared: *squared, at: point, facet };
            }
        }
        let are_wanted = self.integrals.is_some();
        let integrals = if are_wanted { self.integrals_of(part.corners(), &squares) } else { [0.0; 2] };
        Some(PolygonBound { bound, integrals })
    }

    /// Goes on beyond an edge of a facet that may be at the triangle: with the facet itself where it is
    /// near enough or has no neighbour, else with the neighbour. Towards the point that tells for all it
    /// is the neighbour, as the facet has to be above that point.
    fn pass(&mut self, facet: u32, edge: usize, image: &[DVec2; 3]) -> Option<()> {
        let neighbour = self.neighbours[facet as usize][edge];
        let ends = [image[edge], image[(edge + 1) % 3]];
        // With both in the set their edges cancel.
        if (neighbour != NONE && self.facets.contains(&neighbour)) || self.is_apart(ends) {
            return Some(());
        }
        let line = HalfPlane::left_of(ends[0], ends[1]);
        let is_towards = (line.side(self.inner) > 0.0) != (line.side(image[(edge + 2) % 3]) > 0.0);
        let is_passed = |of: &PolygonBound| {
            neighbour == NONE || (!is_towards && of.bound.squared <= self.threshold_squared)
        };
        match self.beyond(ends).and_then(|sides| self.bound_within(&sides, facet)) {
            Some(bound) if is_passed(&bound) => self.include(bound),
            _ if neighbour != NONE && self.facets.len() < MAX_FACETS => self.facets.push(neighbour),
            _ => return None,
        }
        Some(())
    }

    /// Returns whether a line certainly separates an edge from the triangle.
    fn is_apart(&self, [from, to]: [DVec2; 2]) -> bool {
        let all = |line: HalfPlane, points: &[DVec2], is_inside: bool| {
            points.iter().all(|&point| line.is_inside(point, self.length) == Some(is_inside))
        };
        let line = HalfPlane::left_of(from, to);
        if all(line, &self.triangle, true) || all(line, &self.triangle, false) {
            return true;
        }
        let [a, b, c] = self.triangle;
        [[a, b, c], [b, c, a], [c, a, b]].into_iter().any(|[start, end, apex]| {
            let line = HalfPlane::left_of(start, end);
            line.is_inside(apex, self.length).is_some_and(|is_left| all(line, &[from, to], !is_left))
        })
    }

    /// Returns the half-planes of the points behind an edge, seen from the point that tells for all.
    fn beyond(&self, [from, to]: [DVec2; 2]) -> Option<[HalfPlane; 3]> {
        let line = HalfPlane::left_of(from, to);
        let rays = [from, to].map(|end| HalfPlane::left_of(self.inner, end));
        let is_left = line.is_inside(self.inner, self.length)?;
        // Both say which way round the edge goes.
        if rays[0].is_inside(to, self.length)? != is_left || rays[1].is_inside(from, self.length)? == is_left
        {
            return None;
        }
        let [first, second] = rays;
        Some(if is_left {
            [line.opposite(), first, second.opposite()]
        } else {
            [line, first.opposite(), second]
        })
    }
}
