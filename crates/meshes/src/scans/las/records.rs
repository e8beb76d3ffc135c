//! The variable length records of LAS, before and behind the points.

use super::{Header, field, place};
use nurbs_hausdorff::Result;

/// The places of a record's fields, and the bytes before its content: the content's length takes
/// two bytes before the points and eight behind them.
const USER: usize = 2;
const USER_BYTES: usize = 16;
const ID: usize = 18;
const LENGTH: usize = 20;
const HEADER_BYTES: usize = 54;
const EXTENDED_HEADER_BYTES: usize = 60;

/// A record's user, with zeros at its end, its number, and its content.
type Record<'a> = ([u8; USER_BYTES], u16, &'a [u8]);

/// The records of a file.
pub(super) struct Records<'a>(Vec<Record<'a>>);

impl<'a> Records<'a> {
    /// Reads all records.
    ///
    /// # Errors
    /// [`nurbs_hausdorff::Error::MeshSyntax`] for records beyond the file.
    pub(super) fn read(bytes: &'a [u8], header: &Header) -> Result<Self> {
        let mut records = Vec::new();
        let mut at = usize::from(u16::from_le_bytes(field(bytes, place::HEADER_SIZE)?));
        // Each record takes bytes, so that this ends within the file whatever the count is.
        for _ in 0..u32::from_le_bytes(field(bytes, place::RECORDS)?) {
            let length = u64::from(u16::from_le_bytes(field(bytes, at.saturating_add(LENGTH))?));
            records.push(record(bytes, &mut at, HEADER_BYTES, length)?);
        }
        if header.minor_version >= 4 {
            let first = u64::from_le_bytes(field(bytes, place::EXTENDED_RECORDS)?);
            at = usize::try_from(first).unwrap_or(usize::MAX);
            for _ in 0..u32::from_le_bytes(field(bytes, place::EXTENDED_RECORD_COUNT)?) {
                let length = u64::from_le_bytes(field(bytes, at.saturating_add(LENGTH))?);
                records.push(record(bytes, &mut at, EXTENDED_HEADER_BYTES, length)?);
            }
        }
        Ok(Self(records))
    }

    /// Returns the content of the first record of this user and number.
    pub(super) fn content(&self, user: &[u8], id: u16) -> Option<&'a [u8]> {
        let is_of = |found: &[u8]| found.strip_prefix(user).is_some_and(|rest| rest.iter().all(|&b| b == 0));
        self.0.iter().find(|record| is_of(&record.0) && record.1 == id).map(|record| record.2)
    }
}

/// Reads the record at a place, and moves the place behind it.
fn record<'a>(bytes: &'a [u8], at: &mut usize, header: usize, length: u64) -> Result<Record<'a>> {
    let user = field(bytes, at.saturating_add(USER))?;
    let id = u16::from_le_bytes(field(bytes, at.saturating_add(ID))?);
    let start = at.saturating_add(header);
    let end = start.saturating_add(usize::try_from(length).unwrap_or(usize::MAX));
    let content = bytes.get(start..end).ok_or_else(|| {
        super::FORMAT.syntax(format!("a record of {length} bytes at {at} of {}", bytes.len()))
    })?;
    *at = end;
    Ok((user, id, content))
}
