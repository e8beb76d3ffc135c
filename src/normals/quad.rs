//! A convex quadrilateral that a part of a patch covers, up to a distance (docs/score.md, lemma N5).

use crate::facets::Facet;
use crate::rounding::{unit, upper_max};
use glam::DVec3;

/// Corners that are nearer to each other than this part of the longer diagonal count as one: a patch may end in a point.
const ONE_CORNER: f64 = 1e-9;

/// The least sine of the angles at the corners, far above the rounding of a cross product.
const LEAST_SINE: f64 = 1e-9;

/// A convex quadrilateral in two triangles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Quad {
    triangles: [Facet; 2],
    /// Distances from the part exceed those from the triangles by at most this.
    off: f64,
}

impl Quad {
    /// Returns the quadrilateral between the corners of a part of a patch with these control points, of which each row has
    /// one more than the second degree; `None` where the corners make no convex one. O(p q).
    pub(super) fn of(points: &[DVec3], [rows, columns]: [usize; 2]) -> Option<Self> {
        let at = |i: usize, j: usize| points.get(i * (columns + 1) + j).copied();
        let [a, mut b, mut c, mut d] = [at(0, 0)?, at(rows, 0)?, at(0, columns)?, at(rows, columns)?];
        let length = upper_max(a.distance(d), b.distance(c));
        let is_one = |one: DVec3, other: DVec3| one.distance(other) <= ONE_CORNER * length;
        if is_one(a, b) {
            b = a;
        } else if is_one(c, d) {
            c = d;
        }
        if is_one(a, c) {
            c = a;
        } else if is_one(b, d) {
            d = b;
        }
        let normal = unit((d - a).cross(c - b));
        if normal == DVec3::ZERO || !is_convex([a, b, d, c], normal) {
            return None;
        }
        let height = [b, c, d].iter().map(|corner| normal.dot(*corner - a).abs()).fold(0.0, upper_max);
        let [p, q] = [rows, columns].map(|degree| degree as f64);
        let mut bend = 0.0;
        for i in 0..=rows {
            for j in 0..=columns {
                let (s, t) = (i as f64 / p, j as f64 / q);
                let low = a + (b - a) * s;
                let high = c + (d - c) * s;
                bend = upper_max(bend, at(i, j)?.distance(low + (high - low) * t));
            }
        }
        let off = bend + 2.0 * height;
        off.is_finite().then_some(Self { triangles: [[a, b, d], [a, d, c]].map(Facet::Triangle), off })
    }

    /// The excess of distances from the part over those from the quadrilateral.
    pub(super) fn off(&self) -> f64 {
        self.off
    }

    /// Returns the squared distance of a point from the quadrilateral.
    pub(super) fn distance_squared(&self, point: DVec3) -> f64 {
        let [one, other] = self.triangles.map(|triangle| triangle.nearest(point).distance_squared);
        if one <= other { one } else { other }
    }
}

/// Returns whether the corners turn to one side about a normal, at every corner where both edges have a length.
fn is_convex(corners: [DVec3; 4], normal: DVec3) -> bool {
    let edges: Vec<DVec3> = (0..corners.len())
        .map(|index| corners[(index + 1) % corners.len()] - corners[index])
        .filter(|edge| *edge != DVec3::ZERO)
        .collect();
    edges.len() > 2
        && (0..edges.len()).all(|index| {
            let (one, next) = (edges[index], edges[(index + 1) % edges.len()]);
            one.cross(next).dot(normal) >= LEAST_SINE * one.length() * next.length()
        })
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    fn square(far: DVec3) -> Vec<DVec3> {
        vec![DVec3::ZERO, DVec3::Y, DVec3::X, far]
    }

    /// Of a plane square nothing is off: a point above it has its height, one beside it the distance of the edge.
    #[test]
    fn a_plane_square_is_its_quadrilateral() {
        let quad = Quad::of(&square(DVec3::new(1.0, 1.0, 0.0)), [1, 1]).unwrap();
        assert_eq!(quad.off(), 0.0);
        assert_eq!(quad.distance_squared(DVec3::new(0.25, 0.5, 2.0)), 4.0);
        assert_eq!(quad.distance_squared(DVec3::new(0.75, 0.25, 0.0)), 0.0);
        assert_eq!(quad.distance_squared(DVec3::new(0.5, 3.0, 0.0)), 4.0);
    }

    /// A patch with a middle row above the plane is off by its height, and corners that are in no plane by twice theirs.
    #[test]
    fn the_excess_is_that_of_the_lemma() {
        let row = |x: f64, z: f64| [DVec3::new(x, 0.0, z), DVec3::new(x, 1.0, z)];
        let arch: Vec<DVec3> = [row(0.0, 0.0), row(1.0, 0.5), row(2.0, 0.0)].concat();
        assert_eq!(Quad::of(&arch, [2, 1]).unwrap().off(), 0.5);
        let skew = Quad::of(&square(DVec3::new(1.0, 1.0, 0.25)), [1, 1]).unwrap();
        let normal = DVec3::new(1.0, 1.0, 0.25).cross(DVec3::new(-1.0, 1.0, 0.0)).normalize();
        let heights = [DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.25)].map(|corner| normal.dot(corner).abs());
        let expected = 2.0 * heights.into_iter().fold(0.0, f64::max);
        assert!((skew.off() - expected).abs() < 1e-15 && expected > 0.1, "{} {expected}", skew.off());
    }

    /// A patch that ends in a point is a triangle; arrows, butterflies and lines are none.
    #[test]
    fn corners_make_a_convex_quadrilateral_or_none() {
        let triangle = Quad::of(&square(DVec3::X), [1, 1]).unwrap();
        assert_eq!(triangle.off(), 0.0);
        assert_eq!(triangle.distance_squared(DVec3::new(1.0, 1.0, 0.0)), 0.5);
        let nearly = Quad::of(&square(DVec3::new(1.0, 1e-12, 0.0)), [1, 1]).unwrap();
        assert!(nearly.off() > 0.0 && nearly.off() < 1e-11);
        for far in [DVec3::new(0.25, 0.25, 0.0), DVec3::new(-1.0, 0.5, 0.0), DVec3::new(f64::NAN, 0.0, 0.0)] {
            assert_eq!(Quad::of(&square(far), [1, 1]), None, "{far}");
        }
        let line = [0.0, 1.0, 2.0, 3.0].map(|x| DVec3::new(x, 0.0, 0.0));
        assert_eq!(Quad::of(&line, [1, 1]), None);
    }
}
