//! VTK's surfaces: the legacy format and XML (VTP).

mod arrays;
mod legacy;
mod xml;

use super::soup::strip;
use super::{MeshFormat, Soup};
use glam::DVec3;
use nurbs_hausdorff::Result;

const FORMAT: MeshFormat = MeshFormat::Vtk;

/// The first words of a legacy file.
pub(super) const LEGACY: &[u8] = b"# vtk DataFile";

/// The beginning of the element that XML of VTK has.
pub(super) const XML: &[u8] = b"<VTKFile";

/// Reads polygons and strips of triangles, or, without them and without lines, the points as a cloud.
///
/// # Errors
/// [`nurbs_hausdorff::Error::MeshSyntax`]; also of datasets that are no surface, by their names.
pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    let mut soup = Soup::default();
    let parts = match bytes.starts_with(LEGACY) {
        true => vec![legacy::read(bytes)?],
        false => xml::read(bytes)?,
    };
    let mut lines = 0;
    for part in parts {
        lines += part.lines.len();
        part.append(&mut soup)?;
    }
    if lines > 0 && soup.triangles.is_empty() {
        return Err(FORMAT.syntax(format!("{lines} lines and no polygons, expected a surface or points")));
    }
    if lines > 0 {
        soup.note("lines", format!("{lines} lines are no surface"));
    }
    Ok(soup)
}

/// Cells: lists of points, one after the other.
#[derive(Default)]
struct Cells {
    /// The end of each cell in the list of all corners.
    ends: Vec<usize>,
    corners: Vec<u32>,
}

impl Cells {
    fn len(&self) -> usize {
        self.ends.len()
    }

    /// Checks that the cells have all corners that are listed.
    ///
    /// # Errors
    /// [`nurbs_hausdorff::Error::MeshSyntax`] with both numbers.
    fn check_end(&self) -> Result<()> {
        let (end, found) = (self.ends.last().copied().unwrap_or(0), self.corners.len());
        match end == found {
            true => Ok(()),
            false => Err(FORMAT.syntax(format!("cells of {end} corners, of which {found} are listed"))),
        }
    }

    /// Returns the corners of each cell.
    ///
    /// # Errors
    /// [`nurbs_hausdorff::Error::MeshSyntax`] for ends that decrease or are beyond the corners.
    fn iter(&self) -> impl Iterator<Item = Result<&[u32]>> {
        let mut start = 0;
        self.ends.iter().map(move |&end| {
            let first = std::mem::replace(&mut start, end);
            let cell = self.corners.get(first..end);
            cell.ok_or_else(|| FORMAT.syntax(format!("a cell of the corners {first} to {end}")))
        })
    }
}

/// The points and cells of a surface.
#[derive(Default)]
struct Part {
    points: Vec<DVec3>,
    polygons: Cells,
    strips: Cells,
    lines: Cells,
}

impl Part {
    /// Appends the surface to those before it.
    fn append(self, soup: &mut Soup) -> Result<()> {
        let first = soup.vertices.len() as u32;
        let count = self.points.len();
        soup.vertices.extend(self.points);
        // An index beyond these points must not become one of the next part.
        let moved = |cell: &[u32]| -> Result<Vec<u32>> {
            match cell.iter().find(|&&corner| corner as usize >= count) {
                Some(&NO_INDEX) => Err(FORMAT.syntax("a cell with a point of no number")),
                Some(corner) => Err(FORMAT.syntax(format!("a cell with the point {corner} of {count}"))),
                None => Ok(cell.iter().map(|corner| first + corner).collect()),
            }
        };
        for cell in self.polygons.iter() {
            soup.push_polygon(&moved(cell?)?, FORMAT)?;
        }
        for cell in self.strips.iter() {
            soup.triangles.extend(strip(&moved(cell?)?));
        }
        self.polygons.check_end()?;
        self.strips.check_end()
    }
}

/// Stands for an index that no point can have; it exceeds the index of every point.
const NO_INDEX: u32 = u32::MAX;

/// Returns an index as points are counted.
fn index(number: f64) -> u32 {
    if number >= 0.0 && number < f64::from(NO_INDEX) { number as u32 } else { NO_INDEX }
}
