//! Linear maps of a surface's net along one direction.

use crate::error::Result;
use crate::model::{NurbsSurface, SurfaceArrays};
use glam::{DVec4, Vec4Swizzles};

/// `surface` with degree and knots along `axis` replaced, and every line of
/// control points along it replaced by `map` of it, in homogeneous coordinates.
///
/// All lines that `map` makes have one length. Equal weights stay exactly
/// equal: `map`'s coefficients sum to 1, but in floating point only almost.
pub(super) fn map_lines(
    surface: &NurbsSurface,
    axis: usize,
    degree: usize,
    knots: Vec<f64>,
    map: impl Fn(&[DVec4]) -> Vec<DVec4>,
) -> Result<NurbsSurface> {
    let points = surface.control_points();
    let weight = points[0][3];
    let polynomial = points.iter().all(|point| point[3] == weight);
    let lift = |&[x, y, z, w]: &[f64; 4]| {
        if polynomial { DVec4::new(x, y, z, 1.0) } else { DVec4::new(w * x, w * y, w * z, w) }
    };
    let lower = |point: DVec4| {
        let (xyz, w) = if polynomial { (point.xyz(), weight) } else { (point.xyz() / point.w, point.w) };
        [xyz.x, xyz.y, xyz.z, w]
    };
    let [rows, columns] = surface.counts();
    let (lines, along) = if axis == 0 { (columns, rows) } else { (rows, columns) };
    let (across, step) = if axis == 0 { (1, columns) } else { (columns, 1) };
    let mapped: Vec<Vec<DVec4>> = (0..lines)
        .map(|line| {
            let line: Vec<DVec4> =
                (0..along).map(|index| lift(&points[line * across + index * step])).collect();
            map(&line)
        })
        .collect();
    let length = mapped.first().map_or(0, Vec::len);
    let control_points = if axis == 0 {
        (0..length).flat_map(|index| mapped.iter().map(move |line| lower(line[index]))).collect()
    } else {
        mapped.iter().flatten().map(|&point| lower(point)).collect()
    };
    let mut arrays = SurfaceArrays {
        degree: surface.degree(),
        knots: [surface.knots(0).to_vec(), surface.knots(1).to_vec()],
        counts: surface.counts(),
        control_points,
    };
    let axis = usize::from(axis != 0);
    arrays.degree[axis] = degree;
    arrays.knots[axis] = knots;
    arrays.counts[axis] = length;
    NurbsSurface::new(0, arrays)
}
