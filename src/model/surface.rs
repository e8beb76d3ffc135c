//! A validated NURBS surface.

use super::knots;
use crate::axis::Axis;
use crate::error::{Error, Result};
use crate::limits::{MAX_WEIGHT_RATIO, MIN_WEIGHT, is_in_range};
use crate::param_box::ParamBox;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A NURBS surface as plain arrays, not validated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SurfaceArrays {
    /// The degrees in u and v.
    pub degree: [usize; 2],
    /// The knot vectors in u and v, of length count + degree + 1.
    pub knots: [Vec<f64>; 2],
    /// The numbers of control points along u and v.
    pub counts: [usize; 2],
    /// The control points `[x, y, z, w]`, v fastest; x, y, z are not multiplied by w.
    pub control_points: Vec<[f64; 4]>,
}

/// A NURBS surface of degrees 1 to 15 with positive weights, clamped or not.
///
/// Guarantee: every value of this type has passed the checks of
/// [`NurbsSurface::new`], so no later stage checks again. Copies share their memory.
#[derive(Debug, Clone, PartialEq)]
pub struct NurbsSurface {
    arrays: Arc<SurfaceArrays>,
}

impl NurbsSurface {
    /// Validates `arrays`. Errors report `index`, the surface's position in its model.
    ///
    /// # Errors
    /// The first violation found of: degree, number of control points, knots
    /// (length, finite and at most 1e100 in size, not decreasing, non-empty domain,
    /// multiplicity), size of the net, finite coordinates of at most 1e100 in size,
    /// weights from 1e-100 to 1e100 and at least 1e-30 of the surface's largest.
    /// Knots may be arbitrarily close to each other. O(size).
    pub fn new(index: usize, arrays: SurfaceArrays) -> Result<Self> {
        for axis in Axis::BOTH {
            knots::validate(index, axis, arrays.degree[axis], arrays.counts[axis], &arrays.knots[axis])?;
        }
        // Both counts are at most the lengths of knot vectors in memory, so the product cannot overflow.
        let expected = arrays.counts[0] * arrays.counts[1];
        if arrays.control_points.len() != expected {
            return Err(Error::RaggedNet {
                surface: index,
                index: 0,
                found: arrays.control_points.len(),
                expected,
            });
        }
        for (point, &[x, y, z, w]) in arrays.control_points.iter().enumerate() {
            if let Some(found) = [x, y, z, w].into_iter().find(|&value| !is_in_range(value)) {
                return Err(Error::number_out_of_range(index, "control point", point, found));
            }
            if w < MIN_WEIGHT {
                return Err(Error::WeightNotPositive { surface: index, index: point, found: w });
            }
        }
        let weights = || arrays.control_points.iter().map(|point| point[3]);
        let largest = weights().fold(0.0, f64::max);
        if let Some((point, found)) = weights().enumerate().find(|(_, w)| largest > MAX_WEIGHT_RATIO * w) {
            return Err(Error::WeightRatioTooLarge { surface: index, index: point, found, largest });
        }
        Ok(Self { arrays: Arc::new(arrays) })
    }

    /// Returns the degrees in u and v, each 1 to 15.
    #[must_use]
    pub fn degree(&self) -> [usize; 2] {
        self.arrays.degree
    }

    /// Returns the knot vector along `axis`.
    #[must_use]
    pub fn knots(&self, axis: Axis) -> &[f64] {
        &self.arrays.knots[axis]
    }

    /// Returns the numbers of control points along u and v.
    #[must_use]
    pub fn counts(&self) -> [usize; 2] {
        self.arrays.counts
    }

    /// Returns the control points `[x, y, z, w]`, v fastest, not multiplied by w.
    #[must_use]
    pub fn control_points(&self) -> &[[f64; 4]] {
        &self.arrays.control_points
    }

    /// Returns the domain, a rectangle with sides of positive length.
    #[must_use]
    pub fn domain(&self) -> ParamBox {
        Axis::BOTH
            .map(|axis| {
                let knots = self.knots(axis);
                [knots[self.arrays.degree[axis]], knots[self.arrays.counts[axis]]]
            })
            .into()
    }

    /// Returns the surface as plain arrays.
    #[must_use]
    pub fn into_arrays(self) -> SurfaceArrays {
        Arc::unwrap_or_clone(self.arrays)
    }
}
