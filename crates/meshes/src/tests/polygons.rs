//! Polygons cut in their plane, against their area by the shoelace formula and points told by hand.

use super::*;
use nurbs_hausdorff::Facets;

/// An OBJ of one face.
fn face(corners: &[[f64; 3]], order: &[usize]) -> MeshFile {
    let vertices: String = corners.iter().map(|[x, y, z]| format!("v {x:?} {y:?} {z:?}\n")).collect();
    let order: String = order.iter().map(|at| format!(" {}", at + 1)).collect();
    MeshFile::read(format!("{vertices}f{order}\n").as_bytes(), MeshFormat::Obj).unwrap()
}

fn mesh(file: &MeshFile) -> &TriangleMesh {
    match &file.facets {
        Facets::Mesh(mesh) => mesh,
        Facets::Cloud(_) => panic!("a mesh"),
    }
}

/// The sum of the triangles' vectors of area.
fn area(mesh: &TriangleMesh) -> DVec3 {
    let vectors = (0..mesh.triangles().len()).map(|triangle| {
        let [a, b, c] = mesh.corners(triangle);
        (b - a).cross(c - a) / 2.0
    });
    vectors.sum()
}

/// The sum of the triangles' areas: it exceeds the polygon's where they overlap.
fn covered(mesh: &TriangleMesh) -> f64 {
    let lengths = (0..mesh.triangles().len()).map(|triangle| {
        let [a, b, c] = mesh.corners(triangle);
        (b - a).cross(c - a).length() / 2.0
    });
    lengths.sum()
}

const L: [[f64; 3]; 6] =
    [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 2.0, 0.0], [0.0, 2.0, 0.0]];

#[test]
fn concave_polygons_are_the_same_from_every_corner() {
    for start in 0..6 {
        for reversed in [false, true] {
            let mut order: Vec<usize> = (0..6).map(|at| (start + at) % 6).collect();
            if reversed {
                order.reverse();
            }
            let file = face(&L, &order);
            assert_eq!((mesh(&file).gap(), file.notes.len()), (0.0, 0));
            let expected = if reversed { -3.0 } else { 3.0 };
            assert!((area(mesh(&file)).z - expected).abs() < 1e-12, "{order:?} {:?}", area(mesh(&file)));
            assert!((covered(mesh(&file)) - 3.0).abs() < 1e-12, "{order:?}");
        }
    }
}

/// Stars in planes of any direction, with points on either side of their notches.
#[test]
fn stars_in_any_plane_are_covered_once() {
    let random = &mut fastrand::Rng::with_seed(46);
    for _ in 0..200 {
        let count = random.usize(3..40);
        let axis = DVec3::new(random.f64() - 0.5, random.f64() - 0.5, random.f64() - 0.5).normalize();
        let (u, v) = axis.any_orthonormal_pair();
        let centre = 10.0 * DVec3::new(random.f64(), random.f64(), random.f64());
        let radii: Vec<f64> =
            (0..2 * count).map(|at| if at % 2 == 0 { 2.0 } else { 0.1 + random.f64() }).collect();
        let step = std::f64::consts::PI / count as f64;
        let corners: Vec<[f64; 3]> = (0..2 * count)
            .map(|at| {
                let (sine, cosine) = (at as f64 * step).sin_cos();
                (centre + radii[at] * (cosine * u + sine * v)).to_array()
            })
            .collect();
        let expected: f64 =
            (0..2 * count).map(|at| radii[at] * radii[(at + 1) % (2 * count)] * step.sin() / 2.0).sum();
        let start = random.usize(0..2 * count);
        let order: Vec<usize> = (0..2 * count).map(|at| (start + at) % (2 * count)).collect();
        let file = face(&corners, &order);
        assert!((covered(mesh(&file)) - expected).abs() < 1e-9 * expected, "{count}");
        assert!((area(mesh(&file)).length() - expected).abs() < 1e-9 * expected, "{count}");
        assert!(mesh(&file).gap() < 1e-13 && file.notes.is_empty());
    }
}

/// A square with a corner raised by h is a distance of h / 4 from the plane through the middles of its heights.
#[test]
fn the_deviation_from_the_plane_is_the_gap() {
    let h = 1e-3;
    let file = face(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, h], [0.0, 1.0, 0.0]], &[0, 1, 2, 3]);
    assert!((mesh(&file).gap() - h / 4.0).abs() < 1e-3 * h, "{}", mesh(&file).gap());
    assert_eq!(file.report().gap, mesh(&file).gap());
    assert!(file.report().gap_proven);
    let prepared = nurbs_hausdorff::PreparedModel::of_facets(&file.facets, None).unwrap();
    assert_eq!(prepared.gap(), mesh(&file).gap());
    assert!(mesh(&file).clone().with_gap(f64::NAN).is_err());
}

/// Corners whose decimals are rounded to float64 are in one plane.
#[test]
fn rounded_corners_are_flat() {
    let corners = [[0.1, 0.7, 0.3], [0.4, 0.9, 0.6], [0.7, 0.7, 0.9], [0.4, 0.5, 0.6]];
    assert_eq!(mesh(&face(&corners, &[0, 1, 2, 3])).gap(), 0.0);
}

#[test]
fn polygons_whose_edges_cross_are_noted() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [3.0, 0.5, 0.0]];
    for order in [&[0, 2, 1, 3][..], &[0, 2, 4, 1, 3]] {
        let file = face(&square, order);
        assert_eq!(file.notes.first().map(|note| note.code), Some("POLYGON_CROSSES"), "{order:?}");
    }
    let pentagram: Vec<[f64; 3]> = (0..5)
        .map(|at| {
            let (sine, cosine) = (f64::from(at) * 0.8 * std::f64::consts::PI).sin_cos();
            [cosine, sine, 0.0]
        })
        .collect();
    assert_eq!(face(&pentagram, &[0, 1, 2, 3, 4]).notes.len(), 1);
    // Corners on a line cross nothing.
    let line = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    assert!(face(&line, &[0, 1, 2, 3]).notes.is_empty());
}

/// Twisted, crossing and large polygons end soon.
#[test]
fn polygons_of_any_corners_end() {
    let random = &mut fastrand::Rng::with_seed(47);
    for count in [5, 50, 500, 4000] {
        let corners: Vec<[f64; 3]> = (0..count).map(|_| [random.f64(), random.f64(), random.f64()]).collect();
        let order: Vec<usize> = (0..count).collect();
        assert!(mesh(&face(&corners, &order)).triangles().len() <= count);
    }
}
