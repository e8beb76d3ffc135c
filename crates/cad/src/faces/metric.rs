//! Lengths in space of lengths in the parameters.

use crate::nurbs::{SurfaceNet, project};
use crate::report::FaceFault;
use glam::{DAffine3, DVec3, DVec4};
use nurbs_hausdorff::NurbsSurface;

/// Bounds of a surface in the parameters of its NURBS.
#[derive(Debug, Clone, Copy)]
pub(super) struct Metric {
    /// Upper bounds on |S_u| and |S_v| over the domain.
    pub(super) speeds: [f64; 2],
    /// The diagonal of the box of the control points.
    pub(super) size: f64,
    domain: [[f64; 2]; 2],
    /// The diagonals of the boxes of the control points of the domain's sides, by the
    /// parameter that is constant on them: 0 at a pole.
    sides: [[f64; 2]; 2],
}

impl Metric {
    /// Bounds the surface by [`NurbsSurface::lipschitz_bounds`]. O(size).
    ///
    /// # Errors
    /// The reason for which the model refuses the surface.
    pub(super) fn of(net: &SurfaceNet) -> Result<Self, FaceFault> {
        let surface = NurbsSurface::new(0, net.clone().into_arrays(&DAffine3::IDENTITY))
            .map_err(|error| FaceFault::new(error.code(), error.to_string()))?;
        let columns = net.knots[1].len() - net.degrees[1] - 1;
        let last = net.controls.len() - columns;
        let columns_at = |column: usize| diagonal(net.controls.iter().skip(column).step_by(columns));
        let sides = [
            [0, last].map(|row| diagonal(net.controls[row..row + columns].iter())),
            [0, columns - 1].map(columns_at),
        ];
        let size = diagonal(net.controls.iter());
        Ok(Self { speeds: surface.lipschitz_bounds(surface.domain()), size, domain: net.domain(), sides })
    }

    /// Returns an upper bound on the distance in space of two points with this value of a
    /// parameter. On clamped sides the curve lies in the convex hull of the side's points.
    pub(super) fn across(&self, axis: usize, value: f64) -> f64 {
        let side = |end: usize| {
            let mut beside = DVec3::ZERO;
            beside[axis] = value - self.domain[axis][end];
            self.sides[axis][end] + 2.0 * self.length(beside)
        };
        let [start, end] = [side(0), side(1)];
        if start < end { start } else { end }
    }

    /// Returns an upper bound on the length in space of a difference of parameters.
    pub(super) fn length(&self, difference: DVec3) -> f64 {
        let [u, v] = self.speeds;
        let part =
            |speed: f64, difference: f64| if difference == 0.0 { 0.0 } else { speed * difference.abs() };
        part(u, difference.x) + part(v, difference.y)
    }
}

/// The diagonal of the box of control points.
fn diagonal<'a>(controls: impl Iterator<Item = &'a DVec4>) -> f64 {
    let none = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let [low, high] = controls.fold(none, |[low, high], &control| {
        let point = project(control);
        [low.min(point), high.max(point)]
    });
    low.distance(high)
}
