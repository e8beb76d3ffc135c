//! Strings of an exchange file (ISO 10303-21, 6.4.3).

/// Returns a string with its escapes replaced: `''`, `\\`, `\S\c`, `\X\hh`, `\X2\…\X0\` and
/// `\X4\…\X0\`. Bytes above ASCII are those of UTF-8, else of ISO 8859-1.
pub(in crate::brep::step) fn decoded(bytes: &[u8]) -> String {
    let raw = match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    };
    let mut text = String::with_capacity(raw.len());
    let mut rest = raw.as_str();
    while let Some(first) = rest.chars().next() {
        if let Some(after) = rest.strip_prefix("''") {
            text.push('\'');
            rest = after;
        } else if let Some((piece, after)) = escape(rest) {
            text.push_str(&piece);
            rest = after;
        } else {
            text.push(first);
            rest = &rest[first.len_utf8()..];
        }
    }
    text
}

/// Returns the meaning of an escape at the start of a text, and what follows it.
fn escape(text: &str) -> Option<(String, &str)> {
    if let Some(after) = text.strip_prefix("\\\\") {
        return Some(("\\".to_owned(), after));
    }
    if let Some(after) = text.strip_prefix("\\S\\") {
        let letter = after.chars().next().filter(char::is_ascii)?;
        return Some((char::from(letter as u8 | 0x80).to_string(), &after[1..]));
    }
    if let Some(after) = text.strip_prefix("\\X\\") {
        let code = u8::from_str_radix(after.get(..2)?, 16).ok()?;
        return Some((char::from(code).to_string(), &after[2..]));
    }
    let digits = match text.get(..4)? {
        "\\X2\\" => 4,
        "\\X4\\" => 8,
        _ => return None,
    };
    let (codes, after) = text[4..].split_once("\\X0\\")?;
    let mut units = Vec::new();
    for chunk in codes.as_bytes().chunks(digits) {
        let code = u32::from_str_radix(std::str::from_utf8(chunk).ok()?, 16).ok()?;
        match u16::try_from(code) {
            Ok(unit) => units.push(unit),
            Err(_) => units.extend(char::from_u32(code)?.encode_utf16(&mut [0; 2]).iter().copied()),
        }
    }
    Some((String::from_utf16_lossy(&units), after))
}
