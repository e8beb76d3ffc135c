//! The words of a BREP text, with the line that each stands in.

use glam::DVec3;
use nurbs_hausdorff::{Error, Result};

/// A cursor over the words of a text.
pub(super) struct Lexer<'a> {
    rest: &'a str,
    line: usize,
}

impl<'a> Lexer<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { rest: text, line: 1 }
    }

    /// Returns the error for a word that is not what the format requires here.
    pub(super) fn error(&self, found: &str, expected: &str) -> Error {
        // A word of a damaged file may be the entire file.
        let found = found.chars().take(LONGEST_WORD_SHOWN).collect();
        Error::BrepSyntax { line: self.line, found, expected: expected.to_owned() }
    }

    /// Skips white space and counts its lines.
    fn skip_space(&mut self) {
        let trimmed = self.rest.trim_ascii_start();
        let space = &self.rest.as_bytes()[..self.rest.len() - trimmed.len()];
        self.line += space.iter().filter(|&&byte| byte == b'\n').count();
        self.rest = trimmed;
    }

    /// Returns the next word without reading it; `None` at the end of the text.
    pub(super) fn peek(&mut self) -> Option<&'a str> {
        self.skip_space();
        let length = self.rest.find(|c: char| c.is_ascii_whitespace()).unwrap_or(self.rest.len());
        (length > 0).then(|| &self.rest[..length])
    }

    /// Reads a word.
    ///
    /// # Errors
    /// [`Error::BrepSyntax`] at the end of the text, as in the functions below.
    pub(super) fn word(&mut self, expected: &str) -> Result<&'a str> {
        let word = self.peek().ok_or_else(|| self.error("the end of the text", expected))?;
        self.rest = &self.rest[word.len()..];
        Ok(word)
    }

    /// Reads the remainder of the line.
    pub(super) fn rest_of_line(&mut self) -> &'a str {
        let length = self.rest.find('\n').unwrap_or(self.rest.len());
        let (line, rest) = self.rest.split_at(length);
        self.rest = rest;
        line
    }

    /// Reads this keyword.
    pub(super) fn keyword(&mut self, keyword: &str) -> Result<()> {
        let word = self.word(keyword)?;
        if word == keyword { Ok(()) } else { Err(self.error(word, keyword)) }
    }

    /// Reads a finite number.
    pub(super) fn number(&mut self, expected: &str) -> Result<f64> {
        let word = self.word(expected)?;
        match word.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(self.error(word, expected)),
        }
    }

    /// Reads an integer.
    pub(super) fn integer(&mut self, expected: &str) -> Result<i64> {
        let word = self.word(expected)?;
        word.parse().map_err(|_| self.error(word, expected))
    }

    /// Reads an index or a count.
    pub(super) fn count(&mut self, expected: &str) -> Result<usize> {
        let word = self.word(expected)?;
        word.parse().map_err(|_| self.error(word, expected))
    }

    /// Reads an index from 0, which means none, to `last`.
    pub(super) fn index(&mut self, last: usize, expected: &str) -> Result<usize> {
        let word = self.peek().unwrap_or_default();
        let index = self.count(expected)?;
        if index > last { Err(self.error(word, expected)) } else { Ok(index) }
    }

    /// Reads 0 or 1.
    pub(super) fn flag(&mut self, expected: &str) -> Result<bool> {
        let word = self.word(expected)?;
        match word {
            "0" => Ok(false),
            "1" => Ok(true),
            _ => Err(self.error(word, expected)),
        }
    }

    /// Reads a point or vector of 2 or 3 coordinates; the third of 2 is 0.
    pub(super) fn point(&mut self, dimension: Dimension) -> Result<DVec3> {
        let (x, y) = (self.number("a coordinate")?, self.number("a coordinate")?);
        let z = if dimension == Dimension::Three { self.number("a coordinate")? } else { 0.0 };
        Ok(DVec3::new(x, y, z))
    }
}

/// The number of coordinates of points. Curves in the parameter plane are kept as
/// curves of the plane z = 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Dimension {
    Two,
    Three,
}

/// The number of characters of a word that an error shows.
const LONGEST_WORD_SHOWN: usize = 40;
