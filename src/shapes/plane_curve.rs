//! NURBS curves in a plane: profiles and sections.

/// A NURBS curve in a plane, as plain arrays.
///
/// Not validated: the surface made of it is, by
/// [`NurbsSurface::new`](crate::NurbsSurface::new).
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneCurve {
    /// The degree.
    pub degree: usize,
    /// The knots, control points + degree + 1 of them.
    pub knots: Vec<f64>,
    /// Control points `[x, y, w]`, not multiplied by w; a profile's x is the
    /// radius and its y the height.
    pub control_points: Vec<[f64; 3]>,
}

impl PlaneCurve {
    /// The straight line between two points, of degree 1 over [0, 1].
    #[must_use]
    pub fn line(start: [f64; 2], end: [f64; 2]) -> Self {
        Self::clamped(1, &[start, end])
    }

    /// The B-spline curve of these control points with clamped, evenly spaced
    /// knots over [0, 1].
    #[must_use]
    pub fn clamped(degree: usize, points: &[[f64; 2]]) -> Self {
        Self {
            degree,
            knots: clamped_knots(degree, points.len()),
            control_points: points.iter().map(|&[x, y]| [x, y, 1.0]).collect(),
        }
    }
}

/// Clamped, evenly spaced knots over [0, 1]; `count` is more than `degree`.
pub(super) fn clamped_knots(degree: usize, count: usize) -> Vec<f64> {
    let spans = count.saturating_sub(degree).max(1);
    (0..count + degree + 1)
        .map(|index| index.saturating_sub(degree).min(spans) as f64 / spans as f64)
        .collect()
}
