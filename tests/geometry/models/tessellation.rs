//! Display triangles against analytic surfaces.

use glam::DVec3;
use nurbs_hausdorff::shapes::{self, shape};
use nurbs_hausdorff::tessellate::{Tessellation, TessellationOptions, tessellate};
use nurbs_hausdorff::{Model, PreparedModel};
use std::collections::HashMap;

/// What rounding a coordinate of a model of size 10 to float32 can add.
const FLOAT32_ROUNDING: f64 = 1e-6;

fn vertices(tessellation: &Tessellation) -> Vec<DVec3> {
    let vertex = |position: &[f32]| {
        tessellation.origin
            + DVec3::new(f64::from(position[0]), f64::from(position[1]), f64::from(position[2]))
    };
    tessellation.positions.chunks_exact(3).map(vertex).collect()
}

fn normals(tessellation: &Tessellation) -> Vec<DVec3> {
    let normal = |n: &[f32]| DVec3::new(f64::from(n[0]), f64::from(n[1]), f64::from(n[2]));
    tessellation.normals.chunks_exact(3).map(normal).collect()
}

fn triangles(tessellation: &Tessellation) -> impl Iterator<Item = [usize; 3]> {
    tessellation.indices.chunks_exact(3).map(|t| [t[0] as usize, t[1] as usize, t[2] as usize])
}

fn of(model: &Model, tolerance: Option<f64>) -> Tessellation {
    tessellate(model, &TessellationOptions { tolerance, ..Default::default() }).unwrap()
}

#[test]
fn a_sphere_is_within_the_tolerance_everywhere() {
    let center = DVec3::new(1000.0, -2000.0, 500.0);
    let model = shapes::sphere(center, 2.0).unwrap();
    for tolerance in [0.1, 0.01, 1e-3] {
        let tessellation = of(&model, Some(tolerance));
        let vertices = vertices(&tessellation);
        for vertex in &vertices {
            assert!((vertex.distance(center) - 2.0).abs() < FLOAT32_ROUNDING);
        }
        let mut farthest = 0.0_f64;
        for [a, b, c] in triangles(&tessellation) {
            let [a, b, c] = [vertices[a], vertices[b], vertices[c]];
            for point in [(a + b + c) / 3.0, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)] {
                farthest = farthest.max((point.distance(center) - 2.0).abs());
            }
        }
        assert!(farthest < tolerance, "{farthest} exceeds {tolerance}");
        assert!(farthest > 0.1 * tolerance, "{farthest} wastes triangles at {tolerance}");
    }
}

#[test]
fn a_sphere_has_its_normals_at_the_poles_too() {
    let tessellation = of(&shapes::sphere(DVec3::ZERO, 2.0).unwrap(), None);
    // All point out of the sphere, or all into it.
    let side = normals(&tessellation)[0].dot(vertices(&tessellation)[0]).signum();
    for (vertex, normal) in vertices(&tessellation).iter().zip(normals(&tessellation)) {
        assert!((normal * side).distance(*vertex / 2.0) < 1e-3, "at {vertex}: {normal}");
    }
}

#[test]
fn triangles_turn_the_way_of_their_normals() {
    for name in ["sphere", "torus", "wavy-sheet", "wigley-hull", "glass"] {
        let tessellation = of(&shape(name).unwrap(), None);
        let (vertices, normals) = (vertices(&tessellation), normals(&tessellation));
        for [a, b, c] in triangles(&tessellation) {
            let facing = (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]);
            // Slivers at poles have rounding for a direction.
            if facing.length() > 1e-6 {
                assert!(facing.dot(normals[a] + normals[b] + normals[c]) > 0.0, "{name}");
            }
        }
    }
}

/// Edges between positions that belong to one triangle only.
fn open_edges(tessellation: &Tessellation) -> usize {
    let key = |vertex: usize| {
        let position = &tessellation.positions[3 * vertex..3 * vertex + 3];
        // Closed surfaces meet themselves to float32 rounding.
        [0, 1, 2].map(|axis| (f64::from(position[axis]) * 1e5).round() as i64)
    };
    let mut edges: HashMap<_, usize> = HashMap::new();
    for [a, b, c] in triangles(tessellation) {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            let (p, q) = (key(p), key(q));
            if p != q {
                *edges.entry((p.min(q), p.max(q))).or_default() += 1;
            }
        }
    }
    edges.values().filter(|&&count| count == 1).count()
}

#[test]
fn closed_surfaces_have_no_gaps() {
    for name in ["sphere", "torus"] {
        assert_eq!(open_edges(&of(&shape(name).unwrap(), None)), 0, "{name}");
    }
}

#[test]
fn creases_keep_a_normal_a_side_and_stay_closed() {
    // Two unit squares that meet in a right angle: degree 1 with one inner knot.
    let model = Model::from_json(
        r#"{"surfaces": [{"degree": [1, 1], "knots_u": [0, 0, 1, 2, 2], "knots_v": [0, 0, 1, 1],
        "ctrl": [[[0,0,0,1],[0,1,0,1]], [[1,0,0,1],[1,1,0,1]], [[1,0,1,1],[1,1,1,1]]]}]}"#,
    )
    .unwrap();
    let tessellation = of(&model, None);
    assert_eq!(vertices(&tessellation).len(), 8);
    assert_eq!(triangles(&tessellation).count(), 4);
    for normal in normals(&tessellation) {
        assert!(normal.abs().max_element() > 0.999_999, "{normal} is of neither side");
    }
    // Six sides around two squares that share one.
    assert_eq!(open_edges(&tessellation), 6);
}

#[test]
fn torn_surfaces_are_not_bridged() {
    // A knot of multiplicity degree + 1: two squares a unit apart.
    let model = Model::from_json(
        r#"{"surfaces": [{"degree": [1, 1], "knots_u": [0, 0, 1, 1, 2, 2], "knots_v": [0, 0, 1, 1],
        "ctrl": [[[0,0,0,1],[0,1,0,1]], [[1,0,0,1],[1,1,0,1]], [[2,0,0,1],[2,1,0,1]], [[3,0,0,1],[3,1,0,1]]]}]}"#,
    )
    .unwrap();
    let tessellation = of(&model, None);
    assert_eq!(vertices(&tessellation).len(), 8);
    assert_eq!(triangles(&tessellation).count(), 4);
    for [a, b, c] in triangles(&tessellation) {
        let x = [a, b, c].map(|vertex| vertices(&tessellation)[vertex].x);
        assert!(x.iter().all(|&x| x <= 1.0) || x.iter().all(|&x| x >= 2.0));
    }
}

#[test]
fn surfaces_have_their_own_part_of_the_indices() {
    let tessellation = of(&shape("cylinder").unwrap(), None);
    assert_eq!(tessellation.faces.len(), 3);
    assert_eq!(tessellation.faces[0].start, 0);
    assert_eq!(tessellation.faces[2].end, tessellation.indices.len());
    assert!(tessellation.faces.windows(2).all(|pair| pair[0].end == pair[1].start));
    assert!(tessellation.faces.iter().all(|range| !range.is_empty()));
}

#[test]
fn the_number_of_triangles_is_limited() {
    let tessellation = of(&shape("torus").unwrap(), Some(1e-12));
    let count = triangles(&tessellation).count();
    assert!((500_000..=1 << 20).contains(&count), "{count}");
}

#[test]
fn a_tolerance_that_is_none_is_refused() {
    let sphere = shape("sphere").unwrap();
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for (tolerance, relative_tolerance) in [(Some(tolerance), None), (None, Some(tolerance))] {
            let options = TessellationOptions { tolerance, relative_tolerance };
            assert_eq!(tessellate(&sphere, &options).unwrap_err().code(), "OPTION_OUT_OF_RANGE");
        }
    }
    let both = TessellationOptions { tolerance: Some(1.0), relative_tolerance: Some(1.0) };
    assert_eq!(tessellate(&sphere, &both).unwrap_err().code(), "OPTION_INVALID");
}

#[test]
fn a_relative_tolerance_is_a_fraction_of_the_diagonal() {
    let sphere = shapes::sphere(DVec3::ZERO, 2.0).unwrap();
    let diagonal = PreparedModel::new(&sphere).unwrap().bounding_box().diagonal();
    let relative = TessellationOptions { relative_tolerance: Some(1e-3), ..Default::default() };
    assert_eq!(tessellate(&sphere, &relative).unwrap(), of(&sphere, Some(1e-3 * diagonal)));
}

#[test]
fn a_model_without_extent_has_no_triangles() {
    let model = Model::from_json(
        r#"{"surfaces": [{"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1],
        "ctrl": [[[1,2,3,1],[1,2,3,1]], [[1,2,3,1],[1,2,3,1]]]}]}"#,
    )
    .unwrap();
    assert!(of(&model, None).indices.is_empty());
}
