//! Degree reduction.

use crate::approximation::elimination::eliminated;
use crate::axis::Axis;
use crate::error::{Error, Result};
use crate::model::NurbsSurface;
use crate::refine::map_lines;
use crate::shapes::curves::basis;
use glam::DVec4;

/// Returns a surface of a degree lower by one along `axis`, with each knot repeated
/// once less where it is repeated, that interpolates the homogeneous surface at the
/// Greville abscissae of the new knots.
///
/// A spline that was raised by [`super::elevate_degree`] is restored; others are
/// approximated, as translators to formats of lower degree do. Interpolation at Greville
/// abscissae has a solution by the theorem of Schoenberg and Whitney (de Boor, *A Practical Guide
/// to Splines*, chapter XIII). O(n³ + control points × n) for n control points along the axis.
///
/// # Errors
/// `DEGREE_OUT_OF_RANGE` for degree 1; those of validation where a weight of the
/// approximation is not positive.
pub fn reduce_degree(surface: &NurbsSurface, axis: Axis) -> Result<NurbsSurface> {
    let degree = surface.degree()[axis];
    if degree == 1 {
        return Err(Error::DegreeOutOfRange { surface: 0, axis, found: 0 });
    }
    let (knots, count) = (surface.knots(axis), surface.counts()[axis]);
    let reduced = reduced_knots(knots, degree, surface.domain()[axis]);
    let reduced_count = reduced.len() - degree;
    let sites: Vec<f64> = (0..reduced_count)
        .map(|index| {
            let inner = &reduced[index + 1..index + degree];
            let mean = inner.iter().sum::<f64>() / (degree - 1) as f64;
            mean.clamp(reduced[degree - 1], reduced[reduced_count])
        })
        .collect();
    let matrix: Vec<Vec<f64>> =
        sites.iter().map(|&site| basis(&reduced, degree - 1, reduced_count, site)).collect();
    let values: Vec<Vec<f64>> = sites.iter().map(|&site| basis(knots, degree, count, site)).collect();
    map_lines(surface, axis, degree - 1, &reduced, &|line| {
        let right = values.iter().map(|values| {
            values.iter().zip(line).fold(DVec4::ZERO, |sum, (value, &point)| sum + *value * point)
        });
        eliminated(matrix.clone(), right.collect())
    })
}

/// Returns clamped knots over the domain with multiplicities lower by one, at least 1.
fn reduced_knots(knots: &[f64], degree: usize, [start, end]: [f64; 2]) -> Vec<f64> {
    let mut reduced = vec![start; degree];
    let inner: Vec<f64> = knots.iter().copied().filter(|&knot| knot > start && knot < end).collect();
    for run in inner.chunk_by(|a, b| a == b) {
        let times = run.len().saturating_sub(1).clamp(1, degree);
        reduced.extend(std::iter::repeat_n(run[0], times));
    }
    reduced.extend(std::iter::repeat_n(end, degree));
    reduced
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::shapes::operations::elevate_degree;
    use crate::shapes::shape;

    #[test]
    fn an_elevated_surface_is_restored() {
        for name in ["net-6x6", "torus", "naca-wing"] {
            let model = shape(name).unwrap();
            let surface = &model.surfaces()[0];
            for axis in Axis::BOTH {
                let elevated = elevate_degree(surface, axis).unwrap();
                let reduced = reduce_degree(&elevated, axis).unwrap();
                assert_eq!(reduced.degree(), surface.degree());
                assert_eq!(reduced.knots(axis), surface.knots(axis), "{name}");
                for (from, to) in reduced.control_points().iter().zip(surface.control_points()) {
                    for k in 0..4 {
                        assert!((from[k] - to[k]).abs() < 1e-11 * (1.0 + to[k].abs()), "{name}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_cubic_is_approximated_between_its_ends() {
        let model = shape("net-6x6").unwrap();
        let surface = &model.surfaces()[0];
        let reduced = reduce_degree(surface, Axis::U).unwrap();
        assert_eq!(reduced.degree()[Axis::U], surface.degree()[Axis::U] - 1);
        assert_eq!(reduced.domain(), surface.domain());
        let columns = surface.counts()[1];
        assert!(
            reduced.control_points()[..columns]
                .iter()
                .zip(&surface.control_points()[..columns])
                .all(|(a, b)| (a[2] - b[2]).abs() < 1e-12)
        );
        assert!(reduce_degree(&shape("cylinder").unwrap().surfaces()[0], Axis::V).is_err());
    }
}
