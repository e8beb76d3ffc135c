//! PLY in all three encodings.

use crate::soup::strip;
use crate::{MeshFormat, Soup};
use glam::DVec3;
use nurbs_hausdorff::Result;
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Property, PropertyAccess, PropertyAccessResult};
use std::borrow::Cow;
use std::io::Cursor;

const FORMAT: MeshFormat = MeshFormat::Ply;

/// The elements that are read before they are taken over: one takes several times the memory of a
/// vertex.
const ELEMENTS_AT_ONCE: usize = 1 << 16;

/// The last word of the header.
const HEADER_END: &[u8] = b"end_header";

/// The names of the list of a face's vertices.
const INDICES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// An element of any kind: the coordinates of a vertex, or the corners of a face or a strip.
#[derive(Default)]
struct Element {
    position: [Option<f64>; 3],
    corners: Option<Vec<i64>>,
}

impl PropertyAccess for Element {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let axis = match name {
            "x" => 0,
            "y" => 1,
            "z" => 2,
            name if INDICES.contains(&name) => {
                self.corners = corners(&property);
                return PropertyAccessResult::Set;
            }
            _ => return PropertyAccessResult::Ignored,
        };
        self.position[axis] = number(&property);
        PropertyAccessResult::Set
    }
}

fn number(property: &Property) -> Option<f64> {
    Some(match *property {
        Property::Char(value) => value.into(),
        Property::UChar(value) => value.into(),
        Property::Short(value) => value.into(),
        Property::UShort(value) => value.into(),
        Property::Int(value) => value.into(),
        Property::UInt(value) => value.into(),
        Property::Float(value) => value.into(),
        Property::Double(value) => value,
        _ => return None,
    })
}

fn corners(property: &Property) -> Option<Vec<i64>> {
    fn list<T: Copy + Into<i64>>(values: &[T]) -> Option<Vec<i64>> {
        Some(values.iter().map(|&value| value.into()).collect())
    }
    match property {
        Property::ListChar(values) => list(values),
        Property::ListUChar(values) => list(values),
        Property::ListShort(values) => list(values),
        Property::ListUShort(values) => list(values),
        Property::ListInt(values) => list(values),
        Property::ListUInt(values) => list(values),
        _ => None,
    }
}

/// The corners of faces or strips, which may stand before their vertices.
#[derive(Default)]
struct Corners {
    counts: Vec<u32>,
    corners: Vec<u32>,
}

/// Reads vertices, faces and strips of triangles, whose parts a negative index ends. Other elements with vertex
/// indices are named as left out.
///
/// # Errors
/// [`nurbs_hausdorff::Error::MeshSyntax`]; also of a file whose vertex indices all are of other elements.
pub(crate) fn read(bytes: &[u8]) -> Result<Soup> {
    let bytes = &with_ascii_header(bytes);
    let parser = Parser::<Element>::new();
    let error = |error: ply_rs_bw::parser::ParseError| FORMAT.syntax(error.to_string());
    let mut reader = Reader::new(Cursor::new(bytes.as_ref()));
    let header = parser.read_header(&mut reader).map_err(error)?;
    let mut soup = Soup::default();
    let [mut faces, mut strips] = [Corners::default(), Corners::default()];
    let mut unread = Vec::new();
    for element in header.elements.values() {
        // Every element takes at least a byte: the parser would make as many as the header says.
        if element.count > bytes.len() {
            return Err(
                FORMAT.syntax(format!("{} of element {:?}, more than bytes", element.count, element.name))
            );
        }
        let mut left = element.clone();
        while left.count > 0 {
            let count = left.count.min(ELEMENTS_AT_ONCE);
            let page = ElementDef { count, ..left.clone() };
            let list = parser.read_payload_for_element(&mut reader, &page, &header).map_err(error)?;
            left.count -= count;
            match element.name.as_str() {
                "vertex" => list.into_iter().try_for_each(|vertex| soup.push_vertex(&vertex))?,
                "face" => list.into_iter().try_for_each(|face| faces.push(face, |_| false))?,
                "tristrips" => list.into_iter().try_for_each(|strip| strips.push(strip, |at| at < 0))?,
                _ => {}
            }
        }
        let is_known = ["vertex", "face", "tristrips"].contains(&element.name.as_str());
        if !is_known && element.count > 0 && INDICES.iter().any(|name| element.properties.contains_key(*name))
        {
            unread.push((&element.name, element.count));
        }
        if element.name == "edge" && element.count > 0 {
            soup.note("edge", format!("{} edges are no surface", element.count));
        }
    }
    let end = usize::try_from(reader.get_ref().position()).unwrap_or(usize::MAX);
    soup.note_rest(bytes.get(end..).unwrap_or_default().trim_ascii().len());
    faces.parts().try_for_each(|face| soup.push_polygon(face, FORMAT))?;
    strips.parts().for_each(|corners| soup.triangles.extend(strip(corners)));
    for (name, count) in unread {
        let why = format!("{count} elements {name:?} with vertex indices, expected elements \"face\"");
        // Points alone are no cloud where a surface was meant.
        if soup.triangles.is_empty() {
            return Err(FORMAT.syntax(why));
        }
        soup.skip(name, why);
    }
    Ok(soup)
}

/// Returns the file with a question mark for each byte of its header that is no ASCII, if the header is no UTF-8:
/// comments have the code page of whoever wrote them, and lengths stay as they are.
fn with_ascii_header(bytes: &[u8]) -> Cow<'_, [u8]> {
    let end = bytes.windows(HEADER_END.len()).position(|window| window == HEADER_END).unwrap_or(0);
    if std::str::from_utf8(&bytes[..end]).is_ok() {
        return Cow::Borrowed(bytes);
    }
    let mut bytes = bytes.to_vec();
    bytes[..end].iter_mut().filter(|byte| !byte.is_ascii()).for_each(|byte| *byte = b'?');
    Cow::Owned(bytes)
}

impl Soup {
    fn push_vertex(&mut self, Element { position, .. }: &Element) -> Result<()> {
        let &[Some(x), Some(y), Some(z)] = position else {
            return Err(FORMAT.syntax("a vertex without x, y or z"));
        };
        self.vertices.push(DVec3::new(x, y, z));
        Ok(())
    }
}

impl Corners {
    /// Appends the corners of an element, in parts that end where an index says so.
    fn push(&mut self, Element { corners, .. }: Element, is_end: impl Fn(i64) -> bool) -> Result<()> {
        let corners = corners.ok_or_else(|| FORMAT.syntax("a face without vertex indices"))?;
        for part in corners.split(|&index| is_end(index)) {
            self.counts.push(part.len() as u32);
            for &index in part {
                let corner = u32::try_from(index);
                self.corners
                    .push(corner.map_err(|_| FORMAT.syntax(format!("a face with the vertex {index}")))?);
            }
        }
        Ok(())
    }

    fn parts(&self) -> impl Iterator<Item = &[u32]> {
        let mut rest = self.corners.as_slice();
        self.counts.iter().map(move |&count| {
            let (part, after) = rest.split_at(count as usize);
            rest = after;
            part
        })
    }
}
