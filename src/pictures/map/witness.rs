//! The farthest point as a vertex of the map, which then holds the maximum.

use super::{Map, Vertex, with_sign};
use crate::pictures::Place;
use glam::DVec3;

/// The part of the distance by which a vertex may be off the farthest point, and stands for it.
const SAME: f64 = 1e-9;

impl Map {
    /// Makes a point a vertex, within the nearest triangle of its face, and the worst one, unless another is
    /// farther by `slack`.
    pub(super) fn add_farthest(&mut self, Place { face, point, foot }: Place, slack: f64) {
        let [point, foot] = [point, foot].map(DVec3::from_array);
        let distance = point.distance(foot);
        let Some((corners, nearest)) = self.nearest(face, point) else { return };
        let apart = |vertex: u32| self.vertices[vertex as usize].point.distance(point);
        let closest = corners.into_iter().min_by(|&one, &other| apart(one).total_cmp(&apart(other)));
        let Some(closest) = closest else { return };
        let [signed, _] = self.values[closest as usize];
        // A vertex without a sign has NaN.
        let value = [with_sign(distance, signed), distance];
        if apart(closest) <= SAME * distance {
            self.values[closest as usize] = value;
            self.farthest = Some((closest as usize, slack));
            return;
        }
        let Some(triangle) = nearest else { return };
        let added = self.vertices.len() as u32;
        let Vertex { normal, .. } = self.vertices[closest as usize];
        self.vertices.push(Vertex { position: point, point, normal });
        self.values.push(value);
        self.farthest = Some((added as usize, slack));
        let [a, b, c] = corners;
        self.triangles.corners[triangle] = [a, b, added];
        self.triangles.corners.extend([[b, c, added], [c, a, added]]);
        let face = self.triangles.faces[triangle];
        self.triangles.faces.extend([face; 2]);
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
