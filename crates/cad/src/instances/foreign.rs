//! Files of kinds that are recognised by their content and not read.

use crate::format;
use nurbs_hausdorff::Error;

/// The bytes in which a STEP file's schema is searched.
const HEADER_LENGTH: usize = 1 << 14;

/// The place of a tar archive's signature.
const TAR_SIGNATURE: usize = 257;

/// The length of the text in which a signature of words is searched.
const HEAD_LENGTH: usize = 256;

/// What to do with a file that another program can write as STEP.
const EXPORT: &str = "export it as STEP from the program that made it";

const TRIANGLES: &str =
    "it holds triangles, which are read by the ending of the file's name, as in `part.stl`";
const POINTS: &str = "it holds points, which are read by the ending of the file's name, as in `scan.las`";

/// The beginnings of files, their names with the article, and the way to a file that is read.
const BEGINNINGS: [(&[u8], &str, &str); 21] = [
    (b"version https://git-lfs", "a pointer of Git LFS", "fetch the file that it stands for: git lfs pull"),
    (b"\xff\xfe", "a text in UTF-16", "write it in ASCII or UTF-8"),
    (b"\xfe\xff", "a text in UTF-16", "write it in ASCII or UTF-8"),
    (b"\xfd7zXZ\0", "a file compressed by xz", "unpack it"),
    (b"7z\xbc\xaf", "a 7z archive", "unpack it"),
    (b"BZh", "a file compressed by bzip2", "unpack it"),
    (b"\x28\xb5\x2f\xfd", "a file compressed by zstd", "unpack it"),
    (b"Rar!", "a RAR archive", "unpack it"),
    (b"**ABCDEFG", "a Parasolid file", EXPORT),
    (b"PS\0", "a Parasolid file", EXPORT),
    (b"ACIS BinaryFile", "an ACIS file", EXPORT),
    (b"ASM BinaryFile", "an ACIS file", EXPORT),
    (b"V5_CFV2", "a CATIA file", EXPORT),
    (b"\xd0\xcf\x11\xe0\xa1", "a SolidWorks, Inventor or other compound file", EXPORT),
    (b"AC10", "a DWG file", EXPORT),
    (b"Kaydara FBX", "an FBX file", "it holds triangles, not NURBS: export STEP instead"),
    (b"glTF", "a glTF file", TRIANGLES),
    (b"ply", "a PLY file", TRIANGLES),
    (b"solid ", "an STL file", TRIANGLES),
    (b"LASF", "a LAS or LAZ file", POINTS),
    (b"ASTM-E57", "an E57 file", POINTS),
];

/// Returns the error for bytes that are of no kind that is known.
pub(crate) fn unknown() -> Error {
    Error::FormatUnsupported { found: "an unknown format", advice: EXPORT.to_owned() }
}

/// Returns the error that names a file of another kind, and the way to one that is read; `None` for others.
pub(crate) fn refused(bytes: &[u8], path: &str) -> Option<Error> {
    let (found, advice) = named(bytes, path)?;
    Some(Error::FormatUnsupported { found, advice })
}

fn named(bytes: &[u8], path: &str) -> Option<(&'static str, String)> {
    let archived = || "the feature `archives` of this crate reads it".to_owned();
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    if text.is_empty() {
        return Some(("an empty file", "write or fetch it again".to_owned()));
    }
    if format::is_rhino(bytes) {
        let advice = format!("`npx nurbs-hausdorff convert {path} model.json` converts it");
        return Some(("a Rhino 3DM file", advice));
    }
    if format::is_gzip(bytes) {
        return Some(("a file compressed by gzip", archived()));
    }
    if format::is_zip(bytes) {
        return Some(("a zip archive, as FreeCAD documents are", archived()));
    }
    if let Some((_, found, advice)) = BEGINNINGS.iter().find(|(beginning, ..)| bytes.starts_with(beginning)) {
        return Some((found, (*advice).to_owned()));
    }
    if bytes.get(TAR_SIGNATURE..).is_some_and(|rest| rest.starts_with(b"ustar")) {
        return Some(("a tar archive", "unpack it".to_owned()));
    }
    let begins =
        |word: &str| text.get(..word.len()).is_some_and(|head| head.eq_ignore_ascii_case(word.as_bytes()));
    if begins("<!doctype html") || begins("<html") {
        return Some(("a page in HTML", "fetch the file itself, and not the page that shows it".to_owned()));
    }
    of_step(&bytes[..bytes.len().min(HEADER_LENGTH)], path).or_else(|| by_words(bytes))
}

/// Returns the name of a relative of STEP.
fn of_step(head: &[u8], path: &str) -> Option<(&'static str, String)> {
    let upper = head.to_ascii_uppercase();
    let place = |word: &[u8]| upper.windows(word.len()).position(|window| window == word);
    if place(b"ISO_10303_28").is_some() || place(b"ISO-10303-28").is_some() {
        return Some(("a STEP file in XML (ISO 10303-28)", "write it as text of ISO 10303-21".to_owned()));
    }
    let is_step = upper.trim_ascii_start().starts_with(b"ISO-10303-21") || format::is_step(head);
    if !is_step {
        return None;
    }
    if !format::is_step(head) {
        let advice = "ISO 10303-21 has its keywords in upper case: write it again with another exporter";
        return Some(("a STEP file in lower case", advice.to_owned()));
    }
    let schema = &head[place(b"FILE_SCHEMA")?..];
    let quoted = schema.split(|&byte| byte == b'\'').nth(1)?;
    let name = String::from_utf8_lossy(quoted).into_owned();
    name.to_ascii_uppercase().starts_with("IFC").then(|| {
        let advice = format!(
            "its schema is {name}, and IfcConvert of IfcOpenShell writes its shapes as STEP: IfcConvert {path} model.stp"
        );
        ("an IFC file, as of buildings", advice)
    })
}

/// Returns the formats of text that begin with words rather than with fixed bytes.
fn by_words(bytes: &[u8]) -> Option<(&'static str, String)> {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD_LENGTH)]);
    let mut words = head.split_ascii_whitespace();
    let first = [words.next()?, words.next().unwrap_or_default()];
    let line = head.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'))?;
    if first == ["0", "SECTION"] {
        return Some(("a DXF file", EXPORT.to_owned()));
    }
    if first[0] == "Version" && head.contains(" JT") {
        return Some(("a JT file", EXPORT.to_owned()));
    }
    // ACIS as text begins with its version and three more integers.
    let numbers = line.split_ascii_whitespace().take_while(|word| word.parse::<u32>().is_ok());
    if numbers.count() == 4 && line.split_ascii_whitespace().count() == 4 {
        return Some(("an ACIS file", EXPORT.to_owned()));
    }
    let object = ["v ", "o ", "mtllib "].iter().any(|word| line.starts_with(word));
    object.then(|| ("an OBJ file", TRIANGLES.to_owned()))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    #[test]
    fn formats_are_named_by_how_they_begin() {
        let cases: [(&[u8], &str); 8] = [
            (b"", "an empty file"),
            (b"PS\0\0\0\x3f", "a Parasolid file"),
            (b"700 0 1 0\n16 Autodesk", "an ACIS file"),
            (b"Version 9.5 JT  DM", "a JT file"),
            (b"  0\nSECTION\n  2\nHEADER", "a DXF file"),
            (b"glTF\x02\0\0\0", "a glTF file"),
            (b"# Blender\nmtllib part.mtl\n", "an OBJ file"),
            (b"3D Geometry File Format        4", "a Rhino 3DM file"),
        ];
        for (bytes, name) in cases {
            let error = refused(bytes, "part.x").unwrap();
            assert_eq!(error.code(), "FORMAT_UNSUPPORTED");
            assert!(error.to_string().contains(name), "{error}");
        }
        for json in ["{", "\u{feff} \n{\"surfaces\": 3"] {
            assert!(refused(json.as_bytes(), "part.json").is_none());
        }
    }
}
