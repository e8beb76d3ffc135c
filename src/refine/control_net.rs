//! Control nets, and their linear maps along one axis.

use crate::axis::Axis;
use crate::error::Result;
use crate::model::{NurbsSurface, SurfaceArrays};
use glam::{DVec4, Vec4Swizzles};

/// Makes the surface whose control point in row i along u and column j along v is
/// `point(i, j)`, `[x, y, z, w]`.
pub(crate) fn net_surface(
    degree: [usize; 2],
    knots: [&[f64]; 2],
    counts: [usize; 2],
    point: &dyn Fn(usize, usize) -> [f64; 4],
) -> Result<NurbsSurface> {
    let mut control_points = Vec::with_capacity(counts[0] * counts[1]);
    for i in 0..counts[0] {
        for j in 0..counts[1] {
            control_points.push(point(i, j));
        }
    }
    NurbsSurface::new(0, SurfaceArrays { degree, knots: knots.map(<[f64]>::to_vec), counts, control_points })
}

/// Returns `surface` with a new degree and new knots along `axis`, and with every
/// line of control points along it replaced by its image under `map`, in
/// homogeneous coordinates.
///
/// `map` must be affine and return lines of one length. Equal weights stay exactly
/// equal, although the coefficients of `map` sum to 1 only up to rounding.
pub(crate) fn map_lines(
    surface: &NurbsSurface,
    axis: Axis,
    degree: usize,
    knots: &[f64],
    map: &dyn Fn(&[DVec4]) -> Vec<DVec4>,
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
    let (lines, along) = if axis == Axis::U { (columns, rows) } else { (rows, columns) };
    let (across, step) = if axis == Axis::U { (1, columns) } else { (columns, 1) };
    let mapped: Vec<Vec<DVec4>> = (0..lines)
        .map(|line| {
            let line: Vec<DVec4> =
                (0..along).map(|index| lift(&points[line * across + index * step])).collect();
            map(&line)
        })
        .collect();
    let mut counts = surface.counts();
    let mut degrees = surface.degree();
    let mut all: [&[f64]; 2] = Axis::BOTH.map(|axis| surface.knots(axis));
    (counts[axis], degrees[axis], all[axis]) = (mapped.first().map_or(0, Vec::len), degree, knots);
    net_surface(degrees, all, counts, &|i, j| {
        lower(if axis == Axis::U { mapped[j][i] } else { mapped[i][j] })
    })
}
