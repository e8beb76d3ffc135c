//! Maps of functions of x and y over a square.

use super::triangles::edge;
use super::*;
use super::{FarthestPoint, KnownDeviation};
use crate::model::RigidTransform;

const STILL: Placing = Placing { transform: RigidTransform::IDENTITY, scale: 1.0, is_of_a: true };

/// Two triangles over the square of this side in z = 0.
fn square(side: f32) -> Map {
    let positions = [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]].map(|[x, y]| [x, y, 0.0]).concat();
    let surface = Surface {
        positions: &positions,
        normals: &[0.0, 0.0, 1.0].repeat(4),
        indices: &[0, 1, 2, 0, 2, 3],
        counts: &[3, 3],
        origin: DVec3::ZERO,
        flatness: 0.0,
        is_mesh: false,
    };
    Map::base(&surface, f64::from(side) * 2.0_f64.sqrt())
}

fn builder(shown: &KnownDeviation) -> MapBuilder {
    MapBuilder::new(&square(1.0), shown, STILL, 2.0_f64.sqrt(), Fineness::PICTURE)
}

/// Measures the pending points by a function of x and y. Their feet lie below them.
fn measure(builder: &mut MapBuilder, of: impl Fn(f64, f64) -> f64) {
    while !builder.pending().is_empty() {
        let points = builder.pending().to_vec();
        let signed: Vec<f64> = points.chunks(3).map(|at| of(at[0], at[1])).collect();
        let distances: Vec<f64> = signed.iter().map(|value| value.abs()).collect();
        let feet: Vec<f64> =
            points.chunks(3).zip(&signed).flat_map(|(at, value)| [at[0], at[1], -value]).collect();
        builder.measured(&signed, &distances, &feet);
    }
}

/// Makes the map of a function of x and y.
fn map(mut builder: MapBuilder, of: impl Fn(f64, f64) -> f64) -> Map {
    measure(&mut builder, &of);
    builder.refine();
    measure(&mut builder, &of);
    builder.finish()
}

/// A narrow bump, which is nearly 0 at all corners.
fn bump(x: f64, y: f64) -> f64 {
    0.05 * (-((x - 0.3).powi(2) + (y - 0.62).powi(2)) / 0.004).exp()
}

#[test]
fn edges_of_the_base_are_a_thirtieth_of_the_diagonal_at_most_and_cover_the_square() {
    let base = square(4.0);
    for [a, b, c] in &base.triangles.corners {
        for edge in [edge(*a, *b), edge(*b, *c), edge(*c, *a)] {
            assert!(base.length(edge) <= 4.0 * 2.0_f64.sqrt() / 30.0, "{edge:?}");
        }
    }
    let area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| base.vertices[corner as usize].position);
        0.5 * (b - a).cross(c - a).z
    };
    let total: f64 = base.triangles.corners.iter().map(area).sum();
    assert!((total - 16.0).abs() < 1e-9, "{total}");
    // The faces follow each other.
    assert!(base.triangles.faces.is_sorted());
}

#[test]
fn the_map_is_within_a_step_of_a_bump_between_its_first_vertices() {
    let map = map(builder(&KnownDeviation::default()), bump);
    let mut area = 0.0;
    for corners in &map.triangles.corners {
        let [a, b, c] = corners.map(|corner| map.vertices[corner as usize].position);
        area += 0.5 * (b - a).cross(c - a).z;
        let middle = (a + b + c) / 3.0;
        let linear = corners.iter().map(|&corner| map.values[corner as usize][0]).sum::<f64>() / 3.0;
        // Twice the fortieth of the largest, for the middle of a triangle rather than of its edges.
        let off = (linear - bump(middle.x, middle.y)).abs();
        assert!(off < 2.0 * 0.05 / 40.0, "{off} at {middle}");
    }
    // The triangles still cover the square once.
    assert!((area - 1.0).abs() < 1e-9, "{area}");
    assert_eq!(map.triangles.faces.len(), map.triangles.corners.len());
    assert!(map.triangles.faces.is_sorted());
    for (vertex, (foot, value)) in map.vertices.iter().zip(map.feet.iter().zip(&map.values)) {
        let height = bump(vertex.point.x, vertex.point.y);
        assert_eq!((*foot, value[0]), (vertex.point - DVec3::Z * height, height));
    }
}

#[test]
fn what_is_finer_has_more_vertices_and_each_of_the_base() {
    let of = |fineness| {
        map(MapBuilder::new(&square(1.0), &KnownDeviation::default(), STILL, 2.0_f64.sqrt(), fineness), bump)
    };
    let [picture, screen] = [Fineness::PICTURE, Fineness::SCREEN].map(of);
    let base = square(1.0).vertices;
    assert!(base.len() < picture.vertices.len() && picture.vertices.len() < screen.vertices.len());
    assert_eq!(picture.vertices[..base.len()], base);
    assert_eq!(screen.vertices[..base.len()], base);
    assert_eq!(picture.values[..base.len()], screen.values[..base.len()]);
}

#[test]
fn deviations_that_cannot_differ_by_a_step_are_not_refined() {
    let mut builder = builder(&KnownDeviation { uppers: vec![3e-7], farthest: None });
    measure(&mut builder, |x, _| 1e-7 * x);
    builder.refine();
    assert!(builder.pending().is_empty());
}

#[test]
fn the_farthest_point_is_a_vertex_and_bounds_hold() {
    let farthest = Some(FarthestPoint { face: 1, point: [0.2, 0.7, 0.0], foot: [0.2, 0.7, -0.5] });
    let shown = KnownDeviation { uppers: vec![0.25, 0.5], farthest };
    let map = map(builder(&shown), |x, _| 0.3 + 0.001 * x);
    let worst = map.worst().unwrap();
    assert_eq!(map.vertices[worst].position, DVec3::new(0.2, 0.7, 0.0));
    assert_eq!((map.values[worst], map.feet[worst]), ([0.5; 2], DVec3::new(0.2, 0.7, -0.5)));
    assert!(map.triangles.faces.is_sorted());
    // Vertices of the first face alone are limited to its bound.
    for (vertex, &[signed, distance]) in map.vertices.iter().zip(&map.values) {
        let of_first = vertex.position.x > vertex.position.y;
        assert_eq!(signed, distance);
        assert!(if of_first { distance == 0.25 } else { distance > 0.29 }, "{vertex:?} {distance}");
    }
}

#[test]
fn a_point_that_ended_a_search_early_is_not_the_worst() {
    let farthest = Some(FarthestPoint { face: 0, point: [0.5, 0.1, 0.0], foot: [0.5, 0.1, 0.2] });
    let map = map(builder(&KnownDeviation { uppers: vec![9.0], farthest }), |x, _| x);
    assert_eq!(map.vertices[map.worst().unwrap()].position.x, 1.0);
}

#[test]
fn nothing_is_to_be_seen_where_rounding_is_all_and_lists_that_are_too_short_end_the_map() {
    let even = builder(&KnownDeviation { uppers: vec![1e-9], farthest: None });
    assert!(!even.may_have_colors());
    let even = even.finish();
    assert_eq!(even.values.len(), even.vertices.len());
    assert!(even.values.iter().all(|&value| value == [0.0; 2]));
    let mut short = builder(&KnownDeviation::default());
    short.measured(&[1.0], &[], &[]);
    assert_eq!(short.finish().worst().map(|_| ()), Some(()));
}

#[test]
fn a_map_of_b_in_another_unit_measures_where_a_is_and_gives_a_s_unit() {
    // B's unit is ten of A's; A is moved by (1, 2, 3).
    let transform = RigidTransform::new(glam::DQuat::IDENTITY, DVec3::new(1.0, 2.0, 3.0)).unwrap();
    let placing = Placing { transform, scale: 10.0, is_of_a: false };
    let farthest = Some(FarthestPoint { face: 0, point: [10.0, 0.0, 0.0], foot: [10.0, 0.0, 7.0] });
    let shown = KnownDeviation { uppers: Vec::new(), farthest };
    let mut of_b = MapBuilder::new(&square(1.0), &shown, placing, 10.0 * 2.0_f64.sqrt(), Fineness::PICTURE);
    // The corner (1, 0, 0) of B is (10, 0, 0) of the result, and (9, -2, -3) of A before it was moved.
    assert_eq!(of_b.pending()[3..6], [9.0, -2.0, -3.0]);
    let count = of_b.pending().len() / 3;
    of_b.measured(&vec![-2.0; count], &vec![2.0; count], &[1.0, 1.0, 1.0].repeat(count));
    let map = of_b.map();
    assert_eq!((map.values[0], map.feet[0]), ([-2.0, 2.0], DVec3::new(2.0, 3.0, 4.0)));
    assert_eq!((map.values[1], map.worst()), ([-7.0, 7.0], Some(1)));
    assert_eq!(map.vertices[1].position, DVec3::X);
    assert_eq!(map.clone().placed(&placing).vertices[1].position, DVec3::new(10.0, 0.0, 0.0));
}

#[test]
fn the_model_is_within_the_slack_of_a_middle_and_of_a_middle_of_middles() {
    // A part of the unit circle, as one edge with the normals of its ends; ones that lean make a bulge that the
    // circle does not have.
    let angle: f64 = 0.5;
    let flatness = 1.0 - (angle / 2.0).cos();
    let at = |angle: f64| DVec3::new(angle.cos(), angle.sin(), 0.0);
    for lean in [0.0, 0.3, -0.3] {
        let vertex =
            |place, normal| Vertex { position: at(place), point: at(place), normal: at(normal), slack: 0.0 };
        let vertices = vec![vertex(0.0, lean), vertex(angle, angle - lean)];
        let mut map = Map { vertices, flatness, ..Map::default() };
        let first = map.middle([0, 1]);
        map.vertices.push(first);
        for Vertex { point, slack, .. } in [first, map.middle([0, 2])] {
            let off = (point.length() - 1.0).abs();
            // Where the bulge goes outwards the slack is attained.
            assert!(off <= slack + 1e-15 && slack < 0.2, "{lean}: {off} of {slack}");
            assert!(slack >= flatness);
        }
        if lean == 0.0 {
            // On the radius to the middle of the chord, farther by an eighth of what the tangents leave it by.
            let half = angle / 2.0;
            let radius = half.cos() * (1.0 + 0.5 * half.sin().powi(2));
            assert!((first.point.length() - radius).abs() < 1e-15);
        }
        let mesh = Map { is_mesh: true, flatness: 0.0, ..map };
        let middle = mesh.middle([0, 1]);
        assert_eq!((middle.point, middle.slack), (0.5 * (at(0.0) + at(angle)), 0.0));
    }
}
