//! The formats of meshes and clouds, by content and by the endings of names.

mod content;
mod foreign;

use nurbs_hausdorff::{Error, Result};

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
    /// OFF, as text; a cloud if it has no faces. It states no unit.
    Off,
    /// Surfaces of VTK, legacy or XML (VTP); a cloud if they have neither polygons nor lines. They
    /// state no unit.
    Vtk,
    /// glTF 2.0 with its buffers embedded or beside it, or GLB; in metres, with the transforms of the scene.
    Gltf,
    /// 3MF, in the unit that it states, with the transforms of its items and components.
    ThreeMf,
    /// Text with three coordinates a line: XYZ, PTS and CSV, in the unit that the names of its
    /// columns state, if they do.
    Text,
    /// PCD of the Point Cloud Library. It states no unit.
    Pcd,
    /// PTX, with the transforms of its scans. It states no unit.
    Ptx,
    /// LAS and LAZ, in the unit of the coordinate reference system if it is stated.
    Las,
    /// E57, in metres: the points of all scans, with their poses.
    E57,
    /// Triangles of a STEP file without faces, in millimetres, where its assemblies place them. No name's ending
    /// says so: [`nurbs_hausdorff_cad::from_step`] refuses such a file with [`Error::StepTriangles`].
    #[cfg(feature = "step")]
    Step,
}

impl MeshFormat {
    /// Returns the format of a file by its content or, where that has no signature, by the ending of its name;
    /// `None` of CAD models and of content that is neither mesh nor points.
    ///
    /// # Errors
    /// [`Error::FormatUnsupported`] for a format of meshes that is recognised and not read.
    pub fn of_file(bytes: &[u8], name: &str) -> Result<Option<Self>> {
        #[cfg(feature = "step")]
        if nurbs_hausdorff_cad::is_cad(bytes) {
            return Ok(None);
        }
        if let Some(format) = Self::of_signature(bytes) {
            return Ok(Some(format));
        }
        foreign::refuse(bytes)?;
        let named = Self::of_name(name);
        // Of these formats only glTF is JSON.
        if bytes.trim_ascii_start().starts_with(b"{") && named != Some(Self::Gltf) {
            return Ok(None);
        }
        Ok(named.or_else(|| Self::of_lines(bytes)))
    }

    /// Returns the format of a file by the ending of its name, in any case; `None` for other endings.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        let (_, ending) = name.rsplit_once('.')?;
        Some(match ending.to_ascii_lowercase().as_str() {
            "stl" => Self::Stl,
            "ply" => Self::Ply,
            "obj" => Self::Obj,
            "off" => Self::Off,
            "vtk" | "vtp" => Self::Vtk,
            "gltf" | "glb" => Self::Gltf,
            "3mf" => Self::ThreeMf,
            "xyz" | "xyzn" | "pts" | "csv" | "asc" | "txt" => Self::Text,
            "pcd" => Self::Pcd,
            "ptx" => Self::Ptx,
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
            Self::Off => "OFF",
            Self::Vtk => "VTK",
            Self::Gltf => "glTF",
            Self::ThreeMf => "3MF",
            Self::Text => "text of points",
            Self::Pcd => "PCD",
            Self::Ptx => "PTX",
            Self::Las => "LAS",
            Self::E57 => "E57",
            #[cfg(feature = "step")]
            Self::Step => "STEP",
        }
    }

    /// Whether a file of the format that has no triangles is a cloud of points.
    pub(super) fn may_be_cloud(self) -> bool {
        match self {
            Self::Stl | Self::Obj | Self::Gltf | Self::ThreeMf => false,
            #[cfg(feature = "step")]
            Self::Step => false,
            _ => true,
        }
    }

    /// Returns [`Error::MeshSyntax`] of this format.
    pub(super) fn syntax(self, found: impl Into<String>) -> Error {
        Error::MeshSyntax { format: self.name(), found: found.into() }
    }
}
