//! NumPy's format of arrays, version 1.0.

use super::{size, write_values};
use nurbs_hausdorff::SignedDistances;
use std::io::{Result, Write};

/// The bytes before the header: the magic string, the version and the header's length.
const BEFORE_HEADER: usize = 10;

/// The number of bytes whose multiple the values begin at.
const ALIGNMENT: usize = 64;

/// Writes an array of shape x, y, z in Fortran's order.
pub(super) fn write(out: &mut dyn Write, distances: &SignedDistances) -> Result<()> {
    let [x, y, z] = distances.grid.counts;
    let mut header =
        format!("{{'descr': '<f{}', 'fortran_order': True, 'shape': ({x}, {y}, {z}), }}", size(distances));
    // Blanks, and a line's end as the last byte.
    let length = (BEFORE_HEADER + header.len() + 1).next_multiple_of(ALIGNMENT) - BEFORE_HEADER;
    header.extend(std::iter::repeat_n(' ', length - 1 - header.len()));
    header.push('\n');
    out.write_all(b"\x93NUMPY\x01\x00")?;
    // The header has a few hundred bytes.
    out.write_all(&(length as u16).to_le_bytes())?;
    out.write_all(header.as_bytes())?;
    write_values(out, distances)
}
