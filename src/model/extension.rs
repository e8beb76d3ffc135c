//! The continuation of a surface beyond its domain.

use super::{NurbsSurface, SurfaceArrays, blossom};
use crate::axis::Axis;
use crate::param_box::ParamBox;
use glam::{DVec3, DVec4, Vec4Swizzles};

impl NurbsSurface {
    /// Returns the surface over the smallest box that contains its domain and `extents`:
    /// beyond the old domain, the polynomials of its first and last spans continue.
    /// `None` where a weight of the continuation is not positive or a number too large,
    /// or where the first or last knot interval of the domain is empty. O(size).
    #[must_use]
    pub(super) fn extended(&self, extents: &ParamBox) -> Option<Self> {
        let mut arrays = self.clone().into_arrays();
        let domain = self.domain();
        for axis in Axis::BOTH {
            let ([start, end], [low, high]) = (domain[axis], extents[axis]);
            if low < start {
                arrays = continued(arrays, axis, low)?;
            }
            if high > end {
                let mirrored = continued(mirrored(arrays, axis), axis, -high)?;
                arrays = self::mirrored(mirrored, axis);
            }
        }
        Self::new(0, arrays).ok()
    }
}

/// Returns the same surface with the parameter along `axis` negated.
fn mirrored(mut arrays: SurfaceArrays, axis: Axis) -> SurfaceArrays {
    arrays.knots[axis].reverse();
    arrays.knots[axis].iter_mut().for_each(|knot| *knot = -*knot);
    let [rows, columns] = arrays.counts;
    match axis {
        Axis::U => {
            let points = &arrays.control_points;
            arrays.control_points =
                (0..rows).rev().flat_map(|row| points[row * columns..(row + 1) * columns].to_vec()).collect();
        }
        Axis::V => arrays.control_points.chunks_mut(columns).for_each(<[_]>::reverse),
    }
    arrays
}

/// Returns the surface with its first span along `axis` begun at `start`.
///
/// Control i of the new, clamped knot vector is the blossom of the first span's
/// polynomial at `start`, p - i times, and the knots p + 1 to p + i (Ramshaw, *Blossoms
/// are polar forms*, 1989).
fn continued(mut arrays: SurfaceArrays, axis: Axis, start: f64) -> Option<SurfaceArrays> {
    let degree = arrays.degree[axis];
    let knots = arrays.knots[axis].clone();
    if knots[degree] >= knots[degree + 1] {
        return None;
    }
    let columns = arrays.counts[1];
    let (lines, stride, step) = match axis {
        Axis::U => (columns, columns, 1),
        Axis::V => (arrays.counts[0], 1, columns),
    };
    for line in 0..lines {
        let at = |index: usize| line * step + index * stride;
        let controls: Vec<DVec4> = (0..=degree)
            .map(|index| {
                let [x, y, z, w] = arrays.control_points[at(index)];
                (w * DVec3::new(x, y, z)).extend(w)
            })
            .collect();
        for control in 0..degree {
            let argument = |index: usize| {
                if index < degree - control { start } else { knots[control + 1 + index] }
            };
            let value = blossom(&knots, degree, degree, &controls, argument);
            if value.w.is_nan() || value.w <= 0.0 {
                return None;
            }
            let [x, y, z] = (value.xyz() / value.w).to_array();
            arrays.control_points[at(control)] = [x, y, z, value.w];
        }
    }
    arrays.knots[axis][..=degree].fill(start);
    Some(arrays)
}
