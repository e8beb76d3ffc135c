//! OFF of Geomview, as text.

use crate::{MeshFormat, Soup};
use glam::DVec3;
use nurbs_hausdorff::{Error, Result};

const FORMAT: MeshFormat = MeshFormat::Off;

/// The prefixes of the word `OFF` that add values after the coordinates of a vertex: texture
/// coordinates, colours and normals.
const PREFIXES: [&str; 3] = ["ST", "C", "N"];

/// The largest number of characters of a line in a message.
const SHOWN: usize = 60;

/// Returns the word of the first line if it is that of OFF, with the prefixes that it has.
pub(crate) fn signature(bytes: &[u8]) -> Option<&str> {
    let bytes = bytes.trim_ascii_start();
    let end = bytes.iter().position(u8::is_ascii_whitespace).unwrap_or(bytes.len()).min(SHOWN);
    let word = std::str::from_utf8(bytes.get(..end)?).ok()?;
    let mut prefix = word.strip_suffix("OFF")?;
    for known in PREFIXES.into_iter().chain(["4", "n"]) {
        prefix = prefix.strip_prefix(known).unwrap_or(prefix);
    }
    prefix.is_empty().then_some(word)
}

/// Reads the faces, or the vertices alone as a cloud. Values after the coordinates of a vertex and after the
/// corners of a face change no shape.
///
/// # Errors
/// [`Error::MeshSyntax`] with the line; also of binary files and those of another dimension than three.
pub(crate) fn read(bytes: &[u8]) -> Result<Soup> {
    let text = String::from_utf8_lossy(bytes);
    let content = text.lines().map(|line| line.split('#').next().unwrap_or("").trim());
    let mut lines = content.enumerate().filter(|(_, line)| !line.is_empty());
    // The first word may be left out, and may stand before the counts.
    let mut first = lines.next().ok_or_else(|| FORMAT.syntax("an empty file"))?;
    if let Some(word) = signature(first.1.as_bytes()) {
        if word.contains(['4', 'n']) || first.1.contains("BINARY") {
            return Err(refused(first, "three coordinates a vertex, as text"));
        }
        first.1 = first.1[word.len()..].trim();
        if first.1.is_empty() {
            first = lines.next().ok_or_else(|| FORMAT.syntax("no counts"))?;
        }
    }
    let counts: Vec<usize> = first.1.split_whitespace().map_while(|word| word.parse().ok()).collect();
    let &[vertices, faces, ..] = counts.as_slice() else {
        return Err(refused(first, "the numbers of vertices and faces"));
    };
    let mut soup = Soup::default();
    let ended = |what: &str, found: usize, expected: usize| {
        FORMAT.syntax(format!("{found} {what}, expected {expected}"))
    };
    for found in 0..vertices {
        let line = lines.next().ok_or_else(|| ended("vertices", found, vertices))?;
        let mut numbers = line.1.split_whitespace().map_while(|word| word.parse::<f64>().ok());
        let (Some(x), Some(y), Some(z)) = (numbers.next(), numbers.next(), numbers.next()) else {
            return Err(refused(line, "three coordinates"));
        };
        soup.vertices.push(DVec3::new(x, y, z));
    }
    let mut corners = Vec::new();
    for found in 0..faces {
        let line = lines.next().ok_or_else(|| ended("faces", found, faces))?;
        let mut words = line.1.split_whitespace();
        let count = words.next().and_then(|word| word.parse::<usize>().ok());
        corners.clear();
        corners.extend(words.take(count.unwrap_or(0)).map_while(|word| word.parse::<u32>().ok()));
        if count != Some(corners.len()) {
            return Err(refused(line, "the number of corners and their vertices"));
        }
        // Faces of one and two corners are points and lines.
        match corners.len() {
            0..=2 => soup.note("faces", "faces of one or two corners are no surface"),
            _ => soup.push_polygon(&corners, FORMAT)?,
        }
    }
    soup.note_rest(lines.map(|(_, line)| line.len()).sum());
    Ok(soup)
}

fn refused((index, line): (usize, &str), expected: &str) -> Error {
    let shown: String = line.chars().take(SHOWN).collect();
    FORMAT.syntax(format!("line {}: found {shown:?}, expected {expected}", index + 1))
}
