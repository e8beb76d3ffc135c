//! The triangles of a model that its map begins with.

use super::PreparedModel;
use crate::deviation::{Map, Surface};
use crate::error::Result;
use crate::facets::{FacetSamples, PreparedFacets};
use crate::tessellate::{TessellationOptions, tessellate_patches};
use crate::threads::locked;
use glam::DVec3;
use std::sync::Arc;

/// The distance of triangles from their model, in its diagonals: half a pixel where it fills a screen. It is more only
/// where it would take a million triangles, whose edges are not split.
const FLATNESS: f64 = 5e-4;

impl PreparedModel {
    /// Returns the triangles of the map, made at first use.
    ///
    /// # Errors
    /// Those of [`tessellate_patches`].
    pub(crate) fn map_base(&self) -> Result<Arc<Map>> {
        if let Some(base) = &*locked(&self.kept.map_base) {
            return Ok(Arc::clone(base));
        }
        let base = Arc::new(match self.facets() {
            Some(facets) => base_of_facets(facets, self.bounding_box().diagonal()),
            None => self.base_of_patches()?,
        });
        *locked(&self.kept.map_base) = Some(Arc::clone(&base));
        Ok(base)
    }

    fn base_of_patches(&self) -> Result<Map> {
        let options = TessellationOptions { tolerance: None, relative_tolerance: Some(FLATNESS) };
        let found = tessellate_patches(self.bezier(), self.pieces(), &options)?;
        let counts: Vec<u32> = found.faces.iter().map(|range| range.len() as u32).collect();
        let surface = Surface {
            positions: &found.positions,
            normals: &found.normals,
            indices: &found.indices,
            counts: &counts,
            origin: found.origin,
            flatness: FLATNESS * self.bezier().patches.bounding_box().diagonal(),
            is_mesh: false,
        };
        Ok(Map::base(&surface, self.bounding_box().diagonal()))
    }
}

/// Returns the triangles of a mesh as one face, or the points of a cloud.
fn base_of_facets(facets: &PreparedFacets, diagonal: f64) -> Map {
    let FacetSamples { points, triangles, .. } = FacetSamples::of(&facets.target, 1);
    let origin = facets.target.bounding_box().center();
    let single = |vector: &DVec3| vector.as_vec3().to_array();
    let positions: Vec<f32> = points.iter().flat_map(|&point| single(&(point - origin))).collect();
    let normals: Vec<f32> = normals(&points, &triangles).iter().flat_map(single).collect();
    let surface = Surface {
        positions: &positions,
        normals: &normals,
        indices: &triangles,
        counts: &[triangles.len() as u32],
        origin,
        flatness: 0.0,
        is_mesh: true,
    };
    Map::base(&surface, diagonal)
}

/// Returns the unit normals at the vertices of triangles: sums of the triangles' normals by their areas.
fn normals(points: &[DVec3], triangles: &[u32]) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; points.len()];
    for corners in triangles.as_chunks::<3>().0 {
        let corners = corners.map(|corner| corner as usize);
        let [a, b, c] = corners.map(|corner| points[corner]);
        for corner in corners {
            sums[corner] += (b - a).cross(c - a);
        }
    }
    sums.into_iter().map(DVec3::normalize_or_zero).collect()
}
