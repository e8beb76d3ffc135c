//! Maps of deviations: triangles of a model with the deviation at each vertex. Between the vertices it is
//! linear: an estimate.
//!
//! A [`Map`] begins as the triangles alone, whatever the model's position is. A [`MapBuilder`] says which points
//! it needs; who has the models measures them.

mod base;
mod builder;
#[cfg(not(target_arch = "wasm32"))]
mod drawn;
mod fineness;
mod known;
mod placing;
mod refine;
#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;
mod triangles;
mod witness;

use glam::DVec3;

pub(crate) use base::Surface;
pub(crate) use builder::MapBuilder;
pub(crate) use fineness::Fineness;
pub use known::{FarthestPoint, KnownDeviation};
pub(crate) use placing::Placing;

/// The deviation that the map resolves, in diagonals: its vertices are in float32.
pub const FLOOR: f64 = 5e-7;

/// A vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// Where it is drawn, on the triangles.
    pub position: DVec3,
    /// The point of the model that is measured for it.
    pub point: DVec3,
    /// The normal of the surface.
    pub normal: DVec3,
    /// The most that the model is from the point, but for the rounding of float32.
    pub slack: f64,
}

/// The triangles of a model.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Triangles {
    /// The vertices of each.
    pub corners: Vec<[u32; 3]>,
    /// The face of each; those of a face follow each other.
    pub faces: Vec<u32>,
}

/// A map; without triangles its vertices are the points of a cloud.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Map {
    /// The vertices, in the model's own coordinates unless the map was placed.
    pub vertices: Vec<Vertex>,
    /// The signed deviation, NaN without a sign, and the distance of each vertex, in the unit of a result.
    pub values: Vec<[f64; 2]>,
    /// The nearest point on the other model to each vertex, in the coordinates of a result.
    pub feet: Vec<DVec3>,
    /// The triangles between the vertices.
    pub triangles: Triangles,
    /// The point that float32 is relative to.
    pub origin: DVec3,
    /// Whether the triangles are the model, so that its edges are straight.
    pub is_mesh: bool,
    /// The most that a point of the triangles is from the model.
    pub(super) flatness: f64,
    /// The vertex of the farthest point that a search found, and how much farther another one must be to be
    /// the worst.
    pub(super) farthest: Option<(usize, f64)>,
}

impl Map {
    /// Limits the distances to bounds of the whole model or of each face, which they may exceed by the
    /// errors of vertices that are not on the model and of searches.
    pub(super) fn limit(&mut self, uppers: &[f64]) {
        let mut own = vec![f64::INFINITY; self.vertices.len()];
        match uppers {
            [] => return,
            [upper] => own.fill(*upper),
            _ => {
                own.fill(f64::NEG_INFINITY);
                for (corners, &face) in self.triangles.corners.iter().zip(&self.triangles.faces) {
                    let upper = uppers.get(face as usize).copied().unwrap_or(f64::INFINITY);
                    for &corner in corners {
                        own[corner as usize] = own[corner as usize].max(upper);
                    }
                }
            }
        }
        for (value, upper) in self.values.iter_mut().zip(own) {
            *value = limited(*value, upper);
        }
    }

    /// Returns the vertex of the largest distance: that of the search, unless another one is certainly
    /// farther, as where a limit ended the search; else the first of equal ones.
    #[must_use]
    pub fn worst(&self) -> Option<usize> {
        let mut worst: Option<usize> = None;
        for (index, [_, distance]) in self.values.iter().enumerate() {
            if worst.is_none_or(|worst| *distance > self.values[worst][1]) {
                worst = Some(index);
            }
        }
        let of_search = self.farthest.filter(|&(farthest, slack)| {
            worst.is_some_and(|worst| self.values[farthest][1] + slack >= self.values[worst][1])
        });
        of_search.map(|(farthest, _)| farthest).or(worst)
    }
}

/// Returns a signed deviation and its distance, which is at most `upper` unless that is negative.
fn limited([signed, distance]: [f64; 2], upper: f64) -> [f64; 2] {
    if distance > upper && upper >= 0.0 { [with_sign(upper, signed), upper] } else { [signed, distance] }
}

/// Returns a distance with the sign of a deviation; NaN if that has none.
fn with_sign(distance: f64, signed: f64) -> f64 {
    if signed.is_nan() { f64::NAN } else { distance.copysign(signed) }
}
