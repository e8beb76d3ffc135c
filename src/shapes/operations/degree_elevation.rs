//! Degree elevation.

use crate::axis::Axis;
use crate::error::Result;
use crate::model::{NurbsSurface, blossom};
use crate::refine::map_lines;
use glam::DVec4;

/// Returns the same surface with its degree along `axis` raised by one.
///
/// The multiplicity of every knot is raised by one, which keeps the continuity.
/// Control point i is the elevated surface's blossom at its degree + 1 knots, which
/// is the mean of the surface's blossoms at all but one of them (Ramshaw 1989;
/// Piegl and Tiller, *The NURBS Book*, section 5.5). O(control points × degree³).
///
/// # Errors
/// `DEGREE_OUT_OF_RANGE` if the degree is 15 already.
pub fn elevate_degree(surface: &NurbsSurface, axis: Axis) -> Result<NurbsSurface> {
    let degree = surface.degree()[axis];
    let knots = surface.knots(axis);
    let elevated = elevated_knots(knots, degree, surface.domain()[axis]);
    map_lines(surface, axis, degree + 1, &elevated, &|line| {
        (0..elevated.len() - degree - 2)
            .map(|index| {
                let span = longest_span(&elevated[index..=index + degree + 2], knots, degree, line.len());
                let arguments = &elevated[index + 1..=index + degree + 1];
                let controls = &line[span - degree..=span];
                let without = |left_out: usize| {
                    let argument = |place: usize| arguments[place + usize::from(place >= left_out)];
                    blossom(knots, degree, span, controls, argument)
                };
                let sum: DVec4 = (0..=degree).map(without).sum();
                sum / (degree + 1) as f64
            })
            .collect()
    })
}

/// Returns the knots with multiplicities raised by one, without those of unclamped
/// vectors that no basis function with support on the domain uses.
fn elevated_knots(knots: &[f64], degree: usize, [start, end]: [f64; 2]) -> Vec<f64> {
    let mut elevated = Vec::with_capacity(2 * knots.len());
    for (index, &knot) in knots.iter().enumerate() {
        elevated.push(knot);
        if knots.get(index + 1) != Some(&knot) {
            elevated.push(knot);
        }
    }
    let first = elevated.partition_point(|&knot| knot <= start) - (degree + 2);
    let last = elevated.partition_point(|&knot| knot < end) + degree + 1;
    elevated[first..=last].to_vec()
}

/// Returns the longest span of `knots` that lies in the domain and in `support`;
/// extrapolation from it has the smallest rounding error.
fn longest_span(support: &[f64], knots: &[f64], degree: usize, count: usize) -> usize {
    let (low, high) = (support[0], support[support.len() - 1]);
    let length = |span: usize| knots[span + 1] - knots[span];
    (degree..count)
        .filter(|&span| knots[span] >= low && knots[span + 1] <= high)
        .max_by(|&a, &b| length(a).total_cmp(&length(b)))
        .unwrap_or(degree)
}
