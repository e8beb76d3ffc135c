//! A model: one or more surfaces measured as one set of points.

use super::{NurbsSurface, SurfaceArrays};
use crate::bvh::Aabb;
use crate::error::{Error, Result};
use glam::DVec3;

/// A set of NURBS surfaces, not empty.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    name: Option<String>,
    surfaces: Vec<NurbsSurface>,
}

impl Model {
    /// A model of these surfaces.
    ///
    /// # Errors
    /// [`Error::EmptyModel`] without surfaces.
    pub fn new(name: Option<String>, surfaces: Vec<NurbsSurface>) -> Result<Self> {
        if surfaces.is_empty() {
            return Err(Error::EmptyModel);
        }
        Ok(Self { name, surfaces })
    }

    /// Validates plain arrays, one entry a surface.
    ///
    /// # Errors
    /// As [`NurbsSurface::new`] and [`Model::new`].
    pub fn from_arrays(name: Option<String>, surfaces: Vec<SurfaceArrays>) -> Result<Self> {
        let surfaces = surfaces
            .into_iter()
            .enumerate()
            .map(|(index, arrays)| NurbsSurface::new(index, arrays))
            .collect::<Result<_>>()?;
        Self::new(name, surfaces)
    }

    /// The name the model was given.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// The surfaces, at least one.
    #[must_use]
    pub fn surfaces(&self) -> &[NurbsSurface] {
        &self.surfaces
    }

    /// The box of all control points, which contains the model.
    #[must_use]
    pub fn bounding_box(&self) -> Aabb {
        self.surfaces
            .iter()
            .flat_map(NurbsSurface::control_points)
            .fold(Aabb::EMPTY, |aabb, &[x, y, z, _]| aabb.with(DVec3::new(x, y, z)))
    }
}
