//! XML of VTK with the data of a surface (VTP): as text, in Base64 or raw, compressed by zlib or not.

use super::arrays::Type;
use super::{Cells, FORMAT, Part, index};
use crate::MAX_BYTES;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use glam::DVec3;
use nurbs_hausdorff::workspace::Budget;
use nurbs_hausdorff::{Error, Result};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

/// The element before data that stands at the end of the file.
const APPENDED: &[u8] = b"<AppendedData";

/// The name of the compressor that is read.
const ZLIB: &str = "vtkZLibDataCompressor";

/// The coding of data that is not text.
struct Coding<'a> {
    header: Type,
    is_big: bool,
    is_compressed: bool,
    /// The data at the end of the file, and whether it is Base64.
    appended: &'a [u8],
    is_appended_text: bool,
    budget: Budget,
}

/// An array as its element states it.
struct Array {
    kind: Type,
    format: String,
    offset: usize,
    name: String,
    text: String,
}

/// Reads the pieces of a file of the type `PolyData`.
///
/// # Errors
/// [`Error::MeshSyntax`]; [`Error::FileTooLarge`] for more than 1 GiB of content.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Part>> {
    let end = bytes.windows(APPENDED.len()).position(|window| window == APPENDED).unwrap_or(bytes.len());
    let text = String::from_utf8_lossy(&bytes[..end]);
    let mut coding = Coding::of_appended(&bytes[end..]);
    let mut reader = Reader::from_str(&text);
    let (mut parts, mut stated) = (Vec::new(), Vec::new());
    // The element that an array stands in, and the array that is read.
    let mut section = String::new();
    let mut array: Option<Array> = None;
    loop {
        match reader.read_event().map_err(|error| FORMAT.syntax(error.to_string()))? {
            Event::Start(element) => match element.local_name().as_ref() {
                "VTKFile" => coding.read(&element)?,
                "Piece" => {
                    stated.push(Stated::read(&element)?);
                    parts.push(Part::default());
                }
                "DataArray" => array = Some(Array::read(&element)?),
                name => name.clone_into(&mut section),
            },
            Event::Empty(element) if element.local_name().as_ref() == "DataArray" => {
                store(&mut parts, &section, Array::read(&element)?, &mut coding)?;
            }
            Event::Text(content) => {
                if let Some(array) = &mut array {
                    array.text.push_str(&content);
                }
            }
            Event::End(element) => match (element.local_name().as_ref(), array.take()) {
                ("DataArray", Some(array)) => store(&mut parts, &section, array, &mut coding)?,
                _ => section.clear(),
            },
            Event::Eof => {
                stated.iter().zip(&parts).try_for_each(|(stated, part)| stated.check(part))?;
                return Ok(parts);
            }
            _ => {}
        }
    }
}

/// The numbers that a piece states of its points and cells, each with what it is of.
struct Stated([(&'static str, Option<usize>); 3]);

impl Stated {
    fn read(piece: &BytesStart<'_>) -> Result<Self> {
        let mut counts = ["NumberOfPoints", "NumberOfPolys", "NumberOfStrips"].map(|name| (name, None));
        for (name, count) in &mut counts {
            *count = attribute(piece, name)?.and_then(|text| text.trim().parse().ok());
        }
        Ok(Self(counts))
    }

    /// Checks the numbers against what was read.
    ///
    /// # Errors
    /// [`Error::MeshSyntax`] with both numbers.
    fn check(&self, part: &Part) -> Result<()> {
        let found = [part.points.len(), part.polygons.len(), part.strips.len()];
        for (&(name, stated), found) in self.0.iter().zip(found) {
            if let Some(stated) = stated.filter(|&stated| stated != found) {
                return Err(FORMAT.syntax(format!("{found} by the arrays, expected {stated} by {name}")));
            }
        }
        Ok(())
    }
}

/// Puts the content of an array into the part that is read.
fn store(parts: &mut [Part], section: &str, array: Array, coding: &mut Coding<'_>) -> Result<()> {
    let Some(part) = parts.last_mut() else { return Ok(()) };
    let cells: &mut Cells = match section {
        "Points" => {
            let numbers = array.numbers(coding)?;
            part.points = numbers.as_chunks().0.iter().map(|&point| DVec3::from_array(point)).collect();
            return Ok(());
        }
        "Polys" => &mut part.polygons,
        "Strips" => &mut part.strips,
        "Lines" => &mut part.lines,
        _ => return Ok(()),
    };
    match array.name.as_str() {
        "connectivity" => cells.corners = array.numbers(coding)?.into_iter().map(index).collect(),
        "offsets" => cells.ends = array.numbers(coding)?.into_iter().map(|end| index(end) as usize).collect(),
        _ => {}
    }
    Ok(())
}

impl Array {
    fn read(element: &BytesStart<'_>) -> Result<Self> {
        let kind = attribute(element, "type")?.unwrap_or_default();
        let kind =
            Type::named(&kind).ok_or_else(|| FORMAT.syntax(format!("an array of the type {kind:?}")))?;
        Ok(Self {
            kind,
            format: attribute(element, "format")?.unwrap_or_else(|| "ascii".to_owned()),
            offset: attribute(element, "offset")?.and_then(|offset| offset.parse().ok()).unwrap_or(0),
            name: attribute(element, "Name")?.unwrap_or_default(),
            text: String::new(),
        })
    }

    fn numbers(&self, coding: &mut Coding<'_>) -> Result<Vec<f64>> {
        let bytes = match self.format.as_str() {
            "ascii" => {
                let words = self.text.split_ascii_whitespace();
                let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
                return numbers.ok_or_else(|| FORMAT.syntax(format!("array {:?} has words", self.name)));
            }
            "binary" => coding.unpacked(self.text.as_bytes(), true)?,
            "appended" => {
                let appended = coding.appended.get(self.offset..);
                let appended = appended.ok_or_else(|| FORMAT.syntax("an array beyond the appended data"))?;
                coding.unpacked(appended, coding.is_appended_text)?
            }
            other => return Err(FORMAT.syntax(format!("an array of the format {other:?}"))),
        };
        Ok(self.kind.numbers(&bytes, coding.is_big))
    }
}

impl<'a> Coding<'a> {
    /// Returns the coding of a file with this element of appended data, or none.
    fn of_appended(element: &'a [u8]) -> Self {
        let tag = element.iter().position(|&byte| byte == b'>').unwrap_or(0);
        // Data begins after an underscore.
        let start =
            element[tag..].iter().position(|&byte| byte == b'_').map_or(element.len(), |at| tag + at + 1);
        Self {
            header: UINT32,
            is_big: false,
            is_compressed: false,
            appended: &element[start..],
            is_appended_text: element[..tag].windows(6).any(|window| window == b"base64"),
            budget: Budget::new(MAX_BYTES),
        }
    }

    fn read(&mut self, element: &BytesStart<'_>) -> Result<()> {
        let is = |name: &str, value: &str| {
            Ok::<_, Error>(attribute(element, name)?.is_some_and(|found| found == value))
        };
        if !is("type", "PolyData")? {
            return Err(FORMAT.syntax("XML of another type, expected PolyData"));
        }
        self.is_big = is("byte_order", "BigEndian")?;
        if is("header_type", "UInt64")? {
            self.header.size = 8;
        }
        match attribute(element, "compressor")?.as_deref() {
            None | Some("") => {}
            Some(ZLIB) => self.is_compressed = true,
            Some(other) => {
                return Err(FORMAT.syntax(format!("data compressed by {other:?}, expected {ZLIB}")));
            }
        }
        Ok(())
    }

    /// Returns the content of data, which begins with its size or with those of its compressed blocks.
    /// Other data may follow.
    fn unpacked(&mut self, data: &[u8], is_text: bool) -> Result<Vec<u8>> {
        let first = |length: usize| match is_text {
            true => decoded(data, length),
            false => data.get(..length).map(<[u8]>::to_vec),
        };
        let ended = || FORMAT.syntax("data that ends early");
        let (header, is_big, width) = (self.header, self.is_big, self.header.size);
        let sizes = |place: usize, count: usize| -> Result<Vec<usize>> {
            let end = place.saturating_add(count).saturating_mul(width);
            let bytes = first(end).ok_or_else(ended)?;
            let numbers = header.numbers(&bytes[place * width..], is_big);
            Ok(numbers.into_iter().map(|size| size as usize).collect())
        };
        let count = sizes(0, 1)?.first().copied().unwrap_or(0);
        if !self.is_compressed {
            let bytes = first(count.saturating_add(width)).ok_or_else(ended)?;
            return self.budget.read(&bytes[width..], |found| FORMAT.syntax(found));
        }
        let blocks = sizes(3, count)?;
        let start = (3 + blocks.len()) * width;
        let length = blocks.iter().fold(start, |length, &size| length.saturating_add(size));
        let bytes = first(length).ok_or_else(ended)?;
        let mut rest = &bytes[start..];
        let mut content = Vec::new();
        for size in blocks {
            let (block, after) = rest.split_at(size);
            content.extend(self.budget.read(ZlibDecoder::new(block), |found| FORMAT.syntax(found))?);
            rest = after;
        }
        Ok(content)
    }
}

/// The type of sizes in files that do not state it.
const UINT32: Type = Type { kind: super::arrays::Kind::Unsigned, size: 4 };

/// Returns the first bytes of Base64, of which several codes, each padded, may follow each other; none if it
/// has fewer.
fn decoded(text: &[u8], length: usize) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut code = Vec::with_capacity(CODE);
    for byte in text.iter().filter(|byte| !byte.is_ascii_whitespace()) {
        if bytes.len() >= length {
            break;
        }
        code.push(*byte);
        if code.len() == CODE {
            bytes.extend(STANDARD.decode(&code).ok()?);
            code.clear();
        }
    }
    bytes.truncate(length);
    (bytes.len() == length).then_some(bytes)
}

/// The characters of Base64 that stand for three bytes.
const CODE: usize = 4;

/// Returns an attribute by its name.
fn attribute(element: &BytesStart<'_>, name: &str) -> Result<Option<String>> {
    for found in element.attributes() {
        let found = found.map_err(|error| FORMAT.syntax(error.to_string()))?;
        if found.key.local_name().as_ref() == name {
            return Ok(Some(found.value.clone().into_owned()));
        }
    }
    Ok(None)
}
