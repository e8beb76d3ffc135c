//! The directory: the type of each entity, and where its parameters are.

use super::lines::{error, integer};
use nurbs_hausdorff::Result;

/// The columns of a field.
const FIELD: usize = 8;

/// The column, from 0, that states whether the entity depends on another one.
const DEPENDENCE: usize = 8 * FIELD + 3;

/// An entry of two lines.
#[derive(Debug, Clone, Copy)]
pub(in crate::iges) struct Entry {
    /// The number of its first line in the section.
    pub(in crate::iges) number: u64,
    /// The type.
    pub(in crate::iges) kind: u32,
    pub(in crate::iges) form: i64,
    /// The number of the matrix that places the entity, or 0.
    pub(in crate::iges) matrix: u64,
    /// Whether another entity must exist for this one to do so.
    pub(in crate::iges) is_dependent: bool,
    /// The number of a colour, or that of the entity that defines it with a minus sign; 0 for none.
    pub(in crate::iges) color: i64,
    /// The label, padded with blanks.
    label: [u8; FIELD],
    /// The first line of its parameters, from 1, and their number of lines.
    pub(super) first_line: usize,
    pub(super) line_count: usize,
}

impl Entry {
    /// Returns the label, unless it is empty.
    pub(in crate::iges) fn name(&self) -> Option<String> {
        let label = self.label.trim_ascii();
        (!label.is_empty()).then(|| String::from_utf8_lossy(label).into_owned())
    }
}

/// Parses the lines of the directory.
///
/// # Errors
/// [`nurbs_hausdorff::Error::IgesSyntax`] for a field that is no integer of its range, and for two lines of
/// different types.
pub(super) fn directory(lines: &[&[u8]], first_line: usize) -> Result<Vec<Entry>> {
    let pairs = lines.chunks_exact(2).enumerate();
    let entry = |(index, pair): (usize, &[&[u8]])| {
        let [first, second] = [pair[0], pair[1]];
        let field = |line: usize, number: usize| -> Result<i64> {
            let columns = pair[line].get(number * FIELD..(number + 1) * FIELD);
            let found = columns.and_then(integer);
            let at = first_line + 2 * index + line;
            found.ok_or_else(|| error(at, pair[line], "integers in columns of eight"))
        };
        let positive = |line: usize, number: usize| -> Result<u64> {
            let at = first_line + 2 * index + line;
            u64::try_from(field(line, number)?)
                .map_err(|_| error(at, pair[line], "an integer that is not negative"))
        };
        let kind = positive(0, 0)?;
        if kind != positive(1, 0)? {
            let at = first_line + 2 * index + 1;
            return Err(error(at, second, "the type of the entry's first line"));
        }
        let mut label = [b' '; FIELD];
        if let Some(columns) = second.get(7 * FIELD..8 * FIELD) {
            label.copy_from_slice(columns);
        }
        Ok(Entry {
            number: 2 * index as u64 + 1,
            kind: u32::try_from(kind).unwrap_or(u32::MAX),
            form: field(1, 4)?,
            matrix: positive(0, 6)?,
            is_dependent: matches!(first.get(DEPENDENCE), Some(b'1' | b'3')),
            // A colour that cannot be read is no reason to refuse the file.
            color: field(1, 2).unwrap_or(0),
            label,
            first_line: usize::try_from(positive(0, 1)?).unwrap_or(usize::MAX),
            line_count: usize::try_from(positive(1, 3)?).unwrap_or(usize::MAX),
        })
    };
    pairs.map(entry).collect()
}
