//! Polygons as what they are: cut into triangles in their plane, whatever corner they begin with.

use earcut::Earcut;
use glam::{DVec2, DVec3};

/// The largest number of corners of a polygon without a corner that sees all others: the time to cut ears
/// off is up to quadratic.
pub(super) const MAX_CORNERS: usize = 1 << 14;

/// The rounding of corners in units of their largest coordinate: a polygon whose corners are as near to a
/// plane is flat. Reading a number takes one, the plane and the heights over it the others.
const CORNER_ROUNDING: f64 = 32.0 * f64::EPSILON;

/// The relative and the absolute difference of areas, in squares of the polygon's extent, up to which they
/// are equal: a hundred thousand sums of float64 have less.
const AREA_ROUNDING: f64 = 1e-9;

/// The findings about polygons that were cut.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Cuts {
    /// The largest distance of a polygon's corner from its plane.
    pub(super) deviation: f64,
    /// The number of polygons whose edges cross.
    pub(super) crossing: usize,
}

impl Cuts {
    /// Appends the triangles of a polygon of three corners or more, oriented as it is. Every corner is within
    /// [`Cuts::deviation`] of a plane, and the triangles cover the polygon in that plane; where its
    /// edges cross, they are those about its first corner. Returns whether the polygon can be cut.
    pub(super) fn cut(&mut self, corners: &[u32], vertices: &[DVec3], triangles: &mut Vec<[u32; 3]>) -> bool {
        let points: Option<Vec<DVec3>> =
            corners.iter().map(|&corner| vertices.get(corner as usize).copied()).collect();
        // Indices of no vertex and infinite coordinates are refused with the whole mesh.
        let Some(flat) = points.and_then(|points| Flat::new(&points)) else {
            triangles.extend(fan(corners));
            return true;
        };
        self.deviation = if flat.deviation > self.deviation { flat.deviation } else { self.deviation };
        if flat.is_seen_from_first() {
            triangles.extend(fan(corners));
            return true;
        }
        if corners.len() > MAX_CORNERS {
            return false;
        }
        match flat.ears() {
            Some(ears) => triangles.extend(ears.into_iter().map(|ear| ear.map(|at| corners[at]))),
            None => {
                self.crossing += 1;
                triangles.extend(fan(corners));
            }
        }
        true
    }
}

/// Returns the triangles about the first corner.
fn fan(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> + '_ {
    let (first, rest) = corners.split_first().unwrap_or((&0, &[]));
    rest.windows(2).map(|pair| [*first, pair[0], pair[1]])
}

/// A polygon in its plane, anticlockwise, with the first corner at the origin and an extent of 1; without
/// points if its lobes cancel, so that it has no plane.
struct Flat {
    points: Vec<DVec2>,
    area: f64,
    deviation: f64,
}

impl Flat {
    /// Projects corners along their vector of area (Newell); none of corners that are not finite or
    /// lie on a line.
    fn new(corners: &[DVec3]) -> Option<Self> {
        let [first, ..] = corners else { return None };
        let offsets: Vec<DVec3> = corners.iter().map(|corner| *corner - *first).collect();
        let size = |points: &[DVec3]| {
            points.iter().fold(0.0, |size: f64, point| size.max(point.abs().max_element()))
        };
        let extent = size(&offsets);
        if !(extent > 0.0 && extent.is_finite()) {
            return None;
        }
        let offsets: Vec<DVec3> = offsets.into_iter().map(|offset| offset / extent).collect();
        let normal: DVec3 = offsets.windows(2).map(|pair| pair[0].cross(pair[1])).sum();
        let length = normal.length();
        if !(length > CORNER_ROUNDING) {
            let is_line = offsets.windows(2).all(|pair| pair[0].cross(pair[1]).length() <= CORNER_ROUNDING);
            return (!is_line).then_some(Self { points: Vec::new(), area: 0.0, deviation: 0.0 });
        }
        let normal = normal / length;
        let (u, v) = normal.any_orthonormal_pair();
        let heights = offsets.iter().map(|offset| offset.dot(normal));
        let (low, high) =
            heights.fold((0.0_f64, 0.0_f64), |(low, high), height| (low.min(height), high.max(height)));
        let (deviation, rounding) = (extent * (high - low) / 2.0, CORNER_ROUNDING * size(corners));
        Some(Self {
            points: offsets.iter().map(|offset| DVec2::new(offset.dot(u), offset.dot(v))).collect(),
            area: length / 2.0,
            deviation: if deviation <= rounding { 0.0 } else { deviation + rounding },
        })
    }

    /// Whether the triangles about the first corner have their orientation and go around it less than once.
    fn is_seen_from_first(&self) -> bool {
        let Some(start) = self.points.get(1) else { return false };
        let turns_on = self.points[1..].windows(2).all(|pair| pair[0].perp_dot(pair[1]) > 0.0);
        let passes_start = |pair: &[DVec2]| start.perp_dot(pair[0]) < 0.0 && start.perp_dot(pair[1]) >= 0.0;
        turns_on && !self.points[1..].windows(2).any(passes_start)
    }

    /// Returns triangles that cover the polygon; none if their area is not the polygon's, as where edges
    /// cross.
    fn ears(&self) -> Option<Vec<[usize; 3]>> {
        let mut indices: Vec<u32> = Vec::new();
        Earcut::new().earcut(self.points.iter().map(|point| point.to_array()), &[], &mut indices);
        let mut area = 0.0;
        let ears = indices.as_chunks().0.iter().map(|ear: &[u32; 3]| {
            let [a, b, c] = ear.map(|at| at as usize);
            let [p, q, r] = [a, b, c].map(|at| self.points[at]);
            let twice = (q - p).perp_dot(r - p);
            area += twice.abs() / 2.0;
            if twice < 0.0 { [a, c, b] } else { [a, b, c] }
        });
        let ears: Vec<[usize; 3]> = ears.collect();
        let agrees = (area - self.area).abs() <= AREA_ROUNDING * (1.0 + self.area);
        (agrees && !ears.is_empty()).then_some(ears)
    }
}
