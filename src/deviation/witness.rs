//! The farthest point as a vertex of the map, which then holds the maximum.

use super::{Map, Vertex, with_sign};
use glam::DVec3;

/// The part of the distance by which a vertex may be off the farthest point, and stands for it.
const SAME: f64 = 1e-9;

/// A point of the map's model that is farthest from the other one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Farthest {
    pub(super) face: usize,
    /// In the coordinates of the map.
    pub(super) point: DVec3,
    /// The nearest point of the other model, in the coordinates of a result.
    pub(super) foot: DVec3,
    pub(super) distance: f64,
}

impl Map {
    /// Makes a point a vertex, within the nearest triangle of its face, and the worst one, unless another is
    /// farther by `slack`.
    pub(super) fn add_farthest(&mut self, farthest: Farthest, slack: f64) {
        let Farthest { face, point, foot, distance } = farthest;
        let Some((corners, nearest)) = self.nearest(face, point) else { return };
        let apart = |vertex: u32| self.vertices[vertex as usize].point.distance(point);
        let closest = corners.into_iter().min_by(|&one, &other| apart(one).total_cmp(&apart(other)));
        let Some(closest) = closest.map(|closest| closest as usize) else { return };
        let [signed, _] = self.values[closest];
        // A vertex without a sign has NaN.
        let value = [with_sign(distance, signed), distance];
        if self.vertices[closest].point.distance(point) <= SAME * distance {
            self.values[closest] = value;
            self.feet[closest] = foot;
            self.vertices[closest].slack = 0.0;
            self.farthest = Some((closest, slack));
            return;
        }
        let Some(triangle) = nearest else { return };
        let added = self.vertices.len() as u32;
        let Vertex { normal, .. } = self.vertices[closest];
        self.vertices.push(Vertex { position: point, point, normal, slack: 0.0 });
        self.values.push(value);
        self.feet.push(foot);
        self.farthest = Some((added as usize, slack));
        let [a, b, c] = corners;
        self.triangles.corners.splice(triangle..=triangle, [[a, b, added], [b, c, added], [c, a, added]]);
        self.triangles.faces.splice(triangle..=triangle, [face as u32; 3]);
    }

    /// Returns the corners of the nearest triangle of a face, and its index; of a cloud the nearest point.
    fn nearest(&self, face: usize, point: DVec3) -> Option<([u32; 3], Option<usize>)> {
        let triangles = self.triangles.corners.iter().zip(&self.triangles.faces).enumerate();
        let own = triangles.filter(|&(_, (_, &owner))| owner as usize == face);
        let farness =
            |corners: &[u32; 3]| farness(corners.map(|corner| self.vertices[corner as usize].point), point);
        let nearest = own
            .map(|(index, (&corners, _))| (farness(&corners), corners, index))
            .min_by(|one, other| one.0.total_cmp(&other.0));
        if let Some((_, corners, index)) = nearest {
            return Some((corners, Some(index)));
        }
        if !self.triangles.corners.is_empty() {
            return None;
        }
        let apart = |index: usize| self.vertices[index].point.distance(point);
        let vertex = (0..self.vertices.len()).min_by(|&one, &other| apart(one).total_cmp(&apart(other)))?;
        Some(([vertex as u32; 3], None))
    }
}

/// Returns how far a point is from a triangle: 0 within it, and never more than from its plane and edges.
fn farness([a, b, c]: [DVec3; 3], point: DVec3) -> f64 {
    let (ab, ac, ap) = (b - a, c - a, point - a);
    let normal = ab.cross(ac);
    let square = normal.length_squared();
    // The corners of a triangle without an area are taken to coincide.
    if square == 0.0 {
        return ap.length();
    }
    let second = ap.cross(ac).dot(normal) / square;
    let third = ab.cross(ap).dot(normal) / square;
    let outside = (-second).max(-third).max(second + third - 1.0).max(0.0);
    ap.dot(normal).abs() / square.sqrt() + outside * ab.length().max(ac.length())
}
