//! Points as text: XYZ, PTS and CSV.
//!
//! A file has one separator and one decimal mark, which hold for all of its lines. Where two
//! readings of a file give different points it is refused.

mod cells;
mod columns;
mod rows;

use crate::{MeshFormat, Soup};
use cells::{Decimal, Layout, Separator};
use glam::DVec3;
use nurbs_hausdorff::Result;
use rows::{Lines, Refusal};
use std::borrow::Cow;

const FORMAT: MeshFormat = MeshFormat::Text;

/// The number of two bytes, by their order.
type Number = fn([u8; 2]) -> u16;

/// The marks of UTF-16 in its two orders of bytes.
const UTF_16: [([u8; 2], Number); 2] =
    [([0xff, 0xfe], u16::from_le_bytes), ([0xfe, 0xff], u16::from_be_bytes)];

/// Reads the points of all lines: their first three numbers, those after a label, or, after a line or a comment
/// that names columns, those of x, y and z. Lines that begin with `#` or `//` are comments; a line
/// of one whole number, as PTS has it before each scan, is the number of the points that follow.
///
/// # Errors
/// [`nurbs_hausdorff::Error::MeshSyntax`] with the line, what was found and what was expected; also where the separator or
/// the decimal mark is ambiguous.
pub(crate) fn read(bytes: &[u8]) -> Result<Soup> {
    let text = decoded(bytes);
    let lines = Lines::of(&text);
    let mut accepted: Option<Soup> = None;
    let mut refused: Option<Refusal> = None;
    for layout in lines.layouts()? {
        match lines.read(layout) {
            Ok(soup) if accepted.as_ref().is_some_and(|other| other.vertices != soup.vertices) => {
                return Err(FORMAT.syntax(
                    "commas that may separate numbers or stand in them, expected one reading of all lines",
                ));
            }
            Ok(soup) => accepted = Some(soup),
            // The reading that fits most lines has the reason that helps.
            Err(refusal) => refused = Some(refusal.or_further(refused)),
        }
    }
    match (accepted, refused) {
        (Some(soup), _) => Ok(soup),
        (None, refused) => Err(refused.map_or_else(|| FORMAT.syntax("no points"), Refusal::into_error)),
    }
}

/// Returns the text of bytes in UTF-8 or, with its mark, UTF-16. Other bytes become characters that no
/// number has.
fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    for (mark, number) in UTF_16 {
        if let Some(content) = bytes.strip_prefix(&mark) {
            let units: Vec<u16> = content.as_chunks().0.iter().map(|&pair| number(pair)).collect();
            return Cow::Owned(String::from_utf16_lossy(&units));
        }
    }
    String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes))
}

impl Lines<'_> {
    /// Returns the layouts that may be that of the file, from its separators alone.
    ///
    /// # Errors
    /// [`nurbs_hausdorff::Error::MeshSyntax`] where some lines are separated by semicolons and others are not.
    fn layouts(&self) -> Result<Vec<Layout>> {
        let both = |separator| [Decimal::Point, Decimal::Comma].map(|decimal| Layout { separator, decimal });
        if let Some(first) = self.rows().find(|(_, row)| row.contains(';')) {
            if let Some((line, row)) = self.rows().find(|(_, row)| !row.contains(';')) {
                let shown: String = row.chars().take(rows::SHOWN).collect();
                return Err(FORMAT.syntax(format!(
                    "line {line}: found {shown:?}, expected values separated by semicolons as in line {}",
                    first.0
                )));
            }
            return Ok(both(Separator::Semicolon).into());
        }
        let has_tabs = |row: &str| row.matches('\t').count() >= 2;
        if self.rows().next().is_some() && self.rows().all(|(_, row)| has_tabs(row)) {
            return Ok(both(Separator::Tab).into());
        }
        let mut layouts = both(Separator::Blanks).to_vec();
        if self.rows().any(|(_, row)| row.contains(',')) {
            layouts.push(Layout { separator: Separator::Comma, decimal: Decimal::Point });
            // Quoted numbers may have commas.
            layouts.push(Layout { separator: Separator::Comma, decimal: Decimal::Comma });
        } else {
            layouts.truncate(1);
        }
        Ok(layouts)
    }
}

impl Soup {
    /// Appends a point.
    fn push_point(&mut self, point: [f64; 3]) {
        self.vertices.push(DVec3::from_array(point));
    }
}
