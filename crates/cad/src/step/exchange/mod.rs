//! The instances of an exchange file by their numbers.

mod code_pages;
mod inherited;
mod lexer;
mod record;
mod text;

pub(super) use record::{Entity, Record, Value, count, number, numbers_of, reference};
pub(super) use text::decoded;

use crate::report::FaceFault;
use lexer::{Lexer, Token};
use nurbs_hausdorff::Result;
use std::collections::HashMap;

/// The result of reading an instance.
pub(in crate::step) type Found<T> = std::result::Result<T, FaceFault>;

/// The word with which a file begins.
const FIRST_WORD: &str = "ISO-10303-21";

/// A file whose instances are found by number and parsed when they are needed, so that its
/// memory is little more than that of the text.
pub(super) struct Exchange<'a> {
    lexer: Lexer<'a>,
    positions: HashMap<u64, Position>,
    /// The numbers in the order of the file.
    pub(super) numbers: Vec<u64>,
}

/// The place behind the equals sign of an instance.
#[derive(Debug, Clone, Copy)]
struct Position {
    start: usize,
    /// Whether another instance of the file has the same number.
    repeated: bool,
}

impl<'a> Exchange<'a> {
    /// Finds the instances, and checks that every token is one and that parentheses close.
    /// O(length).
    ///
    /// # Errors
    /// [`nurbs_hausdorff::Error::StepSyntax`] with the line, also for a file that ends early.
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let mut lexer = Lexer::new(bytes);
        section(&mut lexer, |word| word == FIRST_WORD)?;
        let mut exchange = Self { lexer: lexer.clone(), positions: HashMap::new(), numbers: Vec::new() };
        loop {
            const SECTIONS: [&str; 6] =
                ["HEADER", "DATA", "ANCHOR", "REFERENCE", "SIGNATURE", "END-ISO-10303-21"];
            match section(&mut lexer, |word| SECTIONS.contains(&word))? {
                "DATA" => exchange.data(&mut lexer)?,
                "END-ISO-10303-21" => return exchange.ended(&mut lexer),
                _ => {
                    let start = lexer.position();
                    if !lexer.skip_behind(b"ENDSEC") {
                        return Err(lexer.error(start, "a section that ends with ENDSEC"));
                    }
                    lexer.mark(b';', "; behind ENDSEC")?;
                }
            }
        }
    }

    /// Returns the file, behind whose end no other one may stand: its instances would be lost. A signature may.
    fn ended(self, lexer: &mut Lexer<'a>) -> Result<Self> {
        let start = lexer.position();
        if !lexer.skip_behind(FIRST_WORD.as_bytes()) {
            return Ok(self);
        }
        let second = (lexer.position() - FIRST_WORD.len()).max(start);
        Err(lexer.error(second, "one file; behind its end another one begins"))
    }

    /// Reads a section of data behind its keyword.
    fn data(&mut self, lexer: &mut Lexer<'a>) -> Result<()> {
        const EXPECTED: &str = "an instance, # and its number, or ENDSEC";
        loop {
            let start = lexer.position();
            match lexer.token()? {
                Token::Instance(number) => {
                    lexer.mark(b'=', "= behind the number of an instance")?;
                    let position = Position { start: lexer.position(), repeated: false };
                    skip_statement(lexer)?;
                    self.numbers.push(number);
                    let entry = self.positions.entry(number);
                    entry.and_modify(|other| other.repeated = true).or_insert(position);
                }
                Token::Keyword("ENDSEC") => return lexer.mark(b';', "; behind ENDSEC"),
                _ => return Err(lexer.error(start, EXPECTED)),
            }
        }
    }

    /// Parses an instance. O(its length).
    ///
    /// # Errors
    /// `STEP_REFERENCE` if the file defines no instance of this number, or several;
    /// `STEP_SYNTAX`.
    pub(super) fn record(&self, number: u64) -> Found<Record<'a>> {
        let Some(position) = self.positions.get(&number) else {
            let why = format!("#{number} is referred to, and not defined");
            return Err(FaceFault::new("STEP_REFERENCE", why));
        };
        if position.repeated {
            return Err(FaceFault::new("STEP_REFERENCE", format!("#{number} is defined more than once")));
        }
        Record::parse(number, &mut self.lexer.at(position.start))
            .map_err(|error| FaceFault::new("STEP_SYNTAX", format!("#{number}, {error}")))
    }

    /// Parses an instance as one entity, as [`Self::record`] does.
    pub(super) fn entity(&self, number: u64) -> Found<Entity<'a>> {
        Ok(self.record(number)?.simple())
    }

    /// Returns the name of an instance's entity without parsing its attributes; the first of
    /// a complex instance; empty without such a part.
    pub(super) fn keyword(&self, number: u64) -> &'a str {
        let Some(position) = self.positions.get(&number) else { return "" };
        let mut lexer = self.lexer.at(position.start);
        match lexer.token() {
            Ok(Token::Keyword(word)) => word,
            Ok(Token::Mark(b'(')) => match lexer.token() {
                Ok(Token::Keyword(word)) => word,
                _ => "",
            },
            _ => "",
        }
    }
}

/// Reads a keyword that `is_known` accepts, its parameters and the semicolon.
fn section<'a>(lexer: &mut Lexer<'a>, is_known: impl Fn(&str) -> bool) -> Result<&'a str> {
    let start = lexer.position();
    match lexer.token()? {
        Token::Keyword(word) if is_known(word) => {
            skip_statement(lexer)?;
            Ok(word)
        }
        _ => Err(lexer.error(start, "ISO-10303-21, a section or END-ISO-10303-21")),
    }
}

/// Reads up to the semicolon that ends a statement.
fn skip_statement(lexer: &mut Lexer<'_>) -> Result<()> {
    let mut depth = 0_usize;
    loop {
        let start = lexer.position();
        match lexer.token()? {
            Token::Mark(b'(') => depth += 1,
            Token::Mark(b')') if depth > 0 => depth -= 1,
            Token::Mark(b';') if depth == 0 => return Ok(()),
            Token::Mark(b')' | b';' | b'=') | Token::End => {
                return Err(lexer.error(start, "the rest of a statement, which ends with ;"));
            }
            _ => {}
        }
    }
}
