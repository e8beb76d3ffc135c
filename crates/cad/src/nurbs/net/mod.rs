//! Surfaces of the file as NURBS over a rectangle of parameters.

mod exact;
mod interpolation;
mod lower_degree;

pub(super) use interpolation::curve as interpolated_curve;

use super::parameter_map::ParameterMap;
use super::spline::{project, support_spans, tensor_point};
use glam::{DAffine3, DVec3, DVec4, Vec4Swizzles};
use nurbs_hausdorff::SurfaceArrays;
use nurbs_hausdorff::workspace::blossom;

/// An exact NURBS and the maps from the parameters of the file to its own.
#[derive(Debug, Clone)]
pub(crate) struct SurfaceNet {
    pub(crate) degrees: [usize; 2],
    pub(crate) knots: [Vec<f64>; 2],
    /// Homogeneous control points, v fastest.
    pub(crate) controls: Vec<DVec4>,
    pub(crate) maps: [ParameterMap; 2],
    /// The deviation from the surface of the file: 0 unless that is an offset or of a degree above
    /// the model's.
    pub(crate) error: f64,
    /// Whether the deviation was found at points, and is no upper bound.
    pub(crate) is_measured: bool,
}

/// Part of a domain by which loops may leave it without an extension of the surface: it
/// would add less to the surface than the loops' joints are moved by.
const DOMAIN_MARGIN: f64 = 1e-9;

/// Returns the control points over new clamped knots along an axis, as
/// [`Spline::with_knots`] does for curves.
fn reknotted(
    controls: &[DVec4],
    [rows, columns]: [usize; 2],
    axis: usize,
    degree: usize,
    old: &[f64],
    new: &[f64],
) -> Vec<DVec4> {
    let count = if axis == 0 { rows } else { columns };
    let spans = support_spans(old, degree, count, new);
    let line = |fixed: usize, span: usize| -> Vec<DVec4> {
        let index = |i| if axis == 0 { i * columns + fixed } else { fixed * columns + i };
        (span - degree..=span).map(|i| controls[index(i)]).collect()
    };
    let control = |index: usize, fixed: usize| {
        blossom(old, degree, spans[index], &line(fixed, spans[index]), |argument| new[index + 1 + argument])
    };
    if axis == 0 {
        (0..spans.len()).flat_map(|i| (0..columns).map(move |j| (i, j))).map(|(i, j)| control(i, j)).collect()
    } else {
        (0..rows).flat_map(|i| (0..spans.len()).map(move |j| (i, j))).map(|(i, j)| control(j, i)).collect()
    }
}

impl SurfaceNet {
    /// Returns the domain.
    pub(crate) fn domain(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|axis| {
            let knots = &self.knots[axis];
            [knots[self.degrees[axis]], knots[knots.len() - 1 - self.degrees[axis]]]
        })
    }

    /// Returns the part of the surface over ranges inside of its domain.
    pub(crate) fn within(mut self, ranges: [[f64; 2]; 2]) -> Self {
        for (axis, [low, high]) in ranges.into_iter().enumerate() {
            let [start, end] = self.domain()[axis];
            if low <= start && high >= end {
                continue;
            }
            let counts = [0, 1].map(|axis| self.knots[axis].len() - self.degrees[axis] - 1);
            let (degree, knots) = (self.degrees[axis], &self.knots[axis]);
            let margin = DOMAIN_MARGIN * (end - start);
            let inside = knots.iter().filter(|&&knot| knot > low + margin && knot < high - margin);
            let ends = [low, high].map(|end| vec![end; degree + 1]);
            let clamped: Vec<f64> = ends[0].iter().chain(inside).chain(&ends[1]).copied().collect();
            self.controls = reknotted(&self.controls, counts, axis, degree, knots, &clamped);
            self.knots[axis] = clamped;
        }
        self
    }

    /// Returns the point at parameters of this net.
    pub(crate) fn point(&self, u: f64, v: f64) -> DVec3 {
        let columns = self.knots[1].len() - self.degrees[1] - 1;
        let knots = self.knots.each_ref().map(Vec::as_slice);
        tensor_point(self.degrees, knots, [u, v], |i, j| self.controls[i * columns + j])
    }

    /// Returns the surface moved by an affine map, as plain arrays.
    pub(crate) fn into_arrays(self, location: &DAffine3) -> SurfaceArrays {
        let counts = [0, 1].map(|axis| self.knots[axis].len() - self.degrees[axis] - 1);
        let point = |&control: &DVec4| {
            let point = location.transform_point3(project(control));
            point.extend(control.w).to_array()
        };
        SurfaceArrays {
            degree: self.degrees,
            counts,
            control_points: self.controls.iter().map(point).collect(),
            knots: self.knots,
        }
    }

    /// Returns whether all weights are positive, which extension may violate.
    pub(crate) fn has_positive_weights(&self) -> bool {
        self.controls.iter().all(|control| control.w > 0.0 && control.xyz().is_finite())
    }
}
