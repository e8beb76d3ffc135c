//! Plane NURBS curves.

/// A NURBS curve in a plane, as plain arrays.
///
/// It is not validated; [`NurbsSurface::new`](crate::NurbsSurface::new) validates
/// the surface made of it.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneCurve {
    /// The degree.
    pub degree: usize,
    /// The knots; their number is that of the control points + degree + 1.
    pub knots: Vec<f64>,
    /// The control points `[x, y, w]`, not multiplied by w. In a profile x is the
    /// radius and y the height.
    pub control_points: Vec<[f64; 3]>,
}

impl PlaneCurve {
    /// Returns the straight line between two points, of degree 1 over [0, 1].
    #[must_use]
    pub fn line(start: [f64; 2], end: [f64; 2]) -> Self {
        Self::clamped(1, &[start, end])
    }

    /// Returns the B-spline curve of these control points with clamped, evenly
    /// spaced knots over [0, 1].
    #[must_use]
    pub fn clamped(degree: usize, points: &[[f64; 2]]) -> Self {
        Self {
            degree,
            knots: clamped_knots(degree, points.len()),
            control_points: points.iter().map(|&[x, y]| [x, y, 1.0]).collect(),
        }
    }
}

/// Returns clamped, evenly spaced knots over [0, 1] for `count` control points,
/// more than `degree`.
pub(in crate::shapes) fn clamped_knots(degree: usize, count: usize) -> Vec<f64> {
    let spans = count.saturating_sub(degree).max(1);
    (0..count + degree + 1)
        .map(|index| index.saturating_sub(degree).min(spans) as f64 / spans as f64)
        .collect()
}
