//! STL, binary and text.
//!
//! Text is read in float64, as its numbers may have more digits than float32 holds.

use crate::{MeshFormat, Soup};
use glam::DVec3;
use nurbs_hausdorff::Result;

/// The bytes before the triangles of a binary file: 80 of any content, and the number of triangles.
const HEADER: usize = 84;

/// The bytes of a triangle: a normal, three corners, and two bytes of any content.
const RECORD: usize = 50;

/// The start of the corners in a record.
const CORNERS: usize = 12;

const FORMAT: MeshFormat = MeshFormat::Stl;

/// Reads a binary file by its number of triangles, whatever follows them; else text.
///
/// # Errors
/// [`nurbs_hausdorff::Error::MeshSyntax`] with the line of text, or the sizes found and expected.
pub(crate) fn read(bytes: &[u8]) -> Result<Soup> {
    // Binary files may begin with `solid` too. The number of triangles decides: that of a text's
    // characters is that of a file of gigabytes.
    let count = bytes.get(HEADER - 4..HEADER).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    let length = count.map(|count| HEADER as u64 + RECORD as u64 * u64::from(count));
    match length.filter(|&length| length <= bytes.len() as u64) {
        Some(length) => {
            let mut soup = read_binary(&bytes[HEADER..length as usize]);
            let rest = bytes.len() as u64 - length;
            if rest > 0 {
                soup.note("end", format!("{rest} bytes after the last triangle are not read"));
            }
            Ok(soup)
        }
        None if is_text(bytes) => read_text(bytes),
        None => Err(FORMAT.syntax(match length {
            Some(length) => {
                format!("{} bytes, expected {length} by the number of triangles, or text", bytes.len())
            }
            None => format!("{} bytes, expected at least {HEADER}, or text", bytes.len()),
        })),
    }
}

/// The mark of UTF-8 that may precede text.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Returns bytes without the mark of UTF-8.
fn unmarked(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes)
}

/// Whether bytes begin with the word of STL as text, in any case.
pub(crate) fn is_text(bytes: &[u8]) -> bool {
    unmarked(bytes).trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
}

/// Whether the length of bytes is that of a binary file with triangles.
pub(crate) fn is_binary(bytes: &[u8]) -> bool {
    let count =
        bytes.get(HEADER - 4..HEADER).and_then(|count| count.try_into().ok()).map_or(0, u32::from_le_bytes);
    count > 0 && bytes.len() as u64 == HEADER as u64 + RECORD as u64 * u64::from(count)
}

fn read_binary(records: &[u8]) -> Soup {
    let mut soup = Soup::default();
    for (index, record) in records.chunks_exact(RECORD).enumerate() {
        let number = |place: usize| {
            let mut bytes = [0; 4];
            bytes.copy_from_slice(&record[place..place + 4]);
            f64::from(f32::from_le_bytes(bytes))
        };
        for corner in 0..3 {
            let place = CORNERS + 12 * corner;
            soup.vertices.push(DVec3::new(number(place), number(place + 4), number(place + 8)));
        }
        soup.triangles.push([0, 1, 2].map(|corner| 3 * index as u32 + corner));
    }
    soup
}

/// Reads text word by word: any white space parts words. A name is the rest of the line of `solid` or `endsolid`.
fn read_text(bytes: &[u8]) -> Result<Soup> {
    let text = String::from_utf8_lossy(unmarked(bytes));
    let mut soup = Soup::default();
    let mut ended = false;
    let mut words = text
        .lines()
        .enumerate()
        .flat_map(|(line, text)| text.split_ascii_whitespace().map(move |word| (line, text, word)))
        .peekable();
    while let Some((line, text, word)) = words.next() {
        let is = |name: &str| word.eq_ignore_ascii_case(name);
        let error = |found: String| FORMAT.syntax(format!("line {}: {found}", line + 1));
        if is("vertex") {
            let mut numbers = Vec::with_capacity(3);
            while let Some(number) = words.peek().and_then(|(_, _, word)| word.parse().ok()) {
                numbers.push(number);
                words.next();
            }
            let &[x, y, z] = numbers.as_slice() else {
                return Err(error("a vertex that is not three numbers".to_owned()));
            };
            soup.vertices.push(DVec3::new(x, y, z));
        } else if is("endloop") {
            let first = 3 * soup.triangles.len();
            if soup.vertices.len() != first + 3 {
                return Err(error(format!(
                    "a loop of {} vertices",
                    soup.vertices.len().saturating_sub(first)
                )));
            }
            soup.triangles.push([0, 1, 2].map(|corner| first as u32 + corner));
        } else if is("facet") {
            // The normal follows from the corners, whatever stands for its numbers.
            let is_normal = |&(at, _, word): &(usize, &str, &str)| {
                let is = |name: &str| word.eq_ignore_ascii_case(name);
                let is_next = is("outer") || is("vertex") || is("endfacet");
                !is_next && (at == line || is("normal") || word.parse::<f64>().is_ok())
            };
            while words.next_if(is_normal).is_some() {}
        } else if is("solid") {
            ended = false;
            let is_name = |&(at, _, word): &(usize, &str, &str)| {
                at == line && !["facet", "endsolid"].into_iter().any(|next| word.eq_ignore_ascii_case(next))
            };
            while words.next_if(is_name).is_some() {}
        } else if is("endsolid") {
            ended = true;
            // A name may have the word `solid`: one begins in this line only if it ends there, too.
            let ends = text.split_ascii_whitespace().filter(|word| word.eq_ignore_ascii_case("endsolid"));
            let begins_next = ends.count() > 1;
            let is_name = |&(at, _, word): &(usize, &str, &str)| {
                let begins = |next: &str| word.eq_ignore_ascii_case(next);
                at == line && !begins("facet") && !(begins_next && begins("solid"))
            };
            while words.next_if(is_name).is_some() {}
        } else if !["outer", "loop", "endfacet"].into_iter().any(is) {
            return Err(error(format!("found {:?}", word.chars().take(32).collect::<String>())));
        }
    }
    if !ended || soup.vertices.len() != 3 * soup.triangles.len() {
        return Err(FORMAT.syntax("the text ends before endsolid"));
    }
    Ok(soup)
}
