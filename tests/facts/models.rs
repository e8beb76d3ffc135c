//! Models for facts: made of faces, placed, and as meshes.

use nurbs_hausdorff::trim::FaceArrays;
use nurbs_hausdorff::{DVec3, Facets, InstanceArrays, Model, ModelArrays, PreparedModel, TriangleMesh};

/// The model of faces.
pub(crate) fn of(faces: Vec<FaceArrays>) -> Model {
    Model::from_faces(ModelArrays { faces, ..ModelArrays::default() }).unwrap()
}

/// The faces of a model.
pub(crate) fn faces(model: &Model) -> Vec<FaceArrays> {
    model.faces().map(|face| face.to_arrays()).collect()
}

/// The model under the affine map of a row-major 3 x 4 matrix.
pub(crate) fn placed(model: &Model, transform: [f64; 12]) -> Model {
    placed_all(&[(model, transform)])
}

/// The models under affine maps, together.
pub(crate) fn placed_all(parts: &[(&Model, [f64; 12])]) -> Model {
    let mut arrays = ModelArrays::default();
    for (model, transform) in parts {
        let start = arrays.faces.len();
        arrays.faces.extend(faces(model));
        let surfaces = (start..arrays.faces.len()).collect();
        arrays.instances.push(InstanceArrays { surfaces, transform: *transform, name: None, solid: None });
    }
    Model::from_faces(arrays).unwrap()
}

/// The matrix of a move.
pub(crate) fn moved([x, y, z]: [f64; 3]) -> [f64; 12] {
    [1.0, 0.0, 0.0, x, 0.0, 1.0, 0.0, y, 0.0, 0.0, 1.0, z]
}

/// The matrix of a stretch along the axes.
pub(crate) fn stretched([x, y, z]: [f64; 3]) -> [f64; 12] {
    [x, 0.0, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, 0.0, z, 0.0]
}

pub(crate) fn prepared(model: &Model) -> PreparedModel {
    PreparedModel::new(model).unwrap()
}

pub(crate) fn mesh(vertices: &[DVec3], triangles: &[[u32; 3]]) -> PreparedModel {
    let mesh = TriangleMesh::new(vertices, triangles).unwrap();
    PreparedModel::of_facets(&Facets::Mesh(mesh), None).unwrap()
}

/// The sides of a box by its corners, anticlockwise seen from outside.
const SIDES: [[usize; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

/// The corners of a box, and its triangles with normals out of it.
pub(crate) fn cuboid(min: DVec3, max: DVec3) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let corner = |index: u32| {
        let at = |bit: u32, low: f64, high: f64| if index & bit > 0 { high } else { low };
        DVec3::new(at(1, min.x, max.x), at(2, min.y, max.y), at(4, min.z, max.z))
    };
    let sides = SIDES.map(|side| side.map(|corner| corner as u32));
    let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    ((0..8).map(corner).collect(), triangles)
}

/// The box of plane faces with normals out of it.
pub(crate) fn box_of_faces(min: DVec3, max: DVec3) -> Model {
    of_quads(&quads_of_box(min, max))
}

/// The sides of a box.
pub(crate) fn quads_of_box(min: DVec3, max: DVec3) -> [Quad; 6] {
    let (corners, _) = cuboid(min, max);
    SIDES.map(|side| side.map(|corner| corners[corner]))
}

/// Four corners, anticlockwise seen from outside.
pub(crate) type Quad = [DVec3; 4];

/// The bilinear faces between these corners.
pub(crate) fn of_quads(quads: &[Quad]) -> Model {
    let face = |&[a, b, c, d]: &Quad| {
        let surface = nurbs_hausdorff::SurfaceArrays {
            degree: [1, 1],
            knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
            counts: [2, 2],
            control_points: [a, d, b, c].map(|point| point.extend(1.0).to_array()).to_vec(),
        };
        FaceArrays::new(surface, None)
    };
    of(quads.iter().map(face).collect())
}

/// A cube of side 10 with a pocket in its top, 4 wide and so deep.
pub(crate) fn cube_with_pocket(depth: f64) -> Vec<Quad> {
    let ring = |half: f64, z: f64| {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| DVec3::new(half * x, half * y, z))
    };
    let [below, above] = [ring(5.0, 0.0), ring(5.0, 10.0)];
    let [rim, floor] = [ring(2.0, 10.0), ring(2.0, 10.0 - depth)];
    let between = |low: [DVec3; 4], high: [DVec3; 4]| {
        (0..4).map(move |k| [low[k], low[(k + 1) % 4], high[(k + 1) % 4], high[k]])
    };
    let [a, b, c, d] = below;
    between(below, above)
        .chain(between(above, rim))
        .chain(between(rim, floor))
        .chain([[d, c, b, a], floor])
        .collect()
}

/// The control points of a circle about z: quarters of degree 2.
pub(crate) fn circle(radius: f64, height: f64) -> Vec<[f64; 4]> {
    let corners = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]];
    let weight = |index: usize| if index.is_multiple_of(2) { 1.0 } else { 0.5_f64.sqrt() };
    let point = |(index, [x, y]): (usize, [i32; 2])| {
        [radius * f64::from(x), radius * f64::from(y), height, weight(index)]
    };
    corners.into_iter().enumerate().map(point).collect()
}
