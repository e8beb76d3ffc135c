//! Readers of meshes and clouds of points.
//!
//! A reader makes plain vertices and triangles of a file's bytes, in float64 wherever the file
//! has more digits than float32; [`TriangleMesh`] and [`PointCloud`] validate them. Damaged files
//! are refused with an error, and memory stays within a fixed multiple of the file's size; that of
//! a compressed one within a fixed limit.

mod e57;
mod gltf;
mod las;
mod obj;
mod ply;
mod scene;
#[cfg(feature = "cad")]
mod step;
mod stl;
mod text;
mod three_mf;

use crate::error::{Error, Result};
use crate::facets::{Facets, MeshGroup, PointCloud, TriangleMesh};
use glam::DVec3;

/// The largest file that is read, and the largest size of a compressed one's content: a mesh of
/// 20 million triangles in binary STL.
const MAX_BYTES: u64 = 1 << 30;

/// The formats of meshes and clouds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MeshFormat {
    /// STL, binary or text. It states no unit.
    Stl,
    /// PLY, text or binary; a cloud if it has no faces.
    Ply,
    /// Wavefront OBJ. It states no unit.
    Obj,
    /// glTF 2.0 with its buffers embedded, or GLB; in metres, with the transforms of the scene.
    Gltf,
    /// 3MF, in the unit that it states, with the transforms of its items and components.
    ThreeMf,
    /// Text with three coordinates a line: XYZ, PTS and CSV. It states no unit.
    Text,
    /// LAS and LAZ, in the unit of the coordinate reference system if it is stated.
    Las,
    /// E57, in metres: the points of all scans, with their poses.
    E57,
    /// Triangles of a STEP file without faces, in millimetres, where its assemblies place them. No name's ending
    /// says so: [`crate::Model::from_step`] refuses such a file with [`Error::StepTriangles`].
    #[cfg(feature = "cad")]
    Step,
}

/// A mesh or a cloud as its file states it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeshFile {
    /// The mesh or cloud.
    pub facets: Facets,
    /// Metres per unit of its coordinates, if the file states it.
    pub unit: Option<f64>,
}

impl MeshFormat {
    /// Returns the format of a file by the ending of its name, in any case; `None` for other endings.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        let (_, ending) = name.rsplit_once('.')?;
        Some(match ending.to_ascii_lowercase().as_str() {
            "stl" => Self::Stl,
            "ply" => Self::Ply,
            "obj" => Self::Obj,
            "gltf" | "glb" => Self::Gltf,
            "3mf" => Self::ThreeMf,
            "xyz" | "pts" | "csv" | "asc" => Self::Text,
            "las" | "laz" => Self::Las,
            "e57" => Self::E57,
            _ => return None,
        })
    }

    /// Returns the name of the format.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Stl => "STL",
            Self::Ply => "PLY",
            Self::Obj => "OBJ",
            Self::Gltf => "glTF",
            Self::ThreeMf => "3MF",
            Self::Text => "text of points",
            Self::Las => "LAS",
            Self::E57 => "E57",
            #[cfg(feature = "cad")]
            Self::Step => "STEP",
        }
    }

    /// Returns [`Error::MeshSyntax`] of this format.
    fn syntax(self, found: impl Into<String>) -> Error {
        Error::MeshSyntax { format: self.name(), found: found.into() }
    }
}

/// Vertices and triangles as they were read.
#[derive(Debug, Default, PartialEq)]
struct Soup {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// The names of the groups, each with the number of triangles before it.
    groups: Vec<(Option<String>, usize)>,
    unit: Option<f64>,
}

impl MeshFile {
    /// Reads a mesh or a cloud. Faces of more than three corners are cut into triangles from their
    /// first corner. O(bytes).
    ///
    /// # Errors
    /// [`Error::FileTooLarge`] for more than 1 GiB, compressed or not; [`Error::MeshSyntax`] for bytes that are not of
    /// the format, or parts of it that are not read; those of [`TriangleMesh::new`] and
    /// [`PointCloud::new`].
    pub fn read(bytes: &[u8], format: MeshFormat) -> Result<Self> {
        match format {
            MeshFormat::Las | MeshFormat::E57 => Self::read_scan(bytes, format),
            _ => Self::read_mesh(bytes, format),
        }
    }

    /// Reads a file of any format but those of scans, as [`MeshFile::read`]: a program that calls
    /// this alone has no code of scans.
    pub(crate) fn read_mesh(bytes: &[u8], format: MeshFormat) -> Result<Self> {
        check_size(bytes)?;
        let mut soup = match format {
            MeshFormat::Stl => stl::read(bytes)?,
            MeshFormat::Ply => ply::read(bytes)?,
            MeshFormat::Obj => obj::read(bytes)?,
            MeshFormat::Gltf => gltf::read(bytes)?,
            MeshFormat::ThreeMf => three_mf::read(bytes)?,
            MeshFormat::Text => text::read(bytes)?,
            #[cfg(feature = "cad")]
            MeshFormat::Step => step::read(bytes)?,
            MeshFormat::Las | MeshFormat::E57 => return Err(format.syntax("expected a mesh")),
        };
        let groups = soup.groups();
        let Soup { vertices, triangles, unit, .. } = soup;
        let is_cloud = triangles.is_empty() && matches!(format, MeshFormat::Ply | MeshFormat::Text);
        let facets = if is_cloud {
            Facets::Cloud(PointCloud::new(vertices)?)
        } else {
            Facets::Mesh(TriangleMesh::new(&vertices, &triangles)?.with_groups(groups)?)
        };
        Ok(Self { facets, unit })
    }

    /// Reads a scan, as [`MeshFile::read`].
    pub(crate) fn read_scan(bytes: &[u8], format: MeshFormat) -> Result<Self> {
        check_size(bytes)?;
        let Soup { vertices, unit, .. } = match format {
            MeshFormat::Las => las::read(bytes)?,
            MeshFormat::E57 => e57::read(bytes)?,
            _ => return Err(format.syntax("expected a scan")),
        };
        Ok(Self { facets: Facets::Cloud(PointCloud::new(vertices)?), unit })
    }
}

/// Checks the size of a file.
fn check_size(bytes: &[u8]) -> Result<()> {
    match bytes.len() as u64 {
        found if found > MAX_BYTES => Err(Error::FileTooLarge { found, expected: MAX_BYTES }),
        _ => Ok(()),
    }
}

impl Soup {
    /// Begins a group; the triangles before the first one have no name.
    fn begin_group(&mut self, name: Option<String>) {
        self.groups.push((name, self.triangles.len()));
    }

    /// Returns the groups that have triangles.
    fn groups(&mut self) -> Vec<MeshGroup> {
        let begun = std::mem::take(&mut self.groups);
        let starts = std::iter::once((None, 0)).chain(begun);
        let mut groups: Vec<MeshGroup> = Vec::new();
        let mut before = (None, 0);
        for (name, start) in starts.chain([(None, self.triangles.len())]) {
            let (of, first) = std::mem::replace(&mut before, (name, start));
            if start > first {
                groups.push(MeshGroup { name: of, triangles: start - first });
            }
        }
        groups
    }

    /// Appends the triangles of a polygon about its first corner.
    ///
    /// # Errors
    /// [`Error::MeshSyntax`] for fewer than three corners.
    fn push_polygon(&mut self, corners: &[u32], format: MeshFormat) -> Result<()> {
        let [first, rest @ ..] = corners else { return Err(format.syntax("a face without corners")) };
        if rest.len() < 2 {
            return Err(format.syntax(format!("a face of {} corners", corners.len())));
        }
        self.triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
        Ok(())
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]
mod tests;
