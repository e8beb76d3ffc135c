//! The entities of a file by their numbers in the directory.

mod directory;
mod entity;
mod global;
mod lines;
mod values;

pub(super) use directory::Entry;
pub(super) use entity::Entity;
pub(super) use global::Global;

use crate::report::FaceFault;
use directory::directory;
use lines::{Lines, integer};
use nurbs_hausdorff::Result;
use values::{Value, values};

/// The result of reading an entity.
pub(super) type Found<T> = std::result::Result<T, FaceFault>;

/// The columns of a line of parameters that hold values; the number of the entity follows them.
const VALUE_COLUMNS: usize = 64;

/// A file whose entities are parsed when they are needed, so that its memory is little more than
/// that of the text.
pub(super) struct File<'a> {
    pub(super) global: Global,
    /// The directory; entry i has the number 2 i + 1.
    entries: Vec<Entry>,
    parameters: Vec<&'a [u8]>,
}

impl<'a> File<'a> {
    /// Finds the entities. O(length).
    ///
    /// # Errors
    /// [`nurbs_hausdorff::Error::IgesSyntax`] with the line, also for a file that ends early.
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self> {
        let Lines { global, directory: lines, parameters, first_lines } = Lines::split(bytes)?;
        let first_global = first_lines[0].saturating_sub(global.len()).max(1);
        let global = Global::parse(&global, first_global)?;
        Ok(Self { global, entries: directory(&lines, first_lines[0])?, parameters })
    }

    /// Returns the entries in their order.
    pub(super) fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// Returns an entry of the directory.
    ///
    /// # Errors
    /// `IGES_REFERENCE` for a number that no entity has.
    pub(super) fn entry(&self, number: u64) -> Found<&Entry> {
        let index = usize::try_from(number / 2).ok().filter(|_| number % 2 == 1);
        index.and_then(|index| self.entries.get(index)).ok_or_else(|| {
            FaceFault::new(
                "IGES_REFERENCE",
                format!("entity {number} is referred to, and not in the directory"),
            )
        })
    }

    /// Parses an entity. O(its length).
    ///
    /// # Errors
    /// `IGES_REFERENCE`, `IGES_SYNTAX` for parameters that do not end or are of another entity.
    pub(super) fn entity(&self, number: u64) -> Found<Entity> {
        let entry = self.entry(number)?;
        let fault = |why: &str| {
            let why = format!("the parameters of entity {number}, type {}, {why}", entry.kind);
            FaceFault::new("IGES_SYNTAX", why)
        };
        let first = entry.first_line.checked_sub(1).ok_or_else(|| fault("have no line"))?;
        let end = first.checked_add(entry.line_count.max(1)).filter(|&end| end <= self.parameters.len());
        let lines = &self.parameters[first..end.ok_or_else(|| fault("are beyond the end of the section"))?];
        let mut text = Vec::with_capacity(lines.len() * VALUE_COLUMNS);
        for line in lines {
            let (columns, owner) = line.split_at(line.len().min(columns(line)));
            // Some writers leave the number out.
            if !matches!(integer(owner), Some(owner) if owner == 0 || u64::try_from(owner) == Ok(number)) {
                return Err(fault("stand on lines of another entity"));
            }
            text.extend_from_slice(columns);
        }
        let values = values(&text, self.global.delimiters).map_err(|_| fault("do not end"))?;
        match values.first() {
            Some(Value::Number(kind)) if *kind == f64::from(entry.kind) => Ok(Entity::new(*entry, values)),
            _ => Err(fault("do not begin with the type")),
        }
    }
}

/// Returns the columns of values of a line, which end before the number of its entity.
fn columns(line: &[u8]) -> usize {
    // Characters of more than one byte move the number to the right.
    if line.is_ascii() { VALUE_COLUMNS } else { line.len().saturating_sub(VALUE_COLUMNS / 8) }
}
