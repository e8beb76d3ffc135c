//! Any bytes, as a file of the format that the first names, are either refused or a mesh or a cloud
//! of finite points, whose corners are its vertices.

use nurbs_hausdorff::Facets;
use nurbs_hausdorff_meshes::{MeshFile, MeshFormat};

/// The endings of names, one for each reader.
const ENDINGS: [&str; 12] =
    [".stl", ".ply", ".obj", ".gltf", ".3mf", ".xyz", ".las", ".e57", ".off", ".vtk", ".pcd", ".ptx"];

pub fn check(bytes: &[u8]) {
    let Some((&first, content)) = bytes.split_first() else { return };
    // Any bytes may be of any format, or of one that is refused.
    let _ = MeshFormat::of_file(content, "file");
    let format = MeshFormat::of_name(ENDINGS[usize::from(first) % ENDINGS.len()]).unwrap();
    let read = match MeshFile::read(content, format) {
        Ok(read) => read,
        Err(error) => {
            assert!(!error.to_string().is_empty() && !error.code().is_empty());
            return;
        }
    };
    let points = match &read.facets {
        Facets::Mesh(mesh) => {
            let corners = mesh.triangles().as_flattened();
            assert!(!corners.is_empty());
            assert!(corners.iter().all(|&corner| (corner as usize) < mesh.vertices().len()));
            let grouped: usize = mesh.groups().iter().map(|group| group.triangles).sum();
            assert_eq!(grouped, mesh.triangles().len());
            mesh.vertices()
        }
        Facets::Cloud(cloud) => cloud.points(),
    };
    assert!(!points.is_empty() && points.iter().all(|point| point.is_finite()));
    assert!(read.unit.is_none_or(|unit| unit > 0.0 && unit.is_finite()));
}
