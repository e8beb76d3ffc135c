//! Meshes and points face by face, and their deviations at samples, where both have formulas.

use glam::DVec3;
use nurbs_hausdorff::shapes::{cylinder, figure5_plane, sphere};
use nurbs_hausdorff::{
    DiffOptions, DiffResult, DistanceOptions, Engine, FaceDifference, FaceState, Facets, FieldOptions,
    MeshGroup, PointCloud, PreparedModel, RigidTransform, TriangleMesh,
};
use std::f64::consts::PI;

fn engine() -> Engine {
    Engine::cpu()
}

fn diff(a: &PreparedModel, b: &PreparedModel, limit: f64) -> DiffResult {
    engine().diff(a, b, &DiffOptions { limit, ..DiffOptions::default() }).wait().unwrap()
}

/// Checks that a face's interval has three digits and holds the distance.
fn is_at(face: &FaceDifference, distance: f64) {
    let FaceDifference { lower, upper, .. } = *face;
    assert!(lower <= distance && distance <= upper, "{distance} is not in {face:?}");
    assert!(upper - lower <= 1e-3 * lower, "{face:?}");
}

/// A prism of 16 sides in a cylinder of radius 2 and height 3: its sides, and its two ends.
fn prism(low: f64, high: f64) -> PreparedModel {
    let count = 16_u32;
    let mut vertices = vec![DVec3::Z * low, DVec3::Z * high];
    for k in 0..count {
        let (y, x) = (2.0 * PI * f64::from(k) / f64::from(count)).sin_cos();
        vertices.extend([low, high].map(|z| DVec3::new(2.0 * x, 2.0 * y, z)));
    }
    let at = |k: u32, end: u32| 2 + 2 * (k % count) + end;
    let sides =
        (0..count).flat_map(|k| [[at(k, 0), at(k + 1, 0), at(k + 1, 1)], [at(k, 0), at(k + 1, 1), at(k, 1)]]);
    let ends = (0..count).flat_map(|k| [[0, at(k + 1, 0), at(k, 0)], [1, at(k, 1), at(k + 1, 1)]]);
    let triangles: Vec<[u32; 3]> = sides.chain(ends).collect();
    let group = |name: &str| MeshGroup { name: Some(name.to_owned()), triangles: 2 * count as usize };
    let mesh = TriangleMesh::new(&vertices, &triangles).unwrap();
    let mesh = mesh.with_groups(vec![group("sides"), group("ends")]).unwrap();
    PreparedModel::of_facets(&Facets::Mesh(mesh), None).unwrap()
}

fn cloud(points: &[DVec3]) -> PreparedModel {
    PreparedModel::of_facets(&Facets::Cloud(PointCloud::new(points.to_vec()).unwrap()), None).unwrap()
}

/// The error of a tessellation, by face of the CAD model and by group of the mesh.
#[test]
fn the_sides_of_a_prism_are_a_sagitta_from_their_cylinder() {
    let exact = PreparedModel::new(&cylinder(2.0, 3.0).unwrap()).unwrap();
    let [low, high] = [exact.bounding_box().min.z, exact.bounding_box().max.z];
    let prism = prism(low, high);
    let sagitta = 2.0 * (1.0 - (PI / 16.0).cos());
    for swapped in [false, true] {
        let result = if swapped { diff(&prism, &exact, 1e-3) } else { diff(&exact, &prism, 1e-3) };
        let [of_exact, of_mesh] = if swapped {
            [&result.faces_of_b, &result.faces_of_a]
        } else {
            [&result.faces_of_a, &result.faces_of_b]
        };
        assert_eq!(result.state, FaceState::Changed);
        // Points of the circle between two corners are a sagitta off, on the ends as on the side.
        of_exact.iter().for_each(|face| is_at(face, sagitta));
        is_at(&of_mesh[0], sagitta);
        assert_eq!(of_mesh[1].state, FaceState::Unchanged, "{:?}", of_mesh[1]);
        let point = if swapped { &of_mesh[0].witness.a } else { &of_mesh[0].witness.b };
        assert_eq!(point.face_name.as_deref(), Some("sides"));
        assert!(point.triangle.unwrap() < 32);
    }
    let within = diff(&exact, &prism, 1.05 * sagitta);
    assert_eq!(within.state, FaceState::Unchanged);
    assert_eq!((within.faces_of_a.len(), within.faces_of_b.len()), (exact.face_count(), 2));
}

/// Meshes to meshes, moved; the end that stays within the other prism's end is unchanged.
#[test]
fn groups_of_meshes_are_compared_with_meshes_and_points() {
    let [low, high] = [0.0, 3.0];
    let [one, other] = [prism(low, high), prism(low, high + 0.5)];
    let result = diff(&one, &other, 0.1);
    assert_eq!(result.faces_of_a[0].state, FaceState::Unchanged);
    is_at(&result.faces_of_a[1], 0.5);
    is_at(&result.faces_of_b[0], 0.5);
    let names = [&result.faces_of_b[1].witness.a, &result.faces_of_b[1].witness.b];
    assert!(names.iter().any(|point| point.face_name.as_deref() == Some("ends")));
    let up = RigidTransform::translation(DVec3::new(0.0, 0.0, 0.25)).unwrap();
    let options = DiffOptions { limit: 0.1, transform: up, ..DiffOptions::default() };
    let moved = engine().diff(&one, &one, &options).wait().unwrap();
    moved.faces_of_a.iter().chain(&moved.faces_of_b).for_each(|face| is_at(face, 0.25));
    let points = cloud(&[DVec3::new(0.0, 0.0, 3.5), DVec3::new(0.0, 0.0, -1.0)]);
    let result = diff(&points, &one, 0.1);
    assert_eq!(result.faces_of_a.len(), 1);
    is_at(&result.faces_of_a[0], 1.0);
    assert_eq!(result.faces_of_a[0].witness.a.index, Some(1));
    // The corner at the top is nearest to the upper point.
    is_at(&result.faces_of_b[1], 2.0_f64.hypot(1.0));
}

#[test]
fn points_and_faces_of_surfaces_are_compared() {
    let ball = PreparedModel::new(&sphere(DVec3::ZERO, 2.0).unwrap()).unwrap();
    let axes: Vec<DVec3> =
        [DVec3::X, DVec3::Y, DVec3::Z].iter().flat_map(|&axis| [2.5 * axis, -2.0 * axis]).collect();
    let result = diff(&cloud(&axes), &ball, 0.1);
    is_at(&result.faces_of_a[0], 0.5);
    let largest = result.faces_of_b.iter().map(|face| face.upper).fold(0.0, f64::max);
    let whole = engine().distance(&ball, &cloud(&axes), &DistanceOptions::default()).wait().unwrap();
    assert!(whole.lower <= largest && largest <= 1.001 * whole.upper);
}

fn field(a: &PreparedModel, b: &PreparedModel, samples: usize) -> nurbs_hausdorff::DeviationField {
    engine().field(a, b, &FieldOptions { samples, ..FieldOptions::default() }).wait().unwrap()
}

#[test]
fn the_samples_of_a_mesh_are_its_vertices_and_cover_it() {
    let exact = PreparedModel::new(&cylinder(2.0, 3.0).unwrap()).unwrap();
    let [low, high] = [exact.bounding_box().min.z, exact.bounding_box().max.z];
    let prism = prism(low, high);
    let found = field(&prism, &exact, 20);
    let [sides, ends] = found.deviations.as_slice() else { panic!("two groups") };
    assert_eq!((sides.face, ends.face, ends.counts[1]), (0, 1, 1));
    // 32 triangles of a side's area over 400 parts: each is cut into 16.
    assert_eq!(sides.triangles.len(), 3 * 32 * 16);
    let area = 16.0 * 3.0 * 4.0 * (PI / 16.0).sin();
    assert!((sides.areas.iter().sum::<f64>() - area).abs() < 1e-9);
    for (index, distance) in sides.distances.iter().enumerate() {
        let [x, y, z] = [0, 1, 2].map(|axis| sides.points[3 * index + axis]);
        // The cylinder is closed by its ends.
        let expected = (2.0 - x.hypot(y)).min(z - low).min(high - z);
        assert!((distance - expected).abs() < 1e-8, "{distance} at {x} {y} {z}");
        if distance.abs() > 1e-6 {
            assert!(sides.signed[index] < 0.0, "inside of the cylinder");
        }
    }
    let sagitta = 2.0 * (1.0 - (PI / 16.0).cos());
    let statistics = found.statistics.unwrap();
    assert!(statistics.mean > 0.1 * sagitta && statistics.percentile_99 <= sagitta + 1e-9, "{statistics:?}");
}

#[test]
fn surfaces_and_points_have_deviations_from_meshes() {
    let exact = PreparedModel::new(&cylinder(2.0, 3.0).unwrap()).unwrap();
    let [low, high] = [exact.bounding_box().min.z, exact.bounding_box().max.z];
    let prism = prism(low, high);
    let sagitta = 2.0 * (1.0 - (PI / 16.0).cos());
    let found = field(&exact, &prism, 33);
    let largest = found.deviations.iter().flat_map(|face| &face.distances).fold(0.0_f64, |a, &b| a.max(b));
    assert!(largest <= sagitta + 1e-12 && largest > 0.9 * sagitta);
    // The triangles of the prism turn outwards.
    let signs = found.deviations.iter().flat_map(|face| &face.signed);
    assert!(signs.filter(|signed| signed.abs() > 1e-9).all(|&signed| signed > 0.0));
    let middle = 0.5 * (low + high);
    let points = cloud(&[
        DVec3::new(0.0, 0.0, middle),
        DVec3::new(0.0, 3.0, middle),
        DVec3::new(0.0, 0.0, high + 1.0),
    ]);
    let found = field(&points, &prism, 2);
    let [of_points] = found.deviations.as_slice() else { panic!("one cloud") };
    let expected = [-1.5_f64.min(2.0 * (PI / 16.0).cos()), 1.0, 1.0];
    for (signed, expected) in of_points.signed.iter().zip(expected) {
        assert!((signed - expected).abs() < 1e-12, "{signed} {expected}");
    }
    assert_eq!((of_points.areas.as_slice(), of_points.triangles.len()), ([1.0; 3].as_slice(), 0));
    // Of points there is no side.
    let plane = PreparedModel::new(&figure5_plane().unwrap()).unwrap();
    let of_plane = field(&plane, &points, 4);
    assert!(of_plane.deviations[0].signed.iter().all(|signed| signed.is_nan()));
    let options = DistanceOptions { deviations: true, ..DistanceOptions::default() };
    let result = engine().distance(&points, &prism, &options).wait().unwrap();
    assert_eq!(result.deviations[0].signed, of_points.signed);
}
