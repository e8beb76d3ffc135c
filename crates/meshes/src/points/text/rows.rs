//! The lines of a file, read by a layout.

use super::FORMAT;
use super::cells::{Layout, Separator};
use super::columns::Columns;
use crate::Soup;
use nurbs_hausdorff::Error;

/// The words before numbers in OBJ that are no coordinates of points, which `v` stands before.
const ELEMENTS: [&str; 5] = ["f", "l", "vn", "vt", "vp"];

/// The largest number of characters of a line in a message.
pub(super) const SHOWN: usize = 60;

/// The lines of a file that are not empty, each with its number from 1.
pub(super) struct Lines<'a> {
    /// The comments before the first other line.
    comments: Vec<&'a str>,
    /// Lines that are no comments.
    content: Vec<(usize, &'a str)>,
}

/// The reason for which a layout is not that of a file.
pub(super) struct Refusal {
    line: usize,
    found: String,
}

impl Refusal {
    /// Returns this or the other one, whichever is at a later line.
    pub(super) fn or_further(self, other: Option<Self>) -> Self {
        other.filter(|other| other.line > self.line).unwrap_or(self)
    }

    pub(super) fn into_error(self) -> Error {
        FORMAT.syntax(format!("line {}: {}", self.line, self.found))
    }
}

impl<'a> Lines<'a> {
    pub(super) fn of(text: &'a str) -> Self {
        let mut lines = Self { comments: Vec::new(), content: Vec::new() };
        // Carriage returns alone end lines in files without another end.
        let end = if text.contains('\n') { '\n' } else { '\r' };
        for (index, line) in text.split(end).enumerate() {
            let trimmed = line.trim();
            let comment = trimmed.strip_prefix("//").or_else(|| trimmed.strip_prefix('#'));
            match comment {
                Some(comment) if lines.content.is_empty() => lines.comments.push(comment),
                None if !trimmed.is_empty() => lines.content.push((index + 1, line)),
                _ => {}
            }
        }
        lines
    }

    /// Returns the lines but for those of one word, which are numbers of points.
    pub(super) fn rows(&self) -> impl Iterator<Item = (usize, &'a str)> + '_ {
        self.content.iter().copied().filter(|(_, line)| line.trim().parse::<u64>().is_err())
    }

    /// Reads the points.
    pub(super) fn read(&self, layout: Layout) -> Result<Soup, Refusal> {
        let mut soup = Soup::default();
        let mut cells = Vec::new();
        let mut columns: Option<Columns> = None;
        let mut is_obj = false;
        // The number of cells of a row, where the file has one.
        let mut width = None;
        let mut scan = Scan::default();
        for &(line, text) in &self.content {
            let refusal = |found: String| Refusal { line, found };
            if let Ok(count) = text.trim().parse::<usize>() {
                scan.begin(count, soup.vertices.len()).map_err(refusal)?;
                continue;
            }
            layout.split(text, &mut cells);
            if columns.is_none() && !cells.iter().any(|cell| layout.number(cell).is_some()) {
                let found = Columns::named(&cells).ok_or_else(|| refusal(unnamed(&cells)))?;
                if let Some(unit) = found.unknown_unit(&cells) {
                    soup.note("coordinates", format!("their unit {unit:?} is none that is known"));
                }
                (columns, width) = (Some(found), Some(cells.len()));
                continue;
            }
            let first = || self.commented(&cells, layout).unwrap_or_else(|| unlabelled(&cells));
            let Columns { places, unit, have_several_units } = *columns.get_or_insert_with(first);
            let label = cells.first().copied().filter(|_| places[0] == 1);
            is_obj |= label == Some("v");
            if is_obj && label.is_some_and(|label| ELEMENTS.contains(&label)) {
                return Err(refusal(format!("found {}, an element of OBJ, expected points", shown(text))));
            }
            if have_several_units {
                return Err(refusal("the columns of coordinates are in units that differ".to_owned()));
            }
            // Blanks separate any number of words after the coordinates, unless names tell it.
            if layout.separator != Separator::Blanks {
                width.get_or_insert(cells.len());
            }
            if let Some(width) = width.filter(|&width| cells.len() > width) {
                return Err(refusal(format!("{} values, expected {width}: {}", cells.len(), shown(text))));
            }
            let number = |place: usize| cells.get(place).and_then(|cell| layout.number(cell));
            let [Some(x), Some(y), Some(z)] = places.map(number) else {
                let [x, y, z] = places.map(|place| place + 1);
                return Err(refusal(format!(
                    "found {}, expected numbers in columns {x}, {y} and {z}",
                    shown(text)
                )));
            };
            soup.unit = unit;
            soup.push_point([x, y, z]);
            scan.check(soup.vertices.len()).map_err(refusal)?;
        }
        let line = self.content.last().map_or(1, |&(line, _)| line);
        scan.end(soup.vertices.len()).map_err(|found| Refusal { line, found })?;
        Ok(soup)
    }

    /// Returns the columns that a comment names before the first row. It has at most as many words as
    /// the row: other comments are prose.
    fn commented(&self, row: &[&str], layout: Layout) -> Option<Columns> {
        let mut names = Vec::new();
        self.comments.iter().rev().find_map(|comment| {
            // What stands before a colon says that names follow.
            let comment = comment.rsplit_once(": ").map_or(*comment, |(_, names)| names);
            let marks = [(Separator::Semicolon, ';'), (Separator::Tab, '\t'), (Separator::Comma, ',')];
            let separator = marks.iter().find(|(_, mark)| comment.contains(*mark));
            let separator = separator.map_or(Separator::Blanks, |&(separator, _)| separator);
            Layout { separator, ..layout }.split(comment, &mut names);
            let found = Columns::named(&names).filter(Columns::are_adjacent)?;
            (names.len() <= row.len()).then_some(found)
        })
    }
}

/// Returns the first three columns, or those after a label.
fn unlabelled(row: &[&str]) -> Columns {
    let is_label = |cell: &&str| cell.parse::<f64>().is_err() && cell.chars().any(char::is_alphabetic);
    let first = usize::from(row.first().is_some_and(is_label));
    Columns { places: [first, first + 1, first + 2], unit: None, have_several_units: false }
}

fn unnamed(names: &[&str]) -> String {
    let names: Vec<String> = names.iter().take(SHOWN).map(|name| shown(name)).collect();
    format!("found the columns {}, expected names of x, y and z, one each", names.join(", "))
}

/// Returns the beginning of a text in quotes.
fn shown(text: &str) -> String {
    format!("{:?}", text.trim().chars().take(SHOWN).collect::<String>())
}

/// The points that a line of one whole number announces.
#[derive(Default)]
struct Scan {
    /// The number of points at the end of the scan.
    end: Option<usize>,
    /// The number of points at its beginning.
    start: usize,
}

impl Scan {
    fn begin(&mut self, count: usize, points: usize) -> Result<(), String> {
        match self.end {
            None if points > 0 => {
                return Err(format!("found {count} alone, expected three coordinates"));
            }
            _ => self.end(points)?,
        }
        *self = Self { end: Some(points.saturating_add(count)), start: points };
        Ok(())
    }

    fn check(&self, points: usize) -> Result<(), String> {
        match self.end {
            Some(end) if points > end => Err(format!("more points than the {} announced", end - self.start)),
            _ => Ok(()),
        }
    }

    fn end(&self, points: usize) -> Result<(), String> {
        match self.end {
            Some(end) if points != end => {
                Err(format!("{} points, expected {}", points - self.start, end - self.start))
            }
            _ => Ok(()),
        }
    }
}
