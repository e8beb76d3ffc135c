//! The cells of a line.

/// The separator of a file's cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Separator {
    Semicolon,
    Tab,
    Comma,
    /// Any number of blanks or tabs, so that no cell is empty.
    Blanks,
}

/// The mark before the decimals of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Decimal {
    Point,
    Comma,
}

/// The separator and the decimal mark of all lines of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Layout {
    pub(super) separator: Separator,
    pub(super) decimal: Decimal,
}

impl Layout {
    /// Puts the cells of a line, without blanks and quotes around them, into `cells`; those after the last one
    /// that is not empty are left out.
    pub(super) fn split<'a>(self, line: &'a str, cells: &mut Vec<&'a str>) {
        cells.clear();
        let mark = match self.separator {
            Separator::Blanks => {
                cells.extend(line.split_whitespace().map(|cell| cell.trim_matches('"')));
                return;
            }
            Separator::Semicolon => ';',
            Separator::Tab => '\t',
            Separator::Comma => ',',
        };
        let mut quoted = false;
        let is_end = |character: char| {
            quoted ^= character == '"';
            character == mark && !quoted
        };
        cells.extend(line.split(is_end).map(|cell| cell.trim().trim_matches('"').trim()));
        while cells.last().is_some_and(|cell| cell.is_empty()) {
            cells.pop();
        }
    }

    /// Returns the number of a cell; none where it has the other decimal mark.
    pub(super) fn number(self, cell: &str) -> Option<f64> {
        match self.decimal {
            Decimal::Point => cell.parse().ok(),
            Decimal::Comma if cell.contains('.') || cell.ends_with(',') => None,
            // Two commas become two points, which no number has.
            Decimal::Comma => cell.replace(',', ".").parse().ok(),
        }
    }
}
