//! The lines of a file by their sections.

use nurbs_hausdorff::{Error, Result};

/// The sections in their order: start, global, directory, parameters, terminate.
const SECTIONS: [u8; 5] = *b"SGDPT";

/// The column, from 0, of a section's letter; the line's number in the section follows it.
const MARK: usize = 72;

/// The columns of a line without line breaks.
const COLUMNS: usize = 80;

/// The columns of letter and number.
const MARK_COLUMNS: usize = 8;

/// The content of each line before its mark, by section.
#[derive(Debug, Default)]
pub(super) struct Lines<'a> {
    pub(super) global: Vec<&'a [u8]>,
    pub(super) directory: Vec<&'a [u8]>,
    pub(super) parameters: Vec<&'a [u8]>,
    /// The lines, from 1, on which the sections of directory and parameters begin.
    pub(super) first_lines: [usize; 2],
}

/// Returns the error for a line, counted from 1.
pub(super) fn error(line: usize, found: &[u8], expected: &str) -> Error {
    let shown = found.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(found.len());
    let found = String::from_utf8_lossy(&found[shown..]).chars().take(COLUMNS).collect::<String>();
    let found = if found.is_empty() { "nothing".to_owned() } else { found };
    Error::IgesSyntax { line, found: found.trim_end().to_owned(), expected: expected.to_owned() }
}

impl<'a> Lines<'a> {
    /// Splits a file into its sections. O(length).
    ///
    /// # Errors
    /// [`Error::IgesSyntax`] for a line without a section's letter and the next number, sections
    /// out of order, and a last line that is missing or counts other lines.
    pub(super) fn split(bytes: &'a [u8]) -> Result<Self> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let mut lines = Self::default();
        let mut counts = [0_usize; SECTIONS.len()];
        let mut section = 0;
        let mut last = 0;
        for (index, line) in raw_lines(bytes).enumerate() {
            last = index + 1;
            if line.iter().all(|byte| byte.is_ascii_whitespace() || *byte == END_OF_TEXT) {
                continue;
            }
            let fault = |expected: &str| error(last, line, expected);
            let Some((content, letter, number)) = marked(line) else {
                return Err(fault("80 columns that end with the section's letter and the line's number"));
            };
            let found = SECTIONS.iter().position(|&one| one == letter);
            let found = found.ok_or_else(|| fault("one of the sections S, G, D, P and T"))?;
            if found < section || counts[4] > 0 {
                return Err(fault("the sections in the order S, G, D, P, T"));
            }
            section = found;
            counts[section] += 1;
            if number != counts[section] {
                return Err(fault(&format!("line {} of the section", counts[section])));
            }
            match letter {
                b'G' => lines.global.push(content),
                b'D' => lines.directory.push(content),
                b'P' => lines.parameters.push(content),
                b'T' if !is_total(content, &counts) => {
                    return Err(fault("the numbers of lines of the sections before"));
                }
                _ => {}
            }
            if matches!(letter, b'D' | b'P') && counts[section] == 1 {
                lines.first_lines[section - 2] = last;
            }
        }
        match counts {
            [_, _, _, _, 0] => Err(error(last, b"the end of the file", "a last line of the section T")),
            [_, 0, _, _, _] => Err(error(last, b"no section G", "a section G")),
            [_, _, directory, _, _] if directory % 2 == 1 => {
                Err(error(last, b"an odd number of lines in section D", "two lines an entity"))
            }
            _ => Ok(lines),
        }
    }
}

/// The byte that ends texts of some old systems.
const END_OF_TEXT: u8 = 0x1a;

/// Returns the lines of a text, or of one without line breaks every 80 columns.
fn raw_lines(bytes: &[u8]) -> Box<dyn Iterator<Item = &[u8]> + '_> {
    let is_broken = bytes.iter().take(COLUMNS + 2).any(|byte| matches!(byte, b'\n' | b'\r'));
    if !is_broken {
        return Box::new(bytes.chunks(COLUMNS));
    }
    // A carriage return alone ends lines of old systems too.
    let is_unix = bytes.contains(&b'\n');
    let end = if is_unix { b'\n' } else { b'\r' };
    Box::new(bytes.split(move |&byte| byte == end).map(|line| line.strip_suffix(b"\r").unwrap_or(line)))
}

/// Returns the content, the section's letter and the number of a line. Characters of more than
/// one byte move the mark of a line to the right.
fn marked(line: &[u8]) -> Option<(&[u8], u8, usize)> {
    let mark = if line.is_ascii() { MARK } else { line.trim_ascii_end().len().checked_sub(MARK_COLUMNS)? };
    let number = line.get(mark + 1..line.len().min(mark + MARK_COLUMNS))?;
    Some((&line[..mark], line[mark], integer(number)?.try_into().ok()?))
}

/// Reads an integer, right-justified in its columns; blank columns are 0.
pub(super) fn integer(columns: &[u8]) -> Option<i64> {
    let text = columns.trim_ascii();
    if text.is_empty() {
        return Some(0);
    }
    std::str::from_utf8(text).ok()?.parse().ok()
}

/// Returns whether the last line states the numbers of lines of the other sections.
fn is_total(content: &[u8], counts: &[usize; SECTIONS.len()]) -> bool {
    (0..4).all(|index| {
        let field = content.get(index * MARK_COLUMNS..(index + 1) * MARK_COLUMNS);
        field.is_some_and(|field| {
            field[0] == SECTIONS[index]
                && integer(&field[1..]).and_then(|n| n.try_into().ok()) == Some(counts[index])
        })
    })
}
