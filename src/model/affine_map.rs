//! The affine maps that place the faces of a model.

use super::{NurbsSurface, SurfaceArrays};
use crate::error::{Error, Result};
use crate::limits::is_in_range;
use glam::{DMat3, DVec3};

/// The smallest ratio of the determinant to the product of the columns' lengths: below
/// it, rounding decides whether the map is invertible.
const MIN_DETERMINANT: f64 = 1e-12;

/// The roundings of the stretch, relative to it.
const STRETCH_ROUNDING: f64 = 1.0 + 1e-14;

/// An invertible affine map. Every affine map is exact on NURBS: it maps the control
/// points and keeps the weights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct AffineMap {
    linear: DMat3,
    translation: DVec3,
}

impl AffineMap {
    /// Makes the map of a row-major 3x4 matrix.
    ///
    /// # Errors
    /// [`Error::InstanceTransform`] of instance number `instance` for a number that is not
    /// finite or exceeds 1e100, and for a map that is singular up to rounding.
    pub(super) fn new(instance: usize, matrix: &[f64; 12]) -> Result<Self> {
        let invalid = |found: String| Error::InstanceTransform { instance, found };
        if let Some(index) = matrix.iter().position(|&number| !is_in_range(number)) {
            return Err(invalid(format!("has {:?} at index {index}", matrix[index])));
        }
        let [a, b, c, x, d, e, f, y, g, h, i, z] = *matrix;
        let columns = [DVec3::new(a, d, g), DVec3::new(b, e, h), DVec3::new(c, f, i)];
        let unit = columns.map(|column| column / column.length());
        let determinant = DMat3::from_cols(unit[0], unit[1], unit[2]).determinant().abs();
        if determinant.is_nan() || determinant < MIN_DETERMINANT {
            return Err(invalid("is singular".to_owned()));
        }
        let linear = DMat3::from_cols(columns[0], columns[1], columns[2]);
        Ok(Self { linear, translation: DVec3::new(x, y, z) })
    }

    /// Makes the scaling about the origin by a positive factor.
    pub(super) fn scaling(factor: f64) -> Self {
        Self { linear: DMat3::from_diagonal(DVec3::splat(factor)), translation: DVec3::ZERO }
    }

    /// Returns an upper bound on the factor by which the map lengthens a distance: the
    /// root of the largest row sum of `Mᵀ M`, which bounds its eigenvalues.
    pub(super) fn stretch(&self) -> f64 {
        let product = self.linear.transpose() * self.linear;
        let rows = [product.row(0), product.row(1), product.row(2)];
        let largest = rows.into_iter().map(|row| row.abs().element_sum()).fold(0.0, f64::max);
        STRETCH_ROUNDING * largest.sqrt()
    }

    /// Returns whether the map turns right hands into left hands.
    pub(super) fn reflects(&self) -> bool {
        self.linear.determinant() < 0.0
    }

    /// Returns the image of a surface, its control points rounded to float64.
    ///
    /// # Errors
    /// Those of [`NurbsSurface::new`] for surface number `index`.
    pub(super) fn apply(&self, index: usize, surface: &NurbsSurface) -> Result<NurbsSurface> {
        let mut arrays: SurfaceArrays = surface.clone().into_arrays();
        for point in &mut arrays.control_points {
            let image = self.linear * DVec3::new(point[0], point[1], point[2]) + self.translation;
            point[..3].copy_from_slice(&image.to_array());
        }
        NurbsSurface::new(index, arrays)
    }
}
