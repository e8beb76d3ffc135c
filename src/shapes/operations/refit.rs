//! Refits of surfaces, as fitters and translators of CAD data make them.

use super::parts::require_whole;
use crate::axis::Axis;
use crate::error::{Error, Result};
use crate::model::{Model, NurbsSurface};
use crate::refine::net_surface;
use crate::shapes::curves::{DEGREE, UniformSpline, basis};
use glam::{DVec3, DVec4, Vec4Swizzles};

/// Returns the polynomial bicubic B-spline surface over [0, 1]² that interpolates
/// `surface` at `counts[0]` × `counts[1]` evenly spaced parameters of its domain.
///
/// Tensor-product global interpolation (Piegl and Tiller, *The NURBS Book*,
/// algorithm A9.4). Where `surface` is a polynomial of degree at most 3 between
/// any two knots and its knots are among the refit's, the refit is the same
/// surface. O(n² m + n m²) for n × m points.
///
/// # Errors
/// `TOO_FEW_CONTROL_POINTS` for a count below 4.
pub fn refit_surface(surface: &NurbsSurface, counts: [usize; 2]) -> Result<NurbsSurface> {
    require_enough(counts)?;
    let basis_values = Axis::BOTH.map(|axis| {
        let [start, end] = surface.domain()[axis];
        (0..counts[axis])
            .map(|index| {
                let fraction = site(index, counts[axis]);
                let parameter = (1.0 - fraction) * start + fraction * end;
                basis(surface.knots(axis), surface.degree()[axis], surface.counts()[axis], parameter)
            })
            .collect::<Vec<_>>()
    });
    through(counts, |i, j| Ok(point(surface, &basis_values[0][i], &basis_values[1][j])))
}

/// Returns the polynomial bicubic B-spline surface over [0, 1]² that has these points
/// at `counts[0]` × `counts[1]` evenly spaced parameters.
///
/// # Errors
/// `TOO_FEW_CONTROL_POINTS` for a count below 4, and those of `point`.
pub(super) fn interpolated(
    counts: [usize; 2],
    point: impl Fn([f64; 2]) -> Result<DVec3>,
) -> Result<NurbsSurface> {
    require_enough(counts)?;
    through(counts, |i, j| point([site(i, counts[0]), site(j, counts[1])]))
}

fn require_enough(counts: [usize; 2]) -> Result<()> {
    for axis in Axis::BOTH {
        let found = counts[axis];
        if found <= DEGREE {
            return Err(Error::TooFewControlPoints { surface: 0, axis, found, expected: DEGREE + 1 });
        }
    }
    Ok(())
}

/// Returns the parameter of an interpolation site.
fn site(index: usize, count: usize) -> f64 {
    index as f64 / (count - 1) as f64
}

/// Returns the surface through the points of the sites i, j.
fn through(counts: [usize; 2], point: impl Fn(usize, usize) -> Result<DVec3>) -> Result<NurbsSurface> {
    let [rows, columns] = counts;
    let [along_u, along_v] = [rows, columns].map(UniformSpline::new);
    let mut fitted_rows = Vec::with_capacity(rows);
    for i in 0..rows {
        let points = (0..columns).map(|j| point(i, j)).collect::<Result<Vec<DVec3>>>()?;
        fitted_rows.push(along_v.through(points));
    }
    let fitted: Vec<Vec<DVec3>> = (0..columns)
        .map(|column| along_u.through(fitted_rows.iter().map(|row| row[column]).collect()))
        .collect();
    net_surface([DEGREE; 2], [&along_u.knots, &along_v.knots], [rows, columns], &|i, j| {
        fitted[j][i].extend(1.0).to_array()
    })
}

/// Returns `model` with every surface refitted through `count` × `count` points.
///
/// # Errors
/// Those of [`refit_surface`]; `MODEL_TRIMMED` for a model with a trimmed face.
pub fn refit_model(model: &Model, count: usize) -> Result<Model> {
    require_whole(model)?;
    let surfaces = model.surfaces().iter().map(|surface| refit_surface(surface, [count; 2]));
    Model::new(model.name().map(|name| format!("{name}, refitted")), surfaces.collect::<Result<_>>()?)
}

/// Returns the surface point for these values of the basis functions.
fn point(surface: &NurbsSurface, basis_u: &[f64], basis_v: &[f64]) -> DVec3 {
    let columns = surface.counts()[1];
    let mut sum = DVec4::ZERO;
    for (row, u) in surface.control_points().chunks_exact(columns).zip(basis_u) {
        for (&[x, y, z, w], v) in row.iter().zip(basis_v) {
            sum += u * v * w * DVec4::new(x, y, z, 1.0);
        }
    }
    sum.xyz() / sum.w
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::shapes::{bicubic_patch, shape};

    fn at(surface: &NurbsSurface, [u, v]: [f64; 2]) -> DVec3 {
        let [basis_u, basis_v] = Axis::BOTH.map(|axis| {
            let [start, end] = surface.domain()[axis];
            let parameter = start + [u, v][axis] * (end - start);
            basis(surface.knots(axis), surface.degree()[axis], surface.counts()[axis], parameter)
        });
        point(surface, &basis_u, &basis_v)
    }

    #[test]
    fn a_refit_passes_the_sites_and_converges_with_their_number() {
        let torus = shape("torus").unwrap().surfaces()[0].clone();
        let mut last = f64::INFINITY;
        for count in [12, 24, 48] {
            let refit = refit_surface(&torus, [count, count + 1]).unwrap();
            let mut largest = 0.0_f64;
            for k in 0..count {
                let site = [k as f64 / (count - 1) as f64, 0.5 * f64::from(u8::from(k % 2 == 0))];
                let error = (at(&refit, [site[0], 0.0]) - at(&torus, [site[0], 0.0])).length();
                assert!(error < 1e-12, "{error}");
                let between = [(k as f64 + 0.5) / count as f64, site[1]];
                largest = largest.max((at(&refit, between) - at(&torus, between)).length());
            }
            assert!(largest < 0.25 * last, "{count}: {largest}, {last}");
            last = largest;
        }
    }

    #[test]
    fn a_single_bicubic_patch_is_refitted_exactly() {
        let sheet = bicubic_patch();
        let patch = &sheet.surfaces()[0];
        let refit = refit_surface(patch, [7, 9]).unwrap();
        for k in 0..50 {
            let fractions = [0.02 * f64::from(k), (0.37 * f64::from(k)).fract()];
            assert!(at(&refit, fractions).distance(at(patch, fractions)) < 1e-13);
        }
    }
}
