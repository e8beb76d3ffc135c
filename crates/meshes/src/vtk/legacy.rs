//! The legacy format, as text and in binary.

use super::arrays::Type;
use super::{Cells, FORMAT, Part, index};
use glam::DVec3;
use nurbs_hausdorff::{Error, Result};

/// The largest number of characters of a word in a message.
const SHOWN: usize = 60;

/// Reads a dataset of the kind `POLYDATA`.
///
/// # Errors
/// [`Error::MeshSyntax`], of other datasets with their name.
pub(super) fn read(bytes: &[u8]) -> Result<Part> {
    let mut file = File { bytes, at: 0, is_text: true };
    // The version and the title.
    file.line();
    file.line();
    file.is_text = match file.word()? {
        "ASCII" => true,
        "BINARY" => false,
        other => return Err(refused(other, "ASCII or BINARY")),
    };
    if !file.word()?.eq_ignore_ascii_case("DATASET") {
        return Err(FORMAT.syntax("no DATASET, expected POLYDATA"));
    }
    let dataset = file.word()?;
    if !dataset.eq_ignore_ascii_case("POLYDATA") {
        return Err(refused(dataset, "DATASET POLYDATA, the surface of others"));
    }
    let mut part = Part::default();
    loop {
        match file.word()? {
            "" | "POINT_DATA" | "CELL_DATA" => return Ok(part),
            "POINTS" => {
                let count = file.count()?;
                let kind = file.kind()?;
                let numbers = file.numbers(count.saturating_mul(3), kind)?;
                part.points = numbers.as_chunks().0.iter().map(|&point| DVec3::from_array(point)).collect();
            }
            "POLYGONS" => file.cells_once("POLYGONS", &mut part.polygons)?,
            "TRIANGLE_STRIPS" => file.cells_once("TRIANGLE_STRIPS", &mut part.strips)?,
            "LINES" => file.cells_once("LINES", &mut part.lines)?,
            "VERTICES" => drop(file.cells()?),
            "METADATA" => {
                file.line();
                while !file.line().trim_ascii().is_empty() {}
            }
            "FIELD" => file.skip_field()?,
            other => {
                let end = file.at;
                let place = format!("POINTS, POLYGONS or another part of a surface before byte {end}");
                return Err(refused(other, &place));
            }
        }
    }
}

/// The bytes of a file from a place on.
struct File<'a> {
    bytes: &'a [u8],
    at: usize,
    is_text: bool,
}

impl<'a> File<'a> {
    /// Returns the rest of the line, and goes on to the next one.
    fn line(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
        self.at += (length + 1).min(rest.len());
        &rest[..length]
    }

    /// Returns the next word; empty at the end of the file.
    ///
    /// # Errors
    /// [`Error::MeshSyntax`] with the place of bytes that are no text, as a wrong type of numbers before them leaves.
    fn word(&mut self) -> Result<&'a str> {
        let rest = &self.bytes[self.at..];
        let start = rest.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(rest.len());
        let rest = &rest[start..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let begin = self.at + start;
        self.at = begin + length;
        std::str::from_utf8(&rest[..length]).map_err(|_| {
            FORMAT.syntax(format!("bytes that are no text from byte {begin} on, expected a word"))
        })
    }

    fn count(&mut self) -> Result<usize> {
        let word = self.word()?;
        word.parse().map_err(|_| refused(word, "a number of points or cells"))
    }

    fn kind(&mut self) -> Result<Type> {
        let word = self.word()?;
        Type::named(word).ok_or_else(|| refused(word, "a type of numbers"))
    }

    /// Returns the numbers from the next line on.
    fn numbers(&mut self, count: usize, kind: Type) -> Result<Vec<f64>> {
        let ended = || FORMAT.syntax(format!("the file ends within {count} numbers"));
        // Text has a byte a number at least.
        let size = if self.is_text { count } else { count.saturating_mul(kind.size) };
        if size > self.bytes.len() {
            return Err(ended());
        }
        if self.is_text {
            let mut number = || {
                let word = self.word()?;
                word.parse::<f64>().map_err(|_| refused(word, "a number"))
            };
            return (0..count).map(|_| number()).collect();
        }
        self.line();
        let numbers = self.bytes.get(self.at..).and_then(|rest| rest.get(..size)).ok_or_else(ended)?;
        self.at += size;
        Ok(kind.numbers(numbers, true))
    }

    /// Takes over the cells of a section. A second one of the kind would replace the first.
    fn cells_once(&mut self, section: &str, cells: &mut Cells) -> Result<()> {
        if cells.len() > 0 {
            return Err(FORMAT.syntax(format!("{section} twice, expected all in one section")));
        }
        *cells = self.cells()?;
        Ok(())
    }

    /// Returns cells: up to version 4 each begins with its number of corners; from 5.1 on two lists
    /// have the ends and the corners of all.
    fn cells(&mut self) -> Result<Cells> {
        let (count, size) = (self.count()?, self.count()?);
        let before = self.at;
        let word = self.word()?;
        if word != "OFFSETS" {
            self.at = before;
            let int = Type::named("int").ok_or_else(|| refused("int", "a type"))?;
            return counted(count, &self.numbers(size, int)?);
        }
        let kind = self.kind()?;
        let offsets = self.numbers(count, kind)?;
        let word = self.word()?;
        if word != "CONNECTIVITY" {
            return Err(refused(word, "CONNECTIVITY"));
        }
        let kind = self.kind()?;
        let corners = self.numbers(size, kind)?;
        if offsets.first().is_some_and(|&first| first != 0.0) {
            return Err(FORMAT.syntax(format!("offsets from {} on, expected 0", offsets[0])));
        }
        let ends = offsets.iter().skip(1).map(|&end| index(end) as usize).collect();
        Ok(Cells { ends, corners: corners.into_iter().map(index).collect() })
    }

    /// Skips arrays of the whole dataset.
    fn skip_field(&mut self) -> Result<()> {
        self.word()?;
        for _ in 0..self.count()? {
            self.word()?;
            let (width, count) = (self.count()?, self.count()?);
            let kind = self.kind()?;
            self.numbers(width.saturating_mul(count), kind)?;
        }
        Ok(())
    }
}

/// Returns cells of numbers, each cell with its number of corners before it.
fn counted(count: usize, numbers: &[f64]) -> Result<Cells> {
    let mut cells = Cells::default();
    let mut rest = numbers;
    while let [corners, after @ ..] = rest {
        let corners = index(*corners) as usize;
        let cell =
            after.get(..corners).ok_or_else(|| FORMAT.syntax(format!("a cell of {corners} corners")))?;
        cells.corners.extend(cell.iter().map(|&corner| index(corner)));
        cells.ends.push(cells.corners.len());
        rest = &after[corners..];
    }
    match cells.len() == count {
        true => Ok(cells),
        false => Err(FORMAT.syntax(format!("{} cells, expected {count}", cells.len()))),
    }
}

fn refused(found: &str, expected: &str) -> Error {
    let shown: String = found.chars().take(SHOWN).collect();
    FORMAT.syntax(format!("found {shown:?}, expected {expected}"))
}
