//! PTX: scans as grids of points, each with the transform that places it.

use crate::{MeshFormat, Soup};
use glam::{DAffine3, DVec3, DVec4};
use nurbs_hausdorff::Result;

const FORMAT: MeshFormat = MeshFormat::Ptx;

/// The lines before the points of a scan: columns and rows, the scanner's position and axes, and the
/// four rows of the transform.
const HEADER_LINES: usize = 10;

/// The largest number of characters of a line in a message.
const SHOWN: usize = 60;

/// Reads the points of all scans, each moved by its transform. A place of a grid at the scanner's
/// origin is one without a point.
///
/// # Errors
/// [`nurbs_hausdorff::Error::MeshSyntax`] with the line.
pub(crate) fn read(bytes: &[u8]) -> Result<Soup> {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let mut soup = Soup::default();
    let mut missing = 0_usize;
    let mut header = Vec::with_capacity(HEADER_LINES);
    while let Some(first) = lines.next() {
        header.clear();
        header.push(first);
        header.extend(lines.by_ref().take(HEADER_LINES - 1));
        let (count, transform) = parse(&header)?;
        for found in 0..count {
            let Some((index, line)) = lines.next() else {
                return Err(FORMAT.syntax(format!("{found} points of a scan, expected {count}")));
            };
            let words = line.split_ascii_whitespace();
            let point = DVec3::from_array(numbers(index, line, words)?);
            if point == DVec3::ZERO {
                missing += 1;
            } else {
                soup.vertices.push(transform.transform_point3(point));
            }
        }
    }
    if missing > 0 {
        soup.note("points", format!("{missing} places of the grids have no point"));
    }
    Ok(soup)
}

/// Returns the number of points of a scan and its transform, whose rows are the images of the axes and
/// the translation.
fn parse(header: &[(usize, &str)]) -> Result<(usize, DAffine3)> {
    let [(first, columns), (_, rows), .., x, y, z, origin] = header else {
        return Err(FORMAT.syntax(format!("a scan of {} lines, expected {HEADER_LINES}", header.len())));
    };
    if header.len() < HEADER_LINES {
        return Err(FORMAT.syntax(format!("a scan of {} lines, expected {HEADER_LINES}", header.len())));
    }
    let size = |text: &str| text.trim().parse::<usize>().ok();
    let count = size(columns).zip(size(rows)).and_then(|(columns, rows)| columns.checked_mul(rows));
    let count = count.ok_or_else(|| refused(*first, columns, "the numbers of columns and rows"))?;
    let mut axes = [DVec4::ZERO; 4];
    for (axis, (index, line)) in axes.iter_mut().zip([x, y, z, origin]) {
        *axis = DVec4::from_array(numbers(*index, line, line.split_ascii_whitespace())?);
    }
    let transform =
        DAffine3::from_cols(axes[0].truncate(), axes[1].truncate(), axes[2].truncate(), axes[3].truncate());
    Ok((count, transform))
}

/// Returns the first numbers of a line.
fn numbers<'a, const N: usize>(
    index: usize,
    line: &str,
    mut words: impl Iterator<Item = &'a str>,
) -> Result<[f64; N]> {
    let mut found = [0.0; N];
    for number in &mut found {
        let word = words.next().and_then(|word| word.parse().ok());
        *number = word.ok_or_else(|| refused(index, line, "numbers"))?;
    }
    Ok(found)
}

fn refused(index: usize, line: &str, expected: &str) -> nurbs_hausdorff::Error {
    let shown: String = line.trim().chars().take(SHOWN).collect();
    FORMAT.syntax(format!("line {}: found {shown:?}, expected {expected}", index + 1))
}
