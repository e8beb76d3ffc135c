//! Convex polygons of a triangle, clipped along lines of a plane that it is mapped to.

use crate::rounding::gamma;
use glam::{DVec2, DVec3};

/// The roundings of a side of a line, relative to the largest length of all points and to that of the
/// line's normal (lemma F11 of docs/meshes.md).
const SIDE_ROUNDINGS: f64 = 128.0;

/// More than what underflow changes the side of a line by: a few times 2^-1074.
const VANISHING_SIDE: f64 = 1e-290;

/// The largest number of corners of a polygon: a triangle has three, and each of four clips adds one.
pub(super) const MAX_CORNERS: usize = 8;

/// The largest number of times that a polygon is clipped: lemma F4 counts each as a cut.
pub(in super::super) const MAX_CLIPS: u32 = 4;

/// A point of a triangle with its image.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Corner {
    pub(super) image: DVec2,
    pub(super) point: DVec3,
}

/// The convex hull of points of a triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Polygon {
    corners: [Corner; MAX_CORNERS],
    count: usize,
}

/// A half-plane: the points at which the side is not negative.
#[derive(Debug, Clone, Copy)]
pub(super) struct HalfPlane {
    through: DVec2,
    normal: DVec2,
}

impl HalfPlane {
    /// Returns the points to the left of the way from a point to another.
    pub(super) fn left_of(from: DVec2, to: DVec2) -> Self {
        Self { through: from, normal: (to - from).perp() }
    }

    /// Returns the points before a point on the way from another.
    pub(super) fn before(from: DVec2, to: DVec2) -> Self {
        Self { through: to, normal: from - to }
    }

    pub(super) fn opposite(self) -> Self {
        Self { normal: -self.normal, ..self }
    }

    /// Returns the side of a point: its distance from the line times the length of the normal.
    pub(super) fn side(&self, point: DVec2) -> f64 {
        self.normal.dot(point - self.through)
    }

    /// Returns a bound on the rounding of the sides of points at most `length` from the origin, and of
    /// corners of clipped polygons.
    pub(super) fn rounding(&self, length: f64) -> f64 {
        // The sum of the sizes is at least the length of the normal, and does not underflow.
        gamma(SIDE_ROUNDINGS) * length * (self.normal.x.abs() + self.normal.y.abs()) + VANISHING_SIDE
    }

    /// Returns whether the side of a point, or its opposite, is certainly positive; `None` for a point
    /// too near the line.
    pub(super) fn is_inside(&self, point: DVec2, length: f64) -> Option<bool> {
        let (side, rounding) = (self.side(point), self.rounding(length));
        // Twice, so that the points beside it have the same side.
        (side.abs() >= 2.0 * rounding).then_some(side > 0.0)
    }
}

impl Polygon {
    pub(super) fn of_triangle(corners: [Corner; 3]) -> Self {
        let [a, b, c] = corners;
        let mut all = [Corner::default(); MAX_CORNERS];
        [all[0], all[1], all[2]] = [a, b, c];
        Self { corners: all, count: 3 }
    }

    pub(super) fn corners(&self) -> &[Corner] {
        &self.corners[..self.count]
    }

    /// Returns a polygon that contains what is in a half-plane, up to rounding of its corners; `None`
    /// if it has too many corners, which only rounding gives.
    pub(super) fn clipped(&self, by: &HalfPlane, length: f64) -> Option<Self> {
        let outward = by.rounding(length);
        let side = |corner: &Corner| by.side(corner.image) + outward;
        let mut clipped = Self { corners: [Corner::default(); MAX_CORNERS], count: 0 };
        let Some(mut last) = self.corners().last() else { return Some(clipped) };
        let mut of_last = side(last);
        for corner in self.corners() {
            let of_corner = side(corner);
            if (of_last >= 0.0) != (of_corner >= 0.0) {
                // Between 0 and 1, as both sides have different signs.
                let fraction = of_last / (of_last - of_corner);
                let image = last.image + (corner.image - last.image) * fraction;
                let point = last.point + (corner.point - last.point) * fraction;
                clipped.push(Corner { image, point })?;
            }
            // A side that is no number keeps its corner.
            if !(of_corner < 0.0) {
                clipped.push(*corner)?;
            }
            (last, of_last) = (corner, of_corner);
        }
        Some(clipped)
    }

    fn push(&mut self, corner: Corner) -> Option<()> {
        *self.corners.get_mut(self.count)? = corner;
        self.count += 1;
        Some(())
    }
}
