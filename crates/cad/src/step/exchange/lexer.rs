//! The tokens of an exchange file (ISO 10303-21, clause 6).

use nurbs_hausdorff::{Error, Result};

/// A token. Keywords, strings and enumerations are parts of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::step) enum Token<'a> {
    /// `#12`.
    Instance(u64),
    /// The name of an entity, a type or a section.
    Keyword(&'a str),
    /// An integer or real number.
    Number(f64),
    /// The content between apostrophes, with its escapes.
    Text(&'a [u8]),
    /// The name between full stops.
    Enumeration(&'a str),
    Binary,
    /// `$`.
    Omitted,
    /// `*`.
    Derived,
    /// One of `( ) , = ;`.
    Mark(u8),
    End,
}

/// A cursor over the tokens of a file.
#[derive(Debug, Clone)]
pub(in crate::step) struct Lexer<'a> {
    bytes: &'a [u8],
    position: usize,
}

/// The number of characters of a token that an error shows.
const LONGEST_TOKEN_SHOWN: usize = 40;

impl<'a> Lexer<'a> {
    pub(in crate::step) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, position: 0 }
    }

    /// The cursor at a position of the same file.
    pub(in crate::step) fn at(&self, position: usize) -> Self {
        Self { bytes: self.bytes, position }
    }

    pub(in crate::step) fn position(&self) -> usize {
        self.position
    }

    /// Returns the error for the text at `position`, which is not as the format requires.
    /// O(position), to count lines.
    pub(in crate::step) fn error(&self, position: usize, expected: &str) -> Error {
        let position = position.min(self.bytes.len());
        let (before, rest) = self.bytes.split_at(position);
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let word = String::from_utf8_lossy(&rest[..length.min(LONGEST_TOKEN_SHOWN)]).into_owned();
        let found = if word.is_empty() { "the end of the file".to_owned() } else { word };
        Error::StepSyntax { line, found, expected: expected.to_owned() }
    }

    /// Skips white space and comments.
    fn skip_blanks(&mut self) -> Result<()> {
        loop {
            let rest = &self.bytes[self.position..];
            let blanks = rest.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(rest.len());
            self.position += blanks;
            let rest = &rest[blanks..];
            if !rest.starts_with(b"/*") {
                return Ok(());
            }
            match rest[2..].windows(2).position(|pair| pair == b"*/") {
                Some(length) => self.position += length + 4,
                None => return Err(self.error(self.bytes.len(), "the end of a comment, */")),
            }
        }
    }

    /// Reads a token.
    ///
    /// # Errors
    /// [`Error::StepSyntax`] at bytes that begin no token, and in one that does not end.
    pub(in crate::step) fn token(&mut self) -> Result<Token<'a>> {
        self.skip_blanks()?;
        let start = self.position;
        let rest = &self.bytes[start..];
        let Some(&first) = rest.first() else { return Ok(Token::End) };
        let (token, length) = match first {
            b'(' | b')' | b',' | b'=' | b';' => (Token::Mark(first), 1),
            b'$' => (Token::Omitted, 1),
            b'*' => (Token::Derived, 1),
            b'#' => {
                let digits = count(&rest[1..], |byte| byte.is_ascii_digit());
                let number = text(&rest[1..=digits]).parse();
                (Token::Instance(number.map_err(|_| self.error(start, "# and a number"))?), 1 + digits)
            }
            b'\'' => {
                let length = text_length(&rest[1..]).ok_or_else(|| self.error(start, "a text in '…'"))?;
                (Token::Text(&rest[1..=length]), length + 2)
            }
            b'"' => {
                let digits = count(&rest[1..], |byte| byte.is_ascii_hexdigit());
                if rest.get(1 + digits) != Some(&b'"') {
                    return Err(self.error(start, "hexadecimal digits in \"…\""));
                }
                (Token::Binary, digits + 2)
            }
            b'.' if !rest.get(1).is_some_and(u8::is_ascii_digit) => {
                let length = count(&rest[1..], is_name);
                if rest.get(1 + length) != Some(&b'.') {
                    return Err(self.error(start, "an enumeration in .….  or a number"));
                }
                (Token::Enumeration(text(&rest[1..=length])), length + 2)
            }
            b'+' | b'-' | b'.' | b'0'..=b'9' => {
                let length = 1 + count(&rest[1..], is_numeric);
                match text(&rest[..length]).parse::<f64>() {
                    Ok(number) if number.is_finite() => (Token::Number(number), length),
                    _ => return Err(self.error(start, "a finite number")),
                }
            }
            b'A'..=b'Z' | b'a'..=b'z' | b'_' | b'!' => {
                let length = 1 + count(&rest[1..], is_name);
                (Token::Keyword(text(&rest[..length])), length)
            }
            _ => return Err(self.error(start, "a token of ISO 10303-21")),
        };
        self.position += length;
        Ok(token)
    }

    /// Reads this mark.
    pub(in crate::step) fn mark(&mut self, mark: u8, expected: &str) -> Result<()> {
        let start = self.position;
        if self.token()? == Token::Mark(mark) { Ok(()) } else { Err(self.error(start, expected)) }
    }

    /// Moves behind the next occurrence of a word; returns false where the word does not follow.
    pub(in crate::step) fn skip_behind(&mut self, word: &[u8]) -> bool {
        let rest = &self.bytes[self.position..];
        let found = rest.windows(word.len()).position(|window| window == word);
        self.position += found.map_or(rest.len(), |found| found + word.len());
        found.is_some()
    }
}

fn count(bytes: &[u8], is_part: impl Fn(&u8) -> bool) -> usize {
    bytes.iter().position(|byte| !is_part(byte)).unwrap_or(bytes.len())
}

/// Whether a byte can stand in a name; `-` stands in those of the first and last line.
fn is_name(byte: &u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-')
}

fn is_numeric(byte: &u8) -> bool {
    byte.is_ascii_digit() || matches!(byte, b'.' | b'E' | b'e' | b'+' | b'-')
}

/// The bytes of names and numbers as text: they are ASCII.
fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap_or_default()
}

/// Returns the length of a text up to the apostrophe that ends it; two stand for one.
fn text_length(bytes: &[u8]) -> Option<usize> {
    let mut position = 0;
    loop {
        position += bytes[position..].iter().position(|&byte| byte == b'\'')?;
        if bytes.get(position + 1) != Some(&b'\'') {
            return Some(position);
        }
        position += 2;
    }
}
