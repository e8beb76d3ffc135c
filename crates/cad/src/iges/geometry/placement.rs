//! Transformation matrices, points and directions.

use super::{MAX_NESTING, Scale};
use crate::iges::file::{Entity, Entry, File, Found};
use crate::nurbs::Frame;
use crate::report::FaceFault;
use glam::{DAffine3, DMat3, DVec3};

/// The deviation of a matrix from an orthonormal one that the digits of files explain.
const ORTHONORMAL: f64 = 1e-4;

/// Returns the map from the coordinates of an entity's parameters to those of what it stands in.
///
/// # Errors
/// `IGES_MATRIX` for a matrix that is no rotation or reflection, `IGES_NESTING`.
pub(in crate::iges) fn placed(file: &File<'_>, entry: &Entry, scale: Scale) -> Found<DAffine3> {
    let mut map = DAffine3::IDENTITY;
    let mut next = entry.matrix;
    for _ in 0..MAX_NESTING {
        if next == 0 {
            return Ok(map);
        }
        let entity = file.entity(next)?;
        map = matrix(&entity, scale)? * map;
        next = entity.entry.matrix;
    }
    let why = format!("entity {} is placed by more than {MAX_NESTING} matrices", entry.number);
    Err(FaceFault::new("IGES_NESTING", why))
}

/// Reads a matrix. Its columns, orthonormal to a few digits, are made so.
pub(in crate::iges) fn matrix(entity: &Entity, scale: Scale) -> Found<DAffine3> {
    if entity.entry.kind != 124 {
        return Err(entity.unknown("a matrix, type 124"));
    }
    let rows = [entity.point(1)?, entity.point(5)?, entity.point(9)?];
    let translation = scale.0 * DVec3::new(entity.real(4)?, entity.real(8)?, entity.real(12)?);
    let columns = DMat3::from_cols(rows[0], rows[1], rows[2]).transpose();
    let product = columns.transpose() * columns - DMat3::IDENTITY;
    if !product.to_cols_array().iter().all(|entry| entry.abs() <= ORTHONORMAL) {
        let why = format!("the matrix {} is no rotation or reflection", entity.number());
        return Err(FaceFault::new("IGES_MATRIX", why));
    }
    let x = columns.x_axis.normalize_or_zero();
    let y = (columns.y_axis - columns.y_axis.dot(x) * x).normalize_or_zero();
    let z = x.cross(y) * columns.determinant().signum();
    Ok(DAffine3 { matrix3: DMat3::from_cols(x, y, z), translation })
}

/// Reads a point, type 116.
pub(super) fn point(file: &File<'_>, number: u64, scale: Scale) -> Found<DVec3> {
    let entity = file.entity(number)?;
    if entity.entry.kind != 116 {
        return Err(entity.unknown("a point, type 116"));
    }
    Ok(placed(file, &entity.entry, scale)?.transform_point3(scale.0 * entity.point(1)?))
}

/// Reads a direction, type 123, as a unit vector.
pub(super) fn direction(file: &File<'_>, number: u64) -> Found<DVec3> {
    let entity = file.entity(number)?;
    if entity.entry.kind != 123 {
        return Err(entity.unknown("a direction, type 123"));
    }
    let found = placed(file, &entity.entry, Scale(0.0))?.transform_vector3(entity.point(1)?);
    found.try_normalize().ok_or_else(|| entity.fault(1, "a direction other than 0"))
}

/// Returns the frame in whose coordinates a rigid map's images have those of the originals.
pub(super) fn frame_before(map: &DAffine3) -> Frame {
    let inverse = map.inverse();
    let DMat3 { x_axis: x, y_axis: y, z_axis: z } = inverse.matrix3;
    Frame { origin: inverse.translation, x, y, z }
}
