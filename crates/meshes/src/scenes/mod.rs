//! The readers of scenes, glTF, 3MF and STEP: meshes that are placed, each at any number of places.

pub(super) mod gltf;
#[cfg(feature = "step")]
pub(super) mod step;
pub(super) mod three_mf;
mod uri;

use super::{MeshFormat, Soup};
use glam::{DAffine3, DVec3};
use nurbs_hausdorff::{Error, Result};

/// The largest number of vertices that a scene places: instances of instances may be exponentially
/// many in the size of the file.
const MAX_PLACED: usize = 1 << 26;

/// The largest depth of a scene: each level takes stack.
const MAX_DEPTH: usize = 64;

/// The largest number of places, which may be as many where they have no mesh.
const MAX_PLACES: usize = 1 << 22;

/// The meshes placed so far.
struct Scene {
    format: MeshFormat,
    soup: Soup,
    places: usize,
}

impl Scene {
    fn new(format: MeshFormat, unit: f64) -> Self {
        Self { format, soup: Soup::in_unit(Some(unit)), places: 0 }
    }

    /// Counts a place at this depth.
    ///
    /// # Errors
    /// [`nurbs_hausdorff::Error::MeshSyntax`] for too deep or too many places.
    fn enter(&mut self, depth: usize) -> Result<()> {
        if depth > MAX_DEPTH {
            return Err(self.format.syntax(format!("a scene of more than {MAX_DEPTH} levels")));
        }
        self.places += 1;
        if self.places > MAX_PLACES {
            return Err(self.format.syntax(format!("a scene of more than {MAX_PLACES} places")));
        }
        Ok(())
    }

    /// Appends a mesh that is moved by `transform`, as a group of this name. Under a map that mirrors triangles are
    /// turned, so that what was outside stays outside: glTF states it of a negative determinant, and solids of 3MF
    /// and STEP have their outside by the order of corners.
    ///
    /// # Errors
    /// [`Error::TriangleIndex`] for the index of no vertex of the mesh;
    /// [`Error::MeshSyntax`] if the scene has too many vertices or triangles.
    fn place(
        &mut self,
        name: Option<&str>,
        vertices: &[DVec3],
        triangles: &[[u32; 3]],
        transform: &DAffine3,
    ) -> Result<()> {
        let Self { format, soup, .. } = self;
        let is_too_large = |present: usize, added: usize| present + added > MAX_PLACED;
        if is_too_large(soup.vertices.len(), vertices.len())
            || is_too_large(soup.triangles.len(), triangles.len())
        {
            return Err(
                format.syntax(format!("the scene places more than {MAX_PLACED} vertices or triangles"))
            );
        }
        soup.begin_group(name.map(str::to_owned));
        let first = soup.vertices.len() as u32;
        soup.vertices.extend(vertices.iter().map(|&vertex| transform.transform_point3(vertex)));
        // An index beyond the mesh must not become one of the next mesh.
        let is_beyond = |&corner: &u32| corner as usize >= vertices.len();
        for (at, triangle) in triangles.iter().enumerate() {
            if let Some(&found) = triangle.iter().find(|&corner| is_beyond(corner)) {
                let (triangle, found) = (soup.triangles.len() + at, found as usize);
                return Err(Error::TriangleIndex { triangle, found, expected: vertices.len() });
            }
        }
        let is_mirrored = transform.matrix3.determinant() < 0.0;
        let placed = |&[a, b, c]: &[u32; 3]| {
            if is_mirrored { [a, c, b] } else { [a, b, c] }.map(|corner| first + corner)
        };
        soup.triangles.extend(triangles.iter().map(placed));
        Ok(())
    }
}
