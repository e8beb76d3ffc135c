//! Triangles and points as surfaces, for the proof.

use crate::proof::{Model, Surface, Witness};
use nurbs_hausdorff::Facets;
use nurbs_hausdorff_meshes::{MeshFile, MeshFormat};
use std::path::Path;

/// Reads a mesh or a cloud with the library; `None` for a file whose name ends otherwise.
pub(crate) fn read(path: &Path) -> Option<Result<Model, String>> {
    let format = MeshFormat::of_name(path.to_str()?)?;
    let bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) => return Some(Err(error.to_string())),
    };
    Some(MeshFile::read(&bytes, format).map(|file| model(&file.facets)).map_err(|error| error.to_string()))
}

/// Returns a surface for each facet.
fn model(facets: &Facets) -> Model {
    let surfaces = match facets {
        Facets::Mesh(mesh) => {
            let corner = |vertex: u32| mesh.vertices()[vertex as usize].to_array();
            mesh.triangles().iter().map(|triangle| surface(triangle.map(corner))).collect()
        }
        Facets::Cloud(cloud) => cloud.points().iter().map(|point| surface([point.to_array(); 3])).collect(),
    };
    Model { surfaces }
}

/// Returns the bilinear surface (1 − u) a + u ((1 − v) b + v c): a triangle is the set of its points.
fn surface([a, b, c]: [[f64; 3]; 3]) -> Surface {
    let point = |[x, y, z]: [f64; 3]| [x, y, z, 1.0];
    let knots = vec![0.0, 0.0, 1.0, 1.0];
    Surface {
        degree: [1, 1],
        knots_u: knots.clone(),
        knots_v: knots,
        ctrl: vec![vec![point(a); 2], vec![point(b), point(c)]],
        trim: None,
    }
}

/// Returns the place on its surface of the point of a triangle with these weights.
pub(crate) fn witness(triangle: usize, [a, b, c]: [f64; 3]) -> Witness {
    let v = if b + c > 0.0 { c / (b + c) } else { 0.0 };
    Witness { surface: triangle, u: 1.0 - a, v }
}
