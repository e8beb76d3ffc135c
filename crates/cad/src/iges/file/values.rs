//! Values in free format: numbers, Hollerith strings and what is left out.

/// A value between delimiters.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::iges) enum Value {
    Number(f64),
    Text(String),
    /// Left out, so that its default stands.
    Omitted,
    /// Neither a number nor a string.
    Other,
}

/// The characters that end a value and a record.
#[derive(Debug, Clone, Copy)]
pub(super) struct Delimiters {
    pub(super) value: u8,
    pub(super) record: u8,
}

/// The reason for which a record cannot be parsed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unended {
    /// The text ends before the record does.
    Record,
    /// A string ends behind the text.
    Text,
}

/// Reads the values up to the end of a record. O(length).
///
/// # Errors
/// [`Unended`] if the record or a string in it does not end.
pub(super) fn values(bytes: &[u8], delimiters: Delimiters) -> Result<Vec<Value>, Unended> {
    let mut values = Vec::new();
    let mut rest = bytes;
    loop {
        let (value, after) = value(rest, delimiters)?;
        values.push(value);
        let Some((&end, next)) = after.split_first() else { return Err(Unended::Record) };
        if end == delimiters.record {
            return Ok(values);
        }
        rest = next;
    }
}

/// Reads a value; returns what follows it, which begins with a delimiter.
fn value(bytes: &[u8], delimiters: Delimiters) -> Result<(Value, &[u8]), Unended> {
    let start = bytes.trim_ascii_start();
    let digits = start.iter().take_while(|byte| byte.is_ascii_digit()).count();
    if digits > 0 && start.get(digits) == Some(&b'H') {
        let length = std::str::from_utf8(&start[..digits]).ok().and_then(|digits| digits.parse().ok());
        let text = length.and_then(|length: usize| start[digits + 1..].get(..length)).ok_or(Unended::Text)?;
        let after = &start[digits + 1 + text.len()..];
        let blanks = after.len() - after.trim_ascii_start().len();
        return Ok((Value::Text(String::from_utf8_lossy(text).into_owned()), &after[blanks..]));
    }
    let is_end = |byte: &u8| *byte == delimiters.value || *byte == delimiters.record;
    let length = bytes.iter().position(is_end).ok_or(Unended::Record)?;
    let (text, after) = bytes.split_at(length);
    let text = text.trim_ascii();
    let value = match number(text) {
        _ if text.is_empty() => Value::Omitted,
        Some(number) => Value::Number(number),
        None => Value::Other,
    };
    Ok((value, after))
}

/// Reads a number, whose exponent may be that of Fortran's double precision.
fn number(text: &[u8]) -> Option<f64> {
    if !text.iter().all(|byte| byte.is_ascii_digit() || b"+-.EeDd".contains(byte)) {
        return None;
    }
    let text = std::str::from_utf8(text).ok()?.replace(['D', 'd'], "E");
    text.parse().ok().filter(|number: &f64| number.is_finite())
}
