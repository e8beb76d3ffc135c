//! Strings of an exchange file (ISO 10303-21, 6.4.3).

use super::code_pages::CodePage;

/// Returns a string with its directives replaced: `''`, `\\`, `\S\c` in the code page that `\P…\` names before it,
/// `\X\hh`, `\X2\…\X0\` and `\X4\…\X0\`. `\N\` and `\F\`, which begin a line and a page, become spaces. Digits that are
/// no whole character are U+FFFD, and what begins as a directive and is none stays. Bytes above ASCII are those of
/// UTF-8, else of ISO 8859-1.
pub(in crate::step) fn decoded(bytes: &[u8]) -> String {
    let raw = match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    };
    let mut text = String::with_capacity(raw.len());
    let mut page = CodePage::default();
    let mut rest = raw.as_str();
    while let Some(first) = rest.chars().next() {
        if let Some(after) = rest.strip_prefix("''") {
            text.push('\'');
            rest = after;
        } else if let Some(after) = directive(rest, &mut page, &mut text) {
            rest = after;
        } else {
            text.push(first);
            rest = &rest[first.len_utf8()..];
        }
    }
    text
}

/// Appends what a directive at the start of a text stands for, and returns what follows it; `None` if there is none.
fn directive<'a>(rest: &'a str, page: &mut CodePage, text: &mut String) -> Option<&'a str> {
    let rest = rest.strip_prefix('\\')?;
    if let Some(after) = rest.strip_prefix('\\') {
        text.push('\\');
        return Some(after);
    }
    let (name, after) = rest.split_once('\\')?;
    match *name.as_bytes() {
        [b'N' | b'F'] => text.push(' '),
        [b'P', letter] => *page = CodePage::of(letter)?,
        [b'S'] => {
            let low = after.chars().next()?;
            text.push(page.character(low)?);
            // An apostrophe is written twice.
            return after.strip_prefix("''").or_else(|| after.get(low.len_utf8()..));
        }
        [b'X'] => {
            text.push(char::from(u8::from_str_radix(hexadecimal(after.get(..2)?)?, 16).ok()?));
            return after.get(2..);
        }
        [b'X', b'2'] => return wide(after, 4, text),
        [b'X', b'4'] => return wide(after, 8, text),
        _ => return None,
    }
    Some(after)
}

/// Appends the characters of this many digits each up to `\X0\`.
fn wide<'a>(rest: &'a str, digits: usize, text: &mut String) -> Option<&'a str> {
    let (codes, after) = rest.split_once("\\X0\\")?;
    let codes = hexadecimal(codes)?;
    let mut units = Vec::new();
    for start in (0..codes.len()).step_by(digits) {
        let code = codes.get(start..start + digits).and_then(|digits| u32::from_str_radix(digits, 16).ok());
        match code {
            // Two of four digits each may be one character.
            Some(code) if digits == 4 => units.extend(u16::try_from(code)),
            code => {
                let character = code.and_then(char::from_u32).unwrap_or(char::REPLACEMENT_CHARACTER);
                units.extend_from_slice(character.encode_utf16(&mut [0; 2]));
            }
        }
    }
    text.push_str(&String::from_utf16_lossy(&units));
    Some(after)
}

/// Returns a text of hexadecimal digits alone.
fn hexadecimal(text: &str) -> Option<&str> {
    text.bytes().all(|byte| byte.is_ascii_hexdigit()).then_some(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directives_are_what_the_standard_says() {
        for (written, meant) in [
            (r"a''b\\c", r"a'b\c"),
            (r"\S\D\S\'' z", "Ä§ z"),
            (r"\PB\\S\3a\PE\\S\P\S\Q\PA\\S\3", "\u{142}a\u{430}\u{431}³"),
            (r"\PG\\S\a\PI\\S\}", "αı"),
            (r"\X\C4b", "Äb"),
            (r"\X2\03B103B2\X0\!", "αβ!"),
            (r"\X2\D83DDE00\X0\\X4\0001F600\X0\", "😀😀"),
            (r"one\N\two\F\three", "one two three"),
        ] {
            assert_eq!(decoded(written.as_bytes()), meant, "{written}");
        }
    }

    #[test]
    fn digits_that_are_no_character_are_seen() {
        for (written, meant) in [
            (r"a\X2\03B\X0\b", "a\u{fffd}b"),
            (r"\X2\03B103\X0\", "α\u{fffd}"),
            (r"\X4\0001F6\X0\", "\u{fffd}"),
            (r"\X4\00110000\X0\", "\u{fffd}"),
            (r"\X2\D83D\X0\", "\u{fffd}"),
        ] {
            assert_eq!(decoded(written.as_bytes()), meant, "{written}");
        }
        for kept in [r"C:\parts\new", r"\X2\03B1", r"\X2\+3B1\X0\", r"\X\+1", r"\PJ\", r"\S\", r"\"] {
            assert_eq!(decoded(kept.as_bytes()), kept);
        }
    }
}
