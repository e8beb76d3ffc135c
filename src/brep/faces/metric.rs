//! Lengths in space of lengths in the parameters.

use crate::brep::nurbs::{SurfaceNet, project};
use crate::brep::report::FaceFault;
use crate::model::NurbsSurface;
use glam::{DAffine3, DVec3};

/// Bounds of a surface in the parameters of its NURBS.
#[derive(Debug, Clone, Copy)]
pub(super) struct Metric {
    /// Upper bounds on |S_u| and |S_v| over the domain.
    pub(super) speeds: [f64; 2],
    /// The diagonal of the box of the control points.
    pub(super) size: f64,
}

impl Metric {
    /// Bounds the surface by [`NurbsSurface::lipschitz_bounds`]. O(size).
    ///
    /// # Errors
    /// The reason for which the model refuses the surface.
    pub(super) fn of(net: &SurfaceNet) -> Result<Self, FaceFault> {
        let surface = NurbsSurface::new(0, net.clone().into_arrays(&DAffine3::IDENTITY))
            .map_err(|error| FaceFault::new(error.code(), error.to_string()))?;
        let points = || net.controls.iter().map(|&control| project(control));
        let low = points().fold(DVec3::INFINITY, DVec3::min);
        let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
        Ok(Self { speeds: surface.lipschitz_bounds(surface.domain()), size: low.distance(high) })
    }

    /// Returns an upper bound on the length in space of a difference of parameters.
    pub(super) fn length(&self, difference: DVec3) -> f64 {
        let [u, v] = self.speeds;
        let part =
            |speed: f64, difference: f64| if difference == 0.0 { 0.0 } else { speed * difference.abs() };
        part(u, difference.x) + part(v, difference.y)
    }
}
