//! Wavefront OBJ.

use crate::{MeshFormat, Soup};
use glam::DVec3;
use nurbs_hausdorff::Result;
use std::borrow::Cow;
use tobj::{LoadOptions, load_obj_buf};

const FORMAT: MeshFormat = MeshFormat::Obj;

/// The name that `tobj` gives to faces without an object or a group.
const NAMELESS: &str = "unnamed_object";

/// The coordinates of a vertex, which a weight and a colour may follow.
const COORDINATES: usize = 3;

/// The largest number of characters of a line in a message.
const SHOWN: usize = 60;

/// Reads the faces; lines and points are none, and are named with their number, as are surfaces by formulas.
///
/// # Errors
/// [`nurbs_hausdorff::Error::MeshSyntax`].
pub(crate) fn read(bytes: &[u8]) -> Result<Soup> {
    let options = LoadOptions { triangulate: false, ..LoadOptions::default() };
    // Materials do not change the shape.
    let no_materials = |_: &std::path::Path| Ok((Vec::new(), Default::default()));
    let mut soup = Soup::default();
    let kept = faces_alone(bytes, &mut soup)?;
    // Names and comments have the code page of whoever wrote them.
    let text = String::from_utf8_lossy(&kept);
    let (models, _) = load_obj_buf(&mut text.as_bytes(), &options, no_materials)
        .map_err(|error| FORMAT.syntax(error.to_string()))?;
    for tobj::Model { mesh, name } in models {
        soup.begin_group(Some(name).filter(|name| !name.is_empty() && name != NAMELESS));
        let first = soup.vertices.len() as u32;
        let positions = mesh.positions.chunks_exact(3);
        soup.vertices.extend(positions.map(|point| DVec3::new(point[0], point[1], point[2])));
        let mut indices = mesh.indices.iter().map(|&index| first.saturating_add(index));
        let counts: Vec<u32> =
            if mesh.face_arities.is_empty() { vec![3; mesh.indices.len() / 3] } else { mesh.face_arities };
        for count in counts {
            let corners: Vec<u32> = indices.by_ref().take(count as usize).collect();
            soup.push_polygon(&corners, FORMAT)?;
        }
    }
    Ok(soup)
}

/// Returns the text with continued lines joined, without comments behind numbers, and without lines, points and what
/// `tobj` takes for faces of them; these are noted. Surfaces and files that `tobj` ignores are named as left out.
///
/// # Errors
/// [`nurbs_hausdorff::Error::MeshSyntax`] for a vertex that is not finite, which may be one that no face has.
fn faces_alone(bytes: &[u8], soup: &mut Soup) -> Result<Vec<u8>> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = joined(bytes);
    let [mut lines, mut points, mut surfaces, mut files] = [0_usize; 4];
    let mut kept = Vec::with_capacity(text.len());
    for line in text.split_inclusive(|&byte| byte == b'\n') {
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let word = words.next().unwrap_or_default();
        if word == b"v" && words.take(COORDINATES).any(is_not_finite) {
            let shown: String = String::from_utf8_lossy(line).trim().chars().take(SHOWN).collect();
            return Err(FORMAT.syntax(format!("found {shown:?}, expected finite coordinates")));
        }
        match word {
            b"l" | b"curv" | b"cdc" => lines += 1,
            b"p" => points += 1,
            b"surf" | b"bzp" | b"bsp" | b"cdp" => surfaces += 1,
            b"call" => files += 1,
            word @ (b"v" | b"f" | b"fo") if word == b"fo" || line.contains(&b'#') => {
                let statement = line.split(|&byte| byte == b'#').next().unwrap_or_default();
                // `fo` is the older word for a face.
                kept.push(word[0]);
                kept.extend_from_slice(&statement.trim_ascii()[word.len()..]);
                kept.push(b'\n');
            }
            _ => kept.extend_from_slice(line),
        }
    }
    if lines > 0 {
        soup.note("l", format!("{lines} lines are no surface"));
    }
    if points > 0 {
        soup.note("p", format!("{points} elements of points are no surface"));
    }
    if surfaces > 0 {
        soup.skip("surf", format!("{surfaces} surfaces by formulas are not read"));
    }
    if files > 0 {
        soup.skip("call", format!("{files} other files that this one names are not read"));
    }
    Ok(kept)
}

/// Whether a word is a number that is NaN or infinite. Numbers of digits alone that are short are none.
fn is_not_finite(word: &[u8]) -> bool {
    let may_be = word.iter().any(u8::is_ascii_alphabetic) || word.len() > f64::MAX_10_EXP as usize;
    let number = || std::str::from_utf8(word).ok()?.parse::<f64>().ok();
    may_be && number().is_some_and(|number| !number.is_finite())
}

/// Returns the text with each line that ends with a backslash joined to the next one.
fn joined(bytes: &[u8]) -> Cow<'_, [u8]> {
    // A comment may end with the path of a folder.
    let continued = |line: &[u8]| line.trim_ascii_end().ends_with(b"\\") && !line.contains(&b'#');
    if !bytes.split(|&byte| byte == b'\n').any(continued) {
        return Cow::Borrowed(bytes);
    }
    let mut text = Vec::with_capacity(bytes.len());
    for line in bytes.split_inclusive(|&byte| byte == b'\n') {
        if continued(line) {
            let line = line.trim_ascii_end();
            text.extend_from_slice(&line[..line.len() - 1]);
            text.push(b' ');
        } else {
            text.extend_from_slice(line);
        }
    }
    Cow::Owned(text)
}
