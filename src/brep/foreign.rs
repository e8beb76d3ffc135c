//! Files of formats that are recognised by their content and not read.

use super::format;
use crate::error::Error;

/// The length of the text in which a signature of words is searched.
const HEAD_LENGTH: usize = 256;

const EXPORT_STEP: &str = "export it as STEP from the program that made it";
const TRIANGLES: &str =
    "it holds triangles, which are read by the ending of the file's name, as in `part.stl`";
const POINTS: &str = "it holds points, which are read by the ending of the file's name, as in `scan.las`";

/// The first bytes of formats, their names with an article, and the way to a file that is read.
const SIGNATURES: [(&[u8], &str, &str); 13] = [
    (b"**ABCDEFG", "a Parasolid file", EXPORT_STEP),
    (b"PS\0", "a Parasolid file", EXPORT_STEP),
    (b"ACIS BinaryFile", "an ACIS file", EXPORT_STEP),
    (b"ASM BinaryFile", "an ACIS file", EXPORT_STEP),
    (b"V5_CFV2", "a CATIA file", EXPORT_STEP),
    (b"\xd0\xcf\x11\xe0\xa1", "a SolidWorks, Inventor or other compound file", EXPORT_STEP),
    (b"AC10", "a DWG file", EXPORT_STEP),
    (b"Kaydara FBX", "an FBX file", "it holds triangles, not NURBS: export STEP instead"),
    (b"glTF", "a glTF file", TRIANGLES),
    (b"ply", "a PLY file", TRIANGLES),
    (b"solid ", "an STL file", TRIANGLES),
    (b"LASF", "a LAS or LAZ file", POINTS),
    (b"ASTM-E57", "an E57 file", POINTS),
];

/// Returns the error for bytes that are of no format that is read, or `None` if they are, or may be,
/// interchange JSON, which begins with `{`.
pub(super) fn foreign(bytes: &[u8], path: &str) -> Option<Error> {
    let unsupported = |found, advice: String| Some(Error::FormatUnsupported { found, advice });
    if bytes.is_empty() {
        return unsupported("an empty file", "choose another file".to_owned());
    }
    if format::is_rhino(bytes) {
        let advice = format!("`npx nurbs-hausdorff convert {path} model.json` converts it");
        return unsupported("a Rhino 3DM file", advice);
    }
    let archived = || "the feature `archives` of this crate reads it".to_owned();
    if format::is_gzip(bytes) {
        return unsupported("a file compressed by gzip", archived());
    }
    if format::is_zip(bytes) {
        return unsupported("a zip archive, as FreeCAD documents are", archived());
    }
    if format::is_json(bytes) {
        return None;
    }
    let known = SIGNATURES.iter().find(|(signature, ..)| bytes.starts_with(signature));
    let known = known.map(|&(_, found, advice)| (found, advice)).or_else(|| by_words(bytes));
    let (found, advice) = known.unwrap_or(("an unknown format", EXPORT_STEP));
    unsupported(found, advice.to_owned())
}

/// Returns the formats of text that begin with words rather than with fixed bytes.
fn by_words(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD_LENGTH)]);
    let mut words = head.split_ascii_whitespace();
    let first = [words.next()?, words.next().unwrap_or_default()];
    let line = head.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'))?;
    if first == ["0", "SECTION"] {
        return Some(("a DXF file", EXPORT_STEP));
    }
    if first[0] == "Version" && head.contains(" JT") {
        return Some(("a JT file", EXPORT_STEP));
    }
    // ACIS as text begins with its version and three more integers.
    let numbers = line.split_ascii_whitespace().take_while(|word| word.parse::<u32>().is_ok());
    if numbers.count() == 4 && line.split_ascii_whitespace().count() == 4 {
        return Some(("an ACIS file", EXPORT_STEP));
    }
    let object = ["v ", "o ", "mtllib "].iter().any(|word| line.starts_with(word));
    object.then_some(("an OBJ file", TRIANGLES))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    #[test]
    fn formats_are_named_by_how_they_begin() {
        let cases: [(&[u8], &str); 10] = [
            (b"", "an empty file"),
            (b"PS\0\0\0\x3f", "a Parasolid file"),
            (b"700 0 1 0\n16 Autodesk", "an ACIS file"),
            (b"Version 9.5 JT  DM", "a JT file"),
            (b"  0\nSECTION\n  2\nHEADER", "a DXF file"),
            (b"glTF\x02\0\0\0", "a glTF file"),
            (b"# Blender\nmtllib part.mtl\n", "an OBJ file"),
            (b"3D Geometry File Format        4", "a Rhino 3DM file"),
            (b"no model", "an unknown format"),
            (&[0xff, 0xfe, 0x00], "an unknown format"),
        ];
        for (bytes, name) in cases {
            let error = foreign(bytes, "part.x").unwrap();
            assert_eq!(error.code(), "FORMAT_UNSUPPORTED");
            assert!(error.to_string().contains(name), "{error}");
        }
        for json in ["{", "\u{feff} \n{\"surfaces\": 3"] {
            assert!(foreign(json.as_bytes(), "part.json").is_none());
        }
    }
}
