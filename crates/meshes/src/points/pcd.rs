//! PCD of the Point Cloud Library, as text, binary and compressed.

use crate::{MAX_BYTES, MeshFormat, Soup};
use glam::DVec3;
use nurbs_hausdorff::{Error, Result};

const FORMAT: MeshFormat = MeshFormat::Pcd;

/// The position and the orientation of a sensor that says nothing.
const NO_VIEWPOINT: [f64; 7] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];

/// A field of every point.
#[derive(Clone, Copy, Default)]
struct Field {
    size: usize,
    kind: u8,
    count: usize,
    /// The bytes of the fields before it, and their number of values.
    start: usize,
    place: usize,
}

/// The parts of a header that say where coordinates are.
#[derive(Default)]
struct Header<'a> {
    names: Vec<&'a str>,
    fields: Vec<Field>,
    points: Option<usize>,
    viewpoint: Vec<f64>,
    data: &'a str,
}

/// Reads the points whose coordinates are numbers: the others are places of a grid without a point.
///
/// # Errors
/// [`Error::MeshSyntax`]; [`Error::FileTooLarge`] for more than 1 GiB of points.
pub(crate) fn read(bytes: &[u8]) -> Result<Soup> {
    let (header, content) = Header::read(bytes)?;
    let axes = header.axes()?;
    let width: usize = header.fields.iter().map(|field| field.size * field.count).sum();
    let count = header.points.ok_or_else(|| FORMAT.syntax("no POINTS, expected their number"))?;
    let size = (count as u64).saturating_mul(width as u64);
    if size > MAX_BYTES {
        return Err(Error::FileTooLarge { found: size, expected: MAX_BYTES });
    }
    let mut soup = Soup::default();
    let mut push = |point: [f64; 3]| {
        if point.iter().any(|coordinate| coordinate.is_nan()) {
            return;
        }
        soup.vertices.push(DVec3::from_array(point));
    };
    let beyond =
        |found: usize| FORMAT.syntax(format!("{found} bytes of points, expected {size} for {count} points"));
    match header.data {
        "ascii" => read_text(content, count, axes.map(|axis| axis.place), &mut push)?,
        "binary" => {
            let records = content.get(..size as usize).ok_or_else(|| beyond(content.len()))?;
            for record in records.chunks_exact(width.max(1)) {
                push(axes.map(|axis| axis.number(record.get(axis.start..).unwrap_or(&[]))));
            }
        }
        "binary_compressed" => {
            let unpacked = unpacked(content, size as usize)?;
            // Compressed points are stored field by field.
            for index in 0..count {
                push(axes.map(|axis| {
                    let at = axis.start * count + index * axis.size * axis.count;
                    axis.number(unpacked.get(at..).unwrap_or(&[]))
                }));
            }
        }
        other => {
            return Err(FORMAT.syntax(format!("DATA {other:?}, expected ascii, binary or binary_compressed")));
        }
    }
    let missing = count - soup.vertices.len();
    if missing > 0 {
        soup.note("points", format!("{missing} of {count} have no coordinates and are no points"));
    }
    if !header.viewpoint.is_empty() && header.viewpoint != NO_VIEWPOINT {
        soup.note("VIEWPOINT", "the pose of the sensor does not move the points");
    }
    Ok(soup)
}

impl<'a> Header<'a> {
    /// Returns the header and the bytes after it.
    fn read(bytes: &'a [u8]) -> Result<(Self, &'a [u8])> {
        let mut header = Self::default();
        let [mut sizes, mut kinds, mut counts]: [Vec<&str>; 3] = Default::default();
        let mut rest = bytes;
        while header.data.is_empty() {
            let end = rest.iter().position(|&byte| byte == b'\n');
            let end = end.ok_or_else(|| FORMAT.syntax("the header ends before DATA"))?;
            let line = std::str::from_utf8(&rest[..end]).map_err(|error| FORMAT.syntax(error.to_string()))?;
            rest = &rest[end + 1..];
            let mut words = line.split_whitespace();
            let Some(word) = words.next().filter(|word| !word.starts_with('#')) else { continue };
            let values: Vec<&str> = words.collect();
            match word {
                "FIELDS" => header.names = values,
                "SIZE" => sizes = values,
                "TYPE" => kinds = values,
                "COUNT" => counts = values,
                "POINTS" => header.points = values.first().and_then(|value| value.parse().ok()),
                "VIEWPOINT" => {
                    header.viewpoint = values.iter().filter_map(|value| value.parse().ok()).collect()
                }
                "DATA" => header.data = values.first().copied().unwrap_or("nothing"),
                _ => {}
            }
        }
        let mut next = Field::default();
        for index in 0..header.names.len() {
            let size = sizes
                .get(index)
                .and_then(|size| size.parse().ok())
                .filter(|size| [1, 2, 4, 8].contains(size));
            let kind = kinds.get(index).and_then(|kind| kind.bytes().next());
            // A header without COUNT has one value a field.
            let count = counts.get(index).map_or(Some(1), |count| count.parse::<u16>().ok());
            let (Some(size), Some(kind), Some(count)) = (size, kind, count) else {
                let name: String = header.names[index].chars().take(32).collect();
                return Err(FORMAT.syntax(format!("field {name:?}, expected its SIZE, TYPE and COUNT")));
            };
            let field = Field { size, kind, count: usize::from(count), ..next };
            next = Field {
                start: next.start.saturating_add(size.saturating_mul(field.count)),
                place: next.place.saturating_add(field.count),
                ..field
            };
            header.fields.push(field);
        }
        Ok((header, rest))
    }

    /// Returns the fields of x, y and z.
    fn axes(&self) -> Result<[Field; 3]> {
        let mut axes = [Field::default(); 3];
        for (axis, name) in axes.iter_mut().zip(["x", "y", "z"]) {
            let found = self.names.iter().position(|found| *found == name).map(|index| self.fields[index]);
            *axis = found
                .filter(|field| field.count > 0)
                .ok_or_else(|| FORMAT.syntax(format!("no field {name:?}, expected x, y and z")))?;
        }
        Ok(axes)
    }
}

impl Field {
    /// Returns the number at the start of these bytes, NaN where they end before.
    fn number(&self, bytes: &[u8]) -> f64 {
        macro_rules! number {
            ($kind:ty) => {
                bytes.first_chunk().map_or(f64::NAN, |&bytes| <$kind>::from_le_bytes(bytes) as f64)
            };
        }
        match (self.kind, self.size) {
            (b'F', 4) => number!(f32),
            (b'F', 8) => number!(f64),
            (b'I', 1) => number!(i8),
            (b'I', 2) => number!(i16),
            (b'I', 4) => number!(i32),
            (b'I', 8) => number!(i64),
            (b'U', 1) => number!(u8),
            (b'U', 2) => number!(u16),
            (b'U', 4) => number!(u32),
            (b'U', 8) => number!(u64),
            _ => f64::NAN,
        }
    }
}

fn read_text(
    content: &[u8],
    count: usize,
    places: [usize; 3],
    push: &mut impl FnMut([f64; 3]),
) -> Result<()> {
    let text = String::from_utf8_lossy(content);
    let mut found = 0;
    for (index, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let number = |place: usize| words.get(place).and_then(|word| word.parse::<f64>().ok());
        let [Some(x), Some(y), Some(z)] = places.map(number) else {
            return Err(FORMAT.syntax(format!("line {} of the points: expected x, y and z", index + 1)));
        };
        push([x, y, z]);
        found += 1;
    }
    match found == count {
        true => Ok(()),
        false => Err(FORMAT.syntax(format!("{found} points, expected {count}"))),
    }
}

/// Returns what LZF compressed: its two sizes, then runs of bytes and copies of earlier ones.
fn unpacked(content: &[u8], expected: usize) -> Result<Vec<u8>> {
    let damaged = || FORMAT.syntax("compressed points that are damaged");
    let size = |at: usize| content.get(at..)?.first_chunk().map(|&bytes| u32::from_le_bytes(bytes) as usize);
    let (Some(packed), Some(stated)) = (size(0), size(4)) else { return Err(damaged()) };
    if stated != expected {
        return Err(FORMAT.syntax(format!("{stated} bytes of points, expected {expected}")));
    }
    let mut rest = content.get(8..8_usize.saturating_add(packed)).ok_or_else(damaged)?;
    let mut bytes = Vec::new();
    while let [control, after @ ..] = rest {
        let control = usize::from(*control);
        // Below 32 the number of bytes that follow, less one; else a length and a way back.
        if control < 32 {
            let run = after.get(..=control).ok_or_else(damaged)?;
            bytes.extend_from_slice(run);
            rest = &after[run.len()..];
        } else {
            let (length, after) = match (control >> 5, after) {
                (7, [more, after @ ..]) => (7 + usize::from(*more), after),
                (length, after) => (length, after),
            };
            let [low, after @ ..] = after else { return Err(damaged()) };
            let back = ((control & 31) << 8) + usize::from(*low) + 1;
            let start = bytes.len().checked_sub(back).ok_or_else(damaged)?;
            for at in start..start + length + 2 {
                bytes.push(bytes[at]);
            }
            rest = after;
        }
        if bytes.len() > expected {
            return Err(damaged());
        }
    }
    if bytes.len() == expected { Ok(bytes) } else { Err(damaged()) }
}
