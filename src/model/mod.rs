//! The input: NURBS surfaces and rigid transforms, validated once.

mod json;
mod knots;
mod rigid_transform;
mod surface;
pub mod trim;

pub use crate::limits::MAX_DEGREE;
pub use rigid_transform::RigidTransform;
pub use surface::{NurbsSurface, SurfaceArrays};

use crate::bvh::Aabb;
use crate::error::{Error, Result};
use glam::DVec3;

/// A non-empty list of NURBS surfaces, measured as one set of points.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    name: Option<String>,
    surfaces: Vec<NurbsSurface>,
}

impl Model {
    /// Makes a model of these surfaces.
    ///
    /// # Errors
    /// [`Error::EmptyModel`] without surfaces.
    pub fn new(name: Option<String>, surfaces: Vec<NurbsSurface>) -> Result<Self> {
        if surfaces.is_empty() {
            return Err(Error::EmptyModel);
        }
        Ok(Self { name, surfaces })
    }

    /// Makes a model of surfaces given as plain arrays, which it validates.
    ///
    /// # Errors
    /// Those of [`NurbsSurface::new`] and [`Model::new`].
    pub fn from_arrays(name: Option<String>, surfaces: Vec<SurfaceArrays>) -> Result<Self> {
        let surfaces = surfaces
            .into_iter()
            .enumerate()
            .map(|(index, arrays)| NurbsSurface::new(index, arrays))
            .collect::<Result<_>>()?;
        Self::new(name, surfaces)
    }

    /// Returns the model with other control points on the same knots of one surface.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`] if there is no such surface, those of [`NurbsSurface::new`].
    pub fn with_control_points(&self, surface: usize, control_points: Vec<[f64; 4]>) -> Result<Self> {
        let mut model = self.clone();
        let Some(changed) = model.surfaces.get_mut(surface) else {
            let expected = "the index of a surface";
            return Err(Error::OptionOutOfRange { option: "surface", found: surface.to_string(), expected });
        };
        *changed =
            NurbsSurface::new(surface, SurfaceArrays { control_points, ..changed.clone().into_arrays() })?;
        Ok(model)
    }

    /// Returns the name of the model, if it has one.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// Returns the surfaces, at least one.
    #[must_use]
    pub fn surfaces(&self) -> &[NurbsSurface] {
        &self.surfaces
    }

    /// Returns the box of all control points, which contains the model. O(control points).
    #[must_use]
    pub fn bounding_box(&self) -> Aabb {
        self.surfaces
            .iter()
            .flat_map(NurbsSurface::control_points)
            .fold(Aabb::EMPTY, |aabb, &[x, y, z, _]| aabb.with(DVec3::new(x, y, z)))
    }
}
