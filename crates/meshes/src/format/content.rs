//! The format of a file by its content.

use super::MeshFormat;
use crate::surfaces::{off, stl};
use crate::vtk;

/// The bytes in which a signature is searched that comments or blanks may precede.
const HEAD_LENGTH: usize = 1024;

/// The numbers of a line of points.
const COORDINATES: usize = 3;

impl MeshFormat {
    /// Returns the format of bytes that begin, or are as long, as those of no other one.
    pub(super) fn of_signature(bytes: &[u8]) -> Option<Self> {
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
        let head = &text[..text.len().min(HEAD_LENGTH)];
        let has = |part: &[u8]| head.windows(part.len()).any(|window| window == part);
        Some(match () {
            () if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") => Self::Ply,
            () if bytes.starts_with(b"glTF") => Self::Gltf,
            () if bytes.starts_with(b"LASF") => Self::Las,
            () if bytes.starts_with(b"ASTM-E57") => Self::E57,
            () if is_package(bytes) => Self::ThreeMf,
            () if text.starts_with(vtk::LEGACY) => Self::Vtk,
            () if text.starts_with(b"<") && has(vtk::XML) && has(b"\"PolyData\"") => Self::Vtk,
            () if has(b"FIELDS") && has(b"DATA ") && (has(b".PCD") || has(b"VERSION")) => Self::Pcd,
            () if stl::is_binary(bytes) => Self::Stl,
            () if stl::is_text(bytes) && has_ignoring_case(head, b"facet") => Self::Stl,
            () if off::signature(bytes).is_some() => Self::Off,
            () if text.starts_with(b"{") && has(b"\"asset\"") => Self::Gltf,
            () if is_grid(head) => Self::Ptx,
            () => return None,
        })
    }

    /// Returns the format of text by its first lines of content: coordinates alone, or elements of OBJ.
    pub(super) fn of_lines(bytes: &[u8]) -> Option<Self> {
        let head = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD_LENGTH)]);
        let is_comment = |line: &str| line.is_empty() || line.starts_with('#') || line.starts_with("//");
        let mut lines = head.lines().map(str::trim).filter(|line| !is_comment(line));
        let first = lines.next()?;
        let mut words = first.split_whitespace();
        if ["v", "o", "g", "mtllib"].contains(&words.next()?) && words.next().is_some() {
            return Some(Self::Obj);
        }
        let are_numbers = |line: &str| {
            let numbers = line.split([',', ';', '\t', ' ']).filter(|word| !word.is_empty());
            let mut numbers = numbers.map(|word| word.parse::<f64>().is_ok());
            numbers.by_ref().take(COORDINATES).filter(|&is_number| is_number).count() == COORDINATES
        };
        // Names of columns or a number of points may stand before the points.
        let second = lines.next().is_some_and(are_numbers);
        (are_numbers(first) || second).then_some(Self::Text)
    }
}

/// Whether bytes are a zip archive with a model of 3MF, whose name stands at its end.
fn is_package(bytes: &[u8]) -> bool {
    /// The bytes of names at the end of an archive that are searched.
    const NAMES_LENGTH: usize = 1 << 16;
    let names = &bytes[bytes.len().saturating_sub(NAMES_LENGTH)..];
    bytes.starts_with(b"PK\x03\x04") && names.windows(6).any(|window| window == b".model")
}

/// Whether lines are those before the points of a scan in PTX: two whole numbers, four lines of three
/// numbers and four of four.
fn is_grid(head: &[u8]) -> bool {
    let head = String::from_utf8_lossy(head);
    let widths = head.lines().take(10).map(|line| {
        let words = line.split_ascii_whitespace().map(|word| word.parse::<f64>());
        words.take_while(Result::is_ok).count()
    });
    widths.eq([1, 1, 3, 3, 3, 3, 4, 4, 4, 4])
}

fn has_ignoring_case(head: &[u8], word: &[u8]) -> bool {
    head.windows(word.len()).any(|window| window.eq_ignore_ascii_case(word))
}
