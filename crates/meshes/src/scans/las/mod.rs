//! LAS 1.0 to 1.4, and its compressed form LAZ: the coordinates of all points.

mod crs;
mod laz;
mod records;

use crate::{MAX_BYTES, MeshFormat, Soup};
use glam::DVec3;
use nurbs_hausdorff::{Error, Result};
use records::Records;

const FORMAT: MeshFormat = MeshFormat::Las;

/// The number of the last point format, and the bytes of the shortest point.
const LAST_POINT_FORMAT: u8 = 10;
const MIN_POINT_BYTES: usize = 20;

/// The bits of the point format's byte that say whether points are compressed, and its number.
const IS_COMPRESSED: u8 = 1 << 7;
const POINT_FORMAT: u8 = (1 << 6) - 1;

/// The places of the header's fields.
mod place {
    pub(super) const MINOR_VERSION: usize = 25;
    pub(super) const HEADER_SIZE: usize = 94;
    pub(super) const POINTS: usize = 96;
    pub(super) const RECORDS: usize = 100;
    pub(super) const POINT_FORMAT: usize = 104;
    pub(super) const POINT_BYTES: usize = 105;
    pub(super) const SHORT_COUNT: usize = 107;
    pub(super) const SCALE: usize = 131;
    pub(super) const OFFSET: usize = 155;
    pub(super) const EXTENDED_RECORDS: usize = 235;
    pub(super) const EXTENDED_RECORD_COUNT: usize = 243;
    pub(super) const COUNT: usize = 247;
}

/// The parts of a header that say where the points are and how they become coordinates.
struct Header {
    minor_version: u8,
    /// The place of the first point's bytes.
    start: usize,
    /// The bytes of an uncompressed point, which begin with its three integers.
    point_bytes: usize,
    count: u64,
    is_compressed: bool,
    scale: DVec3,
    offset: DVec3,
}

/// Reads all points, those that are marked as withheld too: integer times scale plus offset, in
/// float64.
///
/// The uncompressed points must take at most [`MAX_BYTES`], which bounds the memory of a compressed file:
/// there is no other bound, since points that repeat take no bits.
pub(crate) fn read(bytes: &[u8]) -> Result<Soup> {
    let header = Header::read(bytes)?;
    let size = header.count.saturating_mul(header.point_bytes as u64);
    if size > MAX_BYTES {
        return Err(Error::FileTooLarge { found: size, expected: MAX_BYTES });
    }
    let records = Records::read(bytes, &header)?;
    let mut soup = Soup::in_unit(crs::unit(&records)?);
    let mut push = |record: &[u8]| soup.vertices.push(header.point(record));
    if header.is_compressed {
        laz::read(bytes, &header, &records, &mut push)?;
    } else {
        let end = header.start as u64 + size;
        let points = usize::try_from(end).ok().and_then(|end| bytes.get(header.start..end));
        let points = points.ok_or_else(|| {
            FORMAT.syntax(format!("{} bytes, expected {end} by the number of points", bytes.len()))
        })?;
        points.chunks_exact(header.point_bytes).for_each(push);
    }
    Ok(soup)
}

impl Header {
    fn read(bytes: &[u8]) -> Result<Self> {
        if !bytes.starts_with(b"LASF") {
            return Err(FORMAT.syntax("no LASF at the start"));
        }
        let [minor_version] = field(bytes, place::MINOR_VERSION)?;
        let [format] = field(bytes, place::POINT_FORMAT)?;
        if format & POINT_FORMAT > LAST_POINT_FORMAT {
            return Err(FORMAT.syntax(format!("point format {}", format & POINT_FORMAT)));
        }
        let point_bytes = usize::from(u16::from_le_bytes(field(bytes, place::POINT_BYTES)?));
        if point_bytes < MIN_POINT_BYTES {
            return Err(FORMAT.syntax(format!("points of {point_bytes} bytes")));
        }
        let short_count = u64::from(u32::from_le_bytes(field(bytes, place::SHORT_COUNT)?));
        let count = match minor_version {
            0..4 => short_count,
            _ => u64::from_le_bytes(field(bytes, place::COUNT)?),
        };
        let vector = |place: usize| -> Result<DVec3> {
            let [x, y, z] = [0, 8, 16].map(|next| field(bytes, place + next).map(f64::from_le_bytes));
            Ok(DVec3::new(x?, y?, z?))
        };
        let [scale, offset] = [vector(place::SCALE)?, vector(place::OFFSET)?];
        if !(scale.is_finite() && offset.is_finite() && scale.cmpne(DVec3::ZERO).all()) {
            return Err(FORMAT.syntax(format!("the scale {scale} and the offset {offset}")));
        }
        let start = u32::from_le_bytes(field(bytes, place::POINTS)?) as usize;
        let is_compressed = format & IS_COMPRESSED != 0;
        Ok(Self { minor_version, start, point_bytes, count, is_compressed, scale, offset })
    }

    /// Returns the coordinates of a point from its uncompressed bytes, at least twelve.
    fn point(&self, record: &[u8]) -> DVec3 {
        let integer = |place: usize| {
            let mut bytes = [0; 4];
            bytes.copy_from_slice(&record[place..place + 4]);
            f64::from(i32::from_le_bytes(bytes))
        };
        DVec3::new(integer(0), integer(4), integer(8)) * self.scale + self.offset
    }
}

/// Returns the bytes of a field.
fn field<const N: usize>(bytes: &[u8], place: usize) -> Result<[u8; N]> {
    let found = place.checked_add(N).and_then(|end| bytes.get(place..end));
    found
        .and_then(|found| found.try_into().ok())
        .ok_or_else(|| FORMAT.syntax(format!("{} bytes, expected {N} more at {place}", bytes.len())))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]
mod tests;
