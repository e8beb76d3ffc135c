//! Points as text: XYZ, PTS and CSV.

use super::{MeshFormat, Soup};
use crate::error::Result;
use glam::DVec3;

const FORMAT: MeshFormat = MeshFormat::Text;

/// Reads the points of all lines: their first three numbers or, after a line that names columns
/// x, y and z, the numbers of those. Lines that begin with `#` or `//` are comments; a line of one
/// number, as PTS has it, is the number of the points that follow.
pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    let text = std::str::from_utf8(bytes).map_err(|error| FORMAT.syntax(error.to_string()))?;
    let mut columns = [0, 1, 2];
    let mut soup = Soup::default();
    let mut expected: Option<usize> = None;
    for (index, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') || line.starts_with("//") {
            continue;
        }
        let words: Vec<&str> = words(line).collect();
        if soup.vertices.is_empty()
            && let Some(found) = named_columns(&words)
        {
            columns = found;
            continue;
        }
        if let ([count], true) = (words.as_slice(), soup.vertices.is_empty())
            && let Ok(count) = count.parse()
        {
            expected = Some(count);
            continue;
        }
        let number = |column: usize| words.get(column).and_then(|word| word.parse::<f64>().ok());
        let [Some(x), Some(y), Some(z)] = columns.map(number) else {
            return Err(FORMAT.syntax(format!("line {}: found no three coordinates", index + 1)));
        };
        soup.vertices.push(DVec3::new(x, y, z));
    }
    if let Some(expected) = expected.filter(|&expected| expected != soup.vertices.len()) {
        return Err(FORMAT.syntax(format!("{} points, expected {expected}", soup.vertices.len())));
    }
    Ok(soup)
}

/// Returns the words of a line, which commas, semicolons, tabs or blanks separate.
fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split([',', ';', '\t', ' '])
        .map(|word| word.trim().trim_matches('"'))
        .filter(|word| !word.is_empty())
}

/// Returns the columns named x, y and z, in any case.
fn named_columns(words: &[&str]) -> Option<[usize; 3]> {
    let column = |name: &str| words.iter().position(|word| word.eq_ignore_ascii_case(name));
    Some([column("x")?, column("y")?, column("z")?])
}
