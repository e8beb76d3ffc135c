//! E57: the points of all scans, each moved by its pose, in metres.
//!
//! The crate `e57` takes memory for the XML as long as the header says, and for as many values of
//! a field that takes no bits as another one of its packet has: without another one, without end.
//! Both are checked here before.

use crate::{MAX_BYTES, MeshFormat, Soup};
use e57::{CartesianCoordinate, E57Reader, PointCloud, RecordDataType};
use glam::DVec3;
use nurbs_hausdorff::{Error, Result};
use std::io::Cursor;

const FORMAT: MeshFormat = MeshFormat::E57;

/// The place of the XML's length in the header, and the largest length: a node of it takes some
/// twenty times the memory of its text.
const XML_LENGTH: usize = 32;
const MAX_XML_BYTES: u64 = 1 << 24;

/// The largest number of fields of a point: the standard has 21, its extensions a few more.
const MAX_FIELDS: usize = 64;

/// Reads the points whose Cartesian or spherical coordinates are valid.
pub(crate) fn read(bytes: &[u8]) -> Result<Soup> {
    let length =
        bytes.get(XML_LENGTH..).and_then(|rest| rest.first_chunk()).map(|&bytes| u64::from_le_bytes(bytes));
    if let Some(length) = length.filter(|&length| length > MAX_XML_BYTES.min(bytes.len() as u64)) {
        return Err(FORMAT.syntax(format!("{length} bytes of XML in a file of {}", bytes.len())));
    }
    let mut reader = E57Reader::new(Cursor::new(bytes)).map_err(damaged)?;
    let scans = reader.pointclouds();
    check(&scans)?;
    let mut soup = Soup::in_unit(Some(1.0));
    for scan in &scans {
        let mut points = reader.pointcloud_simple(scan).map_err(damaged)?;
        points.intensity_to_color(false);
        points.normalize_color(false);
        points.normalize_intensity(false);
        for point in points {
            if let CartesianCoordinate::Valid { x, y, z } = point.map_err(damaged)?.cartesian {
                soup.vertices.push(DVec3::new(x, y, z));
            }
        }
    }
    Ok(soup)
}

/// Checks the numbers of points and of fields.
fn check(scans: &[PointCloud]) -> Result<()> {
    let count = scans.iter().fold(0_u64, |sum, scan| sum.saturating_add(scan.records));
    let size = count.saturating_mul(size_of::<DVec3>() as u64);
    if size > MAX_BYTES {
        return Err(Error::FileTooLarge { found: size, expected: MAX_BYTES });
    }
    for scan in scans {
        let takes_bits = |data: &RecordDataType| match data {
            RecordDataType::Integer { min, max } | RecordDataType::ScaledInteger { min, max, .. } => {
                min < max
            }
            RecordDataType::Single { .. } | RecordDataType::Double { .. } => true,
        };
        if !scan.prototype.iter().any(|field| takes_bits(&field.data_type))
            || scan.prototype.len() > MAX_FIELDS
        {
            return Err(FORMAT.syntax(format!("points of {} fields", scan.prototype.len())));
        }
    }
    Ok(())
}

fn damaged(error: e57::Error) -> Error {
    FORMAT.syntax(error.to_string())
}
