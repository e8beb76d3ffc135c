//! The escapes of URIs.

/// Returns bytes with each `%` and two hexadecimal digits replaced by what they stand for.
pub(super) fn unescaped(text: &str) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let [byte, after @ ..] = rest {
        let digits = after.get(..2).and_then(|digits| std::str::from_utf8(digits).ok());
        match digits.and_then(|digits| u8::from_str_radix(digits, 16).ok()).filter(|_| *byte == b'%') {
            Some(escaped) => {
                bytes.push(escaped);
                rest = &after[2..];
            }
            None => {
                bytes.push(*byte);
                rest = after;
            }
        }
    }
    bytes
}

/// Returns the path that a relative URI stands for.
pub(super) fn path(uri: &str) -> String {
    let path = String::from_utf8_lossy(&unescaped(uri)).into_owned();
    path.trim_start_matches("./").to_owned()
}
