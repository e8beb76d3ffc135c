//! Covers against distances to all facets, one by one.

use super::*;
use crate::facets::{Facet, TriangleMesh};
use crate::rounding::lower_min;

fn distance(b: &FacetTarget, point: DVec3) -> f64 {
    (0..b.len() as u32).map(|facet| b.distance_squared(facet, point)).fold(f64::INFINITY, lower_min).sqrt()
}

fn mesh(vertices: &[DVec3], triangles: &[[u32; 3]]) -> FacetTarget {
    FacetTarget::of_mesh(&TriangleMesh::new(vertices, triangles).unwrap())
}

fn any(random: &mut fastrand::Rng, size: f64) -> DVec3 {
    DVec3::from_array([0; 3].map(|_| size * (random.f64() - 0.5)))
}

/// The triangles of a grid of n × n squares.
fn grid(n: u32) -> Vec<[u32; 3]> {
    let square = |k: u32| {
        let first = (k / n) * (n + 1) + k % n;
        let [a, b, c, d] = [first, first + n + 1, first + n + 2, first + 1];
        [[a, b, c], [a, c, d]]
    };
    (0..n * n).flat_map(square).collect()
}

/// The vertices of that grid over a square, about as far from their places as this.
fn grid_points(random: &mut fastrand::Rng, n: u32, off: f64) -> Vec<DVec3> {
    let at = |k: u32| DVec3::new(f64::from(k / (n + 1)), f64::from(k % (n + 1)), 0.0) / f64::from(n);
    (0..(n + 1) * (n + 1)).map(|k| at(k) + any(random, off)).collect()
}

/// The bound on the distance of a triangle by a cover from the facet nearest to a point within it.
fn covered(b: &FacetTarget, corners: &[DVec3; 3], threshold: f64) -> Option<Cover> {
    cover(b, corners, b.nearest(inner_point(corners), 0, 0.0).facet, threshold)
}

/// No sampled point of the triangle is beyond the bound, which its farthest point attains by its facet.
fn check(b: &FacetTarget, corners: &[DVec3; 3], found: &Cover, random: &mut fastrand::Rng) -> f64 {
    let mut largest = 0.0;
    for sample in 0..60 {
        let [s, t] = [random.f64(), random.f64()];
        let weights = [1.0 - s, s * (1.0 - t), s * t];
        let at = if sample < 3 { corners[sample] } else { Facet::Triangle(*corners).point(weights) };
        let distance = distance(b, at);
        assert!(distance <= found.upper + 1e-12, "{distance} beyond {} of {corners:?}", found.upper);
        largest = upper_max(largest, distance);
    }
    let at = found.farthest;
    assert!(Facet::Triangle(*corners).nearest(at).distance_squared.sqrt() <= 1e-12);
    assert!((b.distance_squared(found.facet, at).sqrt() - found.upper).abs() <= 1e-12);
    largest / found.upper
}

/// Sheets with holes, folds and a second sheet, at triangles that go beyond their borders: wherever
/// there is a cover, its bound holds.
#[test]
fn no_point_of_a_triangle_is_beyond_its_cover() {
    let random = &mut fastrand::Rng::with_seed(81);
    let (mut covers, mut attained) = (0, 0);
    for round in 0..20_000 {
        let n = random.u32(1..5);
        let off = [1e-3, 0.1, 0.5, 1.5][random.usize(0..4)] / f64::from(n);
        let (mut vertices, mut triangles) = (grid_points(random, n, off), grid(n));
        if round % 3 == 0 {
            // A second sheet near the first one, joined to it along a side or not.
            let height = 0.3 * random.f64();
            let first = vertices.len() as u32;
            let is_joined = random.bool();
            let upper = grid_points(random, n, off).into_iter().map(|p| p + DVec3::Z * height);
            vertices.extend(upper);
            let kept = |k: u32| if is_joined && k <= n { k } else { first + k };
            triangles.extend(grid(n).iter().map(|corners| corners.map(kept)));
        }
        for _ in 0..random.usize(0..3) {
            triangles.remove(random.usize(0..triangles.len()));
            if triangles.is_empty() {
                triangles.push([0, 1, 2]);
            }
        }
        let b = mesh(&vertices, &triangles);
        let size = [0.1, 0.5, 1.5][random.usize(0..3)];
        let middle = DVec3::new(0.5, 0.5, 0.0) + any(random, 0.8) * DVec3::new(1.0, 1.0, 0.3);
        let tilt = if random.bool() { DVec3::new(1.0, 1.0, 0.1) } else { DVec3::ONE };
        let corners = [0; 3].map(|_| middle + tilt * any(random, size));
        let threshold = 0.5 * random.f64();
        if let Some(found) = covered(&b, &corners, threshold) {
            covers += 1;
            attained += usize::from(check(&b, &corners, &found, random) > 0.95);
        }
    }
    assert!(covers > 4000 && attained > 400, "{covers} {attained}");
}

/// Triangles of any corners, joined at random, degenerate and folded.
#[test]
fn no_point_is_beyond_a_cover_of_any_triangles() {
    let random = &mut fastrand::Rng::with_seed(82);
    let mut covers = 0;
    for round in 0..20_000 {
        let count = random.u32(3..8);
        let flat = if round % 2 == 0 { DVec3::new(1.0, 1.0, 0.05) } else { DVec3::ONE };
        let mut vertices: Vec<DVec3> = (0..count).map(|_| flat * any(random, 1.0)).collect();
        if round % 5 == 0 {
            // Corners on a line, and edges in line with others.
            vertices[2] = vertices[0].lerp(vertices[1], random.f64());
        }
        let triangles: Vec<[u32; 3]> =
            (0..random.usize(1..16)).map(|_| [0; 3].map(|_| random.u32(0..count))).collect();
        let b = mesh(&vertices, &triangles);
        let size = 0.5_f64.powi(random.i32(0..6));
        let middle = flat * any(random, 0.5);
        let mut corners = [0; 3].map(|_| middle + flat * any(random, size));
        match random.u32(0..6) {
            0 => corners = [0, 1, 2].map(|k| vertices[k % vertices.len()]),
            1 => corners[2] = corners[0].lerp(corners[1], random.f64()) + any(random, 1e-9),
            2 => corners[2] = corners[1],
            _ => {}
        }
        if let Some(found) = covered(&b, &corners, 0.3 * random.f64()) {
            covers += 1;
            check(&b, &corners, &found, random);
        }
    }
    assert!(covers > 1000, "{covers}");
}

/// Lemma F11, attained: a triangle across the ridge of a roof, whose middle is lowest.
#[test]
fn the_bound_of_a_cover_is_attained_where_facets_meet() {
    let roof =
        [[0.0, -4.0, 0.0], [0.0, 4.0, 0.0], [3.0, 0.0, -4.0], [-3.0, 0.0, -4.0]].map(DVec3::from_array);
    let b = mesh(&roof, &[[0, 1, 2], [1, 0, 3]]);
    let height = 0.75;
    let corners = [[-0.25, 0.1, height], [0.25, 0.1, height], [0.0, -0.3, height]].map(DVec3::from_array);
    // All are nearest to the ridge.
    let expected = 0.25_f64.hypot(height);
    for threshold in [0.0, 10.0] {
        let found = covered(&b, &corners, threshold).unwrap();
        assert!((found.upper - expected).abs() <= 1e-12, "{found:?} {expected}");
    }
}

/// Of two sheets above each other, joined along two sides, the point that tells for all is below two
/// triangles; of three it is below an odd number.
#[test]
fn a_triangle_below_an_even_number_of_facets_has_no_cover() {
    let at = |x: f64, z: f64| [DVec3::new(x, -9.0, z), DVec3::new(x, 9.0, z)];
    let strip = |turns: &[[f64; 2]]| {
        let vertices: Vec<DVec3> = turns.iter().flat_map(|&[x, z]| at(x, z)).collect();
        let triangles: Vec<[u32; 3]> = (0..turns.len() as u32 - 1)
            .flat_map(|k| [[2 * k, 2 * k + 1, 2 * k + 2], [2 * k + 1, 2 * k + 3, 2 * k + 2]])
            .collect();
        mesh(&vertices, &triangles)
    };
    let corners = [[-0.5, 0.0, 1.0], [2.5, 0.1, 1.0], [1.0, 0.9, 1.0]].map(DVec3::from_array);
    // The folds are within the triangle's image, so that the walk goes on to the next sheet.
    let three = strip(&[[-4.0, 0.0], [2.0, 0.0], [0.0, 0.1], [4.0, 0.2]]);
    let found = covered(&three, &corners, 0.0).unwrap();
    assert!(found.upper >= 1.0 - 1e-12 && found.upper <= 1.2, "{found:?}");
    // Without the last sheet what is right of the fold has none above it.
    let two = strip(&[[-4.0, 0.0], [2.0, 0.0], [-4.0, 0.1]]);
    if let Some(found) = covered(&two, &corners, 0.0) {
        assert!(found.upper >= 0.5_f64.hypot(0.9), "{found:?}");
    }
}

/// Beyond a border the facet itself goes on: a triangle that overhangs by a part is as far as its part.
#[test]
fn a_triangle_beyond_a_border_is_bounded_by_the_facets_there() {
    let n = 4;
    let b = mesh(&grid_points(&mut fastrand::Rng::with_seed(1), n, 0.0), &grid(n));
    for over in [0.0, 1e-9, 0.01, 0.2] {
        let corners = [[-over, -over, 0.0], [1.0, -over, 0.0], [0.3, 1.0, 0.0]].map(DVec3::from_array);
        let threshold = 2.0 * over + 1e-12;
        let found = covered(&b, &corners, threshold).unwrap();
        assert!(found.upper >= over && found.upper <= threshold, "{over} {found:?}");
    }
}
/// A cover that would need more facets than are walked is none: what is left is not bounded.
#[test]
fn a_triangle_above_too_many_facets_has_no_cover() {
    let n = 16;
    let b = mesh(&grid_points(&mut fastrand::Rng::with_seed(1), n, 0.0), &grid(n));
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 1.0, 0.0]].map(DVec3::from_array);
    assert!(covered(&b, &corners, 1e-9).is_none());
}
