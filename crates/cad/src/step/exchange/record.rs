//! An instance: its entities and their attributes.

use super::inherited::INHERITED;
use super::lexer::{Lexer, Token};
use super::{Found, text};
use crate::report::FaceFault;
use nurbs_hausdorff::Result;

/// An attribute.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::step) enum Value<'a> {
    Reference(u64),
    Number(f64),
    Text(&'a [u8]),
    Enumeration(&'a str),
    List(Vec<Self>),
    /// A value with the name of its type.
    Typed(&'a str, Vec<Self>),
    /// Left out, derived, or of a type that no geometry has.
    Nothing,
}

/// The deepest nesting of lists: control points of a surface have two levels.
const MAX_NESTING: usize = 16;

/// An instance of one entity, or of several that together are one object.
#[derive(Debug)]
pub(in crate::step) struct Record<'a> {
    pub(in crate::step) number: u64,
    parts: Vec<(&'a str, Vec<Value<'a>>)>,
}

impl<'a> Record<'a> {
    /// Parses `ENTITY(…)` or `(ENTITY(…) ENTITY(…))`.
    ///
    /// # Errors
    /// [`nurbs_hausdorff::Error::StepSyntax`].
    pub(in crate::step) fn parse(number: u64, lexer: &mut Lexer<'a>) -> Result<Self> {
        const EXPECTED: &str = "the name of an entity";
        let mut parts = Vec::new();
        let start = lexer.position();
        match lexer.token()? {
            Token::Keyword(name) => parts.push((name, attributes(lexer, 0)?)),
            Token::Mark(b'(') => loop {
                let start = lexer.position();
                match lexer.token()? {
                    Token::Keyword(name) => parts.push((name, attributes(lexer, 0)?)),
                    Token::Mark(b')') if !parts.is_empty() => break,
                    _ => return Err(lexer.error(start, EXPECTED)),
                }
            },
            _ => return Err(lexer.error(start, EXPECTED)),
        }
        Ok(Self { number, parts })
    }

    /// Returns the attributes of an entity of the instance.
    pub(in crate::step) fn part(&self, name: &str) -> Option<&[Value<'a>]> {
        self.parts.iter().find(|(part, _)| *part == name).map(|(_, values)| values.as_slice())
    }

    pub(in crate::step) fn has(&self, name: &str) -> bool {
        self.part(name).is_some()
    }

    /// Returns the names of the entities.
    pub(in crate::step) fn kind(&self) -> String {
        let names: Vec<&str> = self.parts.iter().map(|&(name, _)| name).collect();
        names.join(" ")
    }

    /// Returns the object as the simple instance of its most special entity, whose attributes
    /// follow those that it inherits.
    pub(in crate::step) fn simple(mut self) -> Entity<'a> {
        let number = self.number;
        if let [(kind, _)] = self.parts.as_slice() {
            let kind = (*kind).to_owned();
            let attributes = self.parts.pop().map(|(_, values)| values).unwrap_or_default();
            return Entity { number, kind, attributes, weights: None, location: None };
        }
        let leaf = INHERITED.iter().find(|(leaf, _)| self.has(leaf));
        let (kind, inherited) = match leaf {
            Some(&(leaf, inherited)) => (leaf.to_owned(), inherited),
            None => (self.kind(), &[] as &[&str]),
        };
        let mut take = |name: &str| {
            let part = self.parts.iter_mut().find(|(part, _)| *part == name);
            part.map(|(_, values)| std::mem::take(values))
        };
        let name = take("REPRESENTATION_ITEM").unwrap_or_else(|| vec![Value::Nothing]);
        let own: Vec<Value<'a>> = inherited.iter().filter_map(|part| take(part)).flatten().collect();
        let weights = take("RATIONAL_B_SPLINE_CURVE").or_else(|| take("RATIONAL_B_SPLINE_SURFACE"));
        let weights = weights.and_then(|values| values.into_iter().next());
        let location = take("REPOSITIONED_TESSELLATED_ITEM");
        let location = location.map(|values| values.into_iter().next().unwrap_or(Value::Nothing));
        Entity { number, kind, attributes: name.into_iter().chain(own).collect(), weights, location }
    }
}

/// Reads `( … )`.
fn attributes<'a>(lexer: &mut Lexer<'a>, nesting: usize) -> Result<Vec<Value<'a>>> {
    lexer.mark(b'(', "( before attributes")?;
    let mut values = Vec::new();
    loop {
        let start = lexer.position();
        let value = match lexer.token()? {
            Token::Mark(b')') if values.is_empty() => return Ok(values),
            Token::Instance(number) => Value::Reference(number),
            Token::Number(number) => Value::Number(number),
            Token::Text(text) => Value::Text(text),
            Token::Enumeration(name) => Value::Enumeration(name),
            Token::Omitted | Token::Derived | Token::Binary => Value::Nothing,
            _ if nesting == MAX_NESTING => return Err(lexer.error(start, "at most 16 nested lists")),
            Token::Keyword(name) => Value::Typed(name, attributes(lexer, nesting + 1)?),
            Token::Mark(b'(') => {
                *lexer = lexer.at(start);
                Value::List(attributes(lexer, nesting + 1)?)
            }
            _ => return Err(lexer.error(start, "an attribute")),
        };
        values.push(value);
        let start = lexer.position();
        match lexer.token()? {
            Token::Mark(b',') => {}
            Token::Mark(b')') => return Ok(values),
            _ => return Err(lexer.error(start, ", or ) behind an attribute")),
        }
    }
}

/// An instance as one entity.
#[derive(Debug)]
pub(in crate::step) struct Entity<'a> {
    pub(in crate::step) number: u64,
    pub(in crate::step) kind: String,
    attributes: Vec<Value<'a>>,
    /// The weights of a rational B-spline.
    pub(in crate::step) weights: Option<Value<'a>>,
    /// The placement of a tessellated item that is repositioned.
    pub(in crate::step) location: Option<Value<'a>>,
}

impl<'a> Entity<'a> {
    /// Returns an attribute, numbered from 0; an attribute that is not there is left out.
    pub(in crate::step) fn value(&self, index: usize) -> &Value<'a> {
        self.attributes.get(index).unwrap_or(&Value::Nothing)
    }

    /// Returns the fault of an attribute that is not `expected`.
    pub(in crate::step) fn fault(&self, index: usize, expected: &str) -> FaceFault {
        let why = format!("attribute {} of #{}, {}, is not {expected}", index + 1, self.number, self.kind);
        FaceFault::new("STEP_ATTRIBUTE", why)
    }

    /// Returns the fault of an entity that stands where `expected` is needed.
    pub(in crate::step) fn unknown(&self, expected: &str) -> FaceFault {
        FaceFault::new("STEP_ENTITY", format!("#{} is {}, expected {expected}", self.number, self.kind))
    }

    pub(in crate::step) fn reference(&self, index: usize) -> Found<u64> {
        match self.value(index) {
            Value::Reference(number) => Ok(*number),
            _ => Err(self.fault(index, "a reference")),
        }
    }

    pub(in crate::step) fn number(&self, index: usize) -> Found<f64> {
        number(self.value(index)).ok_or_else(|| self.fault(index, "a number"))
    }

    /// Returns an integer from 0 to `largest`.
    pub(in crate::step) fn count(&self, index: usize, largest: usize) -> Found<usize> {
        count(self.value(index), largest)
            .ok_or_else(|| self.fault(index, &format!("an integer, 0 to {largest}")))
    }

    /// Returns a logical value, also one in full, as some writers state it.
    pub(in crate::step) fn flag(&self, index: usize) -> Found<bool> {
        match self.value(index) {
            Value::Enumeration("T" | "TRUE") => Ok(true),
            Value::Enumeration("F" | "FALSE") => Ok(false),
            _ => Err(self.fault(index, ".T. or .F.")),
        }
    }

    pub(in crate::step) fn list(&self, index: usize) -> Found<&[Value<'a>]> {
        match self.value(index) {
            Value::List(values) => Ok(values),
            _ => Err(self.fault(index, "a list")),
        }
    }

    pub(in crate::step) fn references(&self, index: usize) -> Found<Vec<u64>> {
        let numbers = self.list(index)?.iter().map(reference).collect::<Option<Vec<u64>>>();
        numbers.ok_or_else(|| self.fault(index, "a list of references"))
    }

    /// Returns the references of all attributes, also those in lists of them.
    pub(in crate::step) fn all_references(&self) -> Vec<u64> {
        let in_value = |value: &Value<'a>| match value {
            Value::List(values) => values.iter().filter_map(reference).collect(),
            value => Vec::from_iter(reference(value)),
        };
        self.attributes.iter().flat_map(in_value).collect()
    }

    pub(in crate::step) fn numbers(&self, index: usize) -> Found<Vec<f64>> {
        numbers_of(self.value(index)).ok_or_else(|| self.fault(index, "a list of numbers"))
    }

    /// Returns the text of the first attribute, the name, unless it is empty.
    pub(in crate::step) fn name(&self) -> Option<String> {
        match self.value(0) {
            Value::Text(bytes) => Some(text::decoded(bytes)).filter(|name| !name.trim().is_empty()),
            _ => None,
        }
    }
}

pub(in crate::step) fn reference(value: &Value<'_>) -> Option<u64> {
    match value {
        Value::Reference(number) => Some(*number),
        _ => None,
    }
}

/// Returns the numbers of a list of them.
pub(in crate::step) fn numbers_of(value: &Value<'_>) -> Option<Vec<f64>> {
    match value {
        Value::List(values) => values.iter().map(number).collect(),
        _ => None,
    }
}

/// Returns a number, also one with the name of its type.
pub(in crate::step) fn number(value: &Value<'_>) -> Option<f64> {
    match value {
        Value::Number(number) => Some(*number),
        Value::Typed(_, values) => match values.as_slice() {
            [Value::Number(number)] => Some(*number),
            _ => None,
        },
        _ => None,
    }
}

/// Returns an integer from 0 to `largest`.
pub(in crate::step) fn count(value: &Value<'_>, largest: usize) -> Option<usize> {
    let number = number(value)?;
    (number >= 0.0 && number <= largest as f64 && number.fract() == 0.0).then_some(number as usize)
}
