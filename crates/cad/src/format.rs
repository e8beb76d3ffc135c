//! The format of a file by its content.

/// The bytes in which a text's signature is searched, behind comments.
const HEAD_LENGTH: usize = 1024;

/// The word with which a STEP file begins.
const STEP_SIGNATURE: &[u8] = b"ISO-10303-21";

/// The column, from 0, that names a line's section in IGES.
const IGES_SECTION_COLUMN: usize = 72;

/// Whether bytes are OpenCASCADE's BREP text.
pub(super) fn is_brep(bytes: &[u8]) -> bool {
    let text = bytes.trim_ascii_start();
    text.starts_with(b"DBRep_DrawableShape") || text.starts_with(b"CASCADE Topology V")
}

/// The mark of UTF-8 with which some programs begin a text.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Whether bytes begin as an object of JSON.
pub(super) fn is_json(bytes: &[u8]) -> bool {
    bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes).trim_ascii_start().starts_with(b"{")
}

/// Whether bytes are a STEP file.
pub(super) fn is_step(bytes: &[u8]) -> bool {
    let text = behind_comments(bytes);
    let head = &text[..text.len().min(HEAD_LENGTH)];
    head.windows(STEP_SIGNATURE.len()).any(|window| window == STEP_SIGNATURE)
}

/// Returns the text behind the comments and blanks with which a STEP file may begin, however long they are.
fn behind_comments(bytes: &[u8]) -> &[u8] {
    let mut text = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    loop {
        text = text.trim_ascii_start();
        let Some(comment) = text.strip_prefix(b"/*") else { return text };
        let Some(end) = comment.windows(2).position(|pair| pair == b"*/") else { return text };
        text = &comment[end + 2..];
    }
}

/// Whether bytes are what OpenCASCADE writes of a shape in binary.
pub(super) fn is_binary_brep(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"Open CASCADE Topology V")
}

/// Whether bytes are what Rhino writes.
pub(super) fn is_rhino(bytes: &[u8]) -> bool {
    bytes.starts_with(b"3D Geometry File Format")
}

/// Whether bytes are compressed by gzip.
pub(super) fn is_gzip(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0x1f, 0x8b])
}

/// Whether bytes are a zip archive, as FreeCAD's documents are.
pub(super) fn is_zip(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04")
}

/// Whether bytes are an IGES file, whose first line is of the start section, and numbered.
pub(super) fn is_iges(bytes: &[u8]) -> bool {
    let mark = bytes.get(IGES_SECTION_COLUMN..IGES_SECTION_COLUMN + 8);
    mark.is_some_and(|mark| {
        mark[0] == b'S'
            && mark[1..7].iter().all(|byte| matches!(byte, b' ' | b'0'..=b'9'))
            && mark[7].is_ascii_digit()
    })
}

/// Whether bytes are a CAD model of a format that is recognised.
#[must_use]
pub fn is_cad(bytes: &[u8]) -> bool {
    is_step(bytes) || is_iges(bytes) || is_rhino(bytes) || is_binary_brep(bytes) || is_brep(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of STEP may begin with comments of any length, in which its signature does not count alone.
    #[test]
    fn step_may_begin_with_long_comments() {
        let comment = format!("/* {} */", "licence ".repeat(1000));
        let text = |head: &str| format!("{head}\n{comment}\n{head}ISO-10303-21;\nHEADER;");
        for head in ["", "\n", "/**/", "/* * / */"] {
            assert!(is_step(text(head).as_bytes()));
        }
        assert!(is_step(format!("\u{feff}{}", text("")).as_bytes()));
        for other in ["", "/* open", "/* ISO-10303-21; */", &comment] {
            assert!(!is_step(other.as_bytes()), "{other}");
        }
    }
}
