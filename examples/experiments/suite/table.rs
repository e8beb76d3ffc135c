//! Tables of numbers and names, written as CSV (RFC 4180 without quotes, as no cell
//! contains a comma, a quote or a line break).

use std::fmt::Write as _;
use std::path::Path;

/// Rows under named columns.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Table {
    pub(crate) columns: Vec<&'static str>,
    pub(crate) rows: Vec<Vec<Cell>>,
}

/// One entry of a row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cell {
    /// A name.
    Text(String),
    /// A number, written in full precision.
    Number(f64),
    /// A value that was not measured or failed.
    Empty,
}

impl From<f64> for Cell {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<usize> for Cell {
    fn from(number: usize) -> Self {
        Self::Number(number as f64)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

impl Table {
    pub(crate) fn new(columns: &[&'static str]) -> Self {
        Self { columns: columns.to_vec(), rows: Vec::new() }
    }

    /// Writes the header and the rows to `path`.
    pub(crate) fn save(&self, path: &Path) -> std::io::Result<()> {
        let mut text = self.columns.join(",") + "\n";
        for row in &self.rows {
            for (index, cell) in row.iter().enumerate() {
                let separator = if index == 0 { "" } else { "," };
                // Writing to a string cannot fail.
                let _ = match cell {
                    Cell::Text(name) => write!(text, "{separator}{name}"),
                    Cell::Number(number) => write!(text, "{separator}{number:?}"),
                    Cell::Empty => write!(text, "{separator}"),
                };
            }
            text.push('\n');
        }
        std::fs::write(path, text)
    }
}
