//! Readers of meshes and clouds of points.
//!
//! A reader makes plain vertices and triangles of a file's bytes, in float64 wherever the file
//! has more digits than float32; [`TriangleMesh`] and [`PointCloud`] validate them. Damaged files
//! are refused with an error, and memory stays within a fixed multiple of the file's size; that of
//! a compressed one within a fixed limit.

mod format;
mod points;
mod polygons;
mod scans;
mod scenes;
mod soup;
mod surfaces;
mod vtk;
#[cfg(all(any(feature = "wasm-meshes", feature = "wasm-scans"), target_arch = "wasm32"))]
mod wasm;

pub use format::MeshFormat;
use nurbs_hausdorff::{Error, Facets, Note, PointCloud, ReadReport, Result, Skipped, TriangleMesh};
use points::{pcd, ptx, text};
use scans::{e57, las};
use scenes::{gltf, three_mf};
use soup::Soup;
use std::collections::BTreeMap;
use surfaces::{obj, off, ply, stl};

/// The largest file that is read, and the largest size of a compressed one's content: a mesh of
/// 20 million triangles in binary STL.
const MAX_BYTES: u64 = 1 << 30;

/// The bytes of the files beside a mesh's file, by their paths from its folder.
pub type Beside = BTreeMap<String, Vec<u8>>;

/// A mesh or a cloud as its file states it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeshFile {
    /// The mesh or cloud.
    pub facets: Facets,
    /// Metres per unit of its coordinates, if the file states it.
    pub unit: Option<f64>,
    /// The parts of the file that are no part of the model, and those with a decision about them.
    pub notes: Vec<Note>,
    /// The parts of the model that are not read.
    pub skipped: Vec<Skipped>,
}

impl MeshFile {
    /// The largest file that is read, in bytes: 1 GiB, more than ten million triangles of binary STL.
    pub const MAX_BYTES: u64 = MAX_BYTES;

    /// Reads a mesh or a cloud. A face of more than three corners is cut into triangles that cover it in its
    /// plane; the largest distance of a corner from that is [`TriangleMesh::gap`]. O(bytes).
    ///
    /// # Errors
    /// [`Error::FileTooLarge`] for more than 1 GiB, compressed or not; [`Error::MeshSyntax`] for bytes that are not of
    /// the format, or parts of it that are not read; those of [`TriangleMesh::new`] and
    /// [`PointCloud::new`].
    pub fn read(bytes: &[u8], format: MeshFormat) -> Result<Self> {
        Self::read_with(bytes, format, &Beside::new())
    }

    /// Reads a mesh or a cloud with the files that [`MeshFile::names_beside`] names, as [`MeshFile::read`].
    ///
    /// # Errors
    /// Those of [`MeshFile::read`]; [`Error::MeshSyntax`] if one of these files is missing.
    pub fn read_with(bytes: &[u8], format: MeshFormat, beside: &Beside) -> Result<Self> {
        match format {
            MeshFormat::Las | MeshFormat::E57 => Self::read_scan(bytes, format),
            _ => Self::read_mesh(bytes, format, beside),
        }
    }

    /// Returns the paths of other files that a mesh's file consists of, as the buffers of a glTF, from its
    /// folder on. They are as the file states them and may lead anywhere.
    #[must_use]
    pub fn names_beside(bytes: &[u8], format: MeshFormat) -> Vec<String> {
        match format {
            MeshFormat::Gltf => gltf::names_beside(bytes),
            _ => Vec::new(),
        }
    }

    /// Reads a file of any format but those of scans, as [`MeshFile::read_with`]: a program that calls
    /// this alone has no code of scans.
    pub(crate) fn read_mesh(bytes: &[u8], format: MeshFormat, beside: &Beside) -> Result<Self> {
        check_size(bytes)?;
        let soup = match format {
            MeshFormat::Stl => stl::read(bytes)?,
            MeshFormat::Ply => ply::read(bytes)?,
            MeshFormat::Obj => obj::read(bytes)?,
            MeshFormat::Off => off::read(bytes)?,
            MeshFormat::Vtk => vtk::read(bytes)?,
            MeshFormat::Gltf => gltf::read(bytes, beside)?,
            MeshFormat::ThreeMf => three_mf::read(bytes)?,
            MeshFormat::Text => text::read(bytes)?,
            MeshFormat::Pcd => pcd::read(bytes)?,
            MeshFormat::Ptx => ptx::read(bytes)?,
            #[cfg(feature = "step")]
            MeshFormat::Step => scenes::step::read(bytes)?,
            MeshFormat::Las | MeshFormat::E57 => return Err(format.syntax("expected a mesh")),
        };
        Self::of_soup(soup, format)
    }

    /// Reads a scan, as [`MeshFile::read`].
    pub(crate) fn read_scan(bytes: &[u8], format: MeshFormat) -> Result<Self> {
        check_size(bytes)?;
        let soup = match format {
            MeshFormat::Las => las::read(bytes)?,
            MeshFormat::E57 => e57::read(bytes)?,
            _ => return Err(format.syntax("expected a scan")),
        };
        Self::of_soup(soup, format)
    }

    fn of_soup(mut soup: Soup, format: MeshFormat) -> Result<Self> {
        let groups = soup.groups();
        let (gap, notes, skipped) = soup.remarks();
        let Soup { vertices, triangles, unit, .. } = soup;
        let facets = if triangles.is_empty() && format.may_be_cloud() {
            Facets::Cloud(PointCloud::new(vertices)?)
        } else {
            let mesh = TriangleMesh::new(&vertices, &triangles)?;
            Facets::Mesh(mesh.with_groups(groups)?.with_gap(gap)?)
        };
        Ok(Self { facets, unit, notes, skipped })
    }

    /// Returns the report on reading the file.
    #[must_use]
    pub fn report(&self) -> ReadReport {
        let gap = match &self.facets {
            Facets::Mesh(mesh) => mesh.gap(),
            Facets::Cloud(_) => 0.0,
        };
        let (notes, skipped) = (self.notes.clone(), self.skipped.clone());
        let mut report = ReadReport::of_facets(self.unit);
        (report.gap, report.notes, report.skipped) = (gap, notes, skipped);
        report
    }
}

/// Checks the size of a file.
fn check_size(bytes: &[u8]) -> Result<()> {
    match bytes.len() as u64 {
        found if found > MAX_BYTES => Err(Error::FileTooLarge { found, expected: MAX_BYTES }),
        _ => Ok(()),
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]
mod tests;
