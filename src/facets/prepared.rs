//! Meshes and clouds with what is computed from them once.

use super::patches::patches;
use super::{Facet, FacetTarget, Facets};
use crate::area::Area;
use crate::bezier::{BezierModel, PatchGrid, PatchSet, PointError};
use crate::rounding::{VANISHING_LENGTH, gamma};
use std::sync::OnceLock;

/// The roundings of the area of a triangle, relative to the square of the largest length of a
/// corner: each coordinate of the two edges and of their product.
const AREA_ROUNDINGS: f64 = 32.0;

/// The largest number of triangles whose edges are joined: a million take gigabytes.
const MAX_JOINED_TRIANGLES: usize = 250_000;

/// The facets of a model.
#[derive(Debug)]
pub(crate) struct PreparedFacets {
    pub(crate) target: FacetTarget,
    /// The distance of the coordinates from the exact ones: 0 unless they were scaled.
    pub(crate) error: f64,
    /// The triangles as patches, made at their first use.
    bezier: OnceLock<BezierModel>,
}

impl PreparedFacets {
    pub(crate) fn new(facets: &Facets) -> Self {
        let target = match facets {
            Facets::Mesh(mesh) => FacetTarget::of_mesh(mesh),
            Facets::Cloud(cloud) => FacetTarget::of_cloud(cloud),
        };
        Self { target, error: 0.0, bezier: OnceLock::new() }
    }

    /// Returns the facets in coordinates that are `factor` times as large, with their rounding.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let target = self.target.scaled(factor);
        let error = factor * self.error + gamma(2.0) * target.bounding_box().farthest_from_origin();
        Self { target, error: error + VANISHING_LENGTH, bezier: OnceLock::new() }
    }

    pub(crate) fn bezier(&self) -> &BezierModel {
        self.bezier.get_or_init(|| {
            let mut bezier = patches(&self.target);
            bezier.point_error.include_deviation(self.error);
            bezier
        })
    }

    /// Returns whether these are triangles, not too many to be joined.
    pub(crate) fn may_close(&self) -> bool {
        !self.target.is_cloud() && self.target.len() <= MAX_JOINED_TRIANGLES
    }

    /// Returns the triangles as faces of their own; none if they are too many to be joined.
    pub(crate) fn faces(&self) -> BezierModel {
        if !self.may_close() {
            let point_error = PointError::default();
            return BezierModel { patches: PatchSet::default(), grids: Vec::new(), point_error };
        }
        let triangles = self.bezier();
        let grids = (0..triangles.patches.len()).map(PatchGrid::of_bilinear).collect();
        BezierModel { patches: triangles.patches.clone(), grids, point_error: triangles.point_error }
    }

    /// Returns the area of all triangles; a triangle that lies on others counts as often.
    pub(crate) fn area(&self) -> Area {
        let length = self.target.bounding_box().farthest_from_origin();
        let rounding = gamma(AREA_ROUNDINGS) * length * length;
        (0..self.target.len() as u32).fold(Area::default(), |sum, place| match self.target.facet(place) {
            Facet::Point(_) => sum,
            Facet::Triangle([a, b, c]) => {
                let area = 0.5 * (b - a).cross(c - a).length();
                let lower = area - rounding;
                sum + Area { lower: if lower > 0.0 { lower } else { 0.0 }, upper: area + rounding }
            }
        })
    }
}
