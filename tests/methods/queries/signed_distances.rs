//! Signed distances on grids against those known from formulas.

use super::solids::{cube, together};
use glam::DVec3;
use nurbs_hausdorff::internals::engine::{ClosestPointOptions, Engine, PreparedModel};
use nurbs_hausdorff::shapes::{sphere, torus};
use nurbs_hausdorff::{
    Error, Facets, GridOptions, Model, PointCloud, Precision, Side, SignedDistanceOptions, SignedDistances,
    TriangleMesh,
};

/// The rounding of the formulas.
const ROUNDING: f64 = 1e-14;

fn prepared(model: &Model) -> PreparedModel {
    PreparedModel::new(model).unwrap()
}

fn distances(model: &PreparedModel, options: &SignedDistanceOptions) -> Result<SignedDistances, Error> {
    Engine::cpu().signed_distances(model, options).wait()
}

fn resolution(resolution: u32) -> SignedDistanceOptions {
    let grid = GridOptions { resolution: Some(resolution), ..GridOptions::default() };
    SignedDistanceOptions { grid, ..SignedDistanceOptions::default() }
}

/// The points with the places of their values.
fn points(found: &SignedDistances) -> impl Iterator<Item = (usize, DVec3)> {
    let grid = found.grid;
    let [x, y, _] = grid.counts;
    (0..grid.len()).map(move |place| {
        let index = [place % x, place / x % y, place / x / y].map(|index| index as f64);
        (place, DVec3::from_array(grid.origin) + grid.spacing * DVec3::from_array(index))
    })
}

/// Checks every value by a formula, and returns how many are beyond the band.
fn assert_values(name: &str, found: &SignedDistances, depth: impl Fn(DVec3) -> f64) -> usize {
    let mut beyond = 0;
    assert_eq!(found.values.len(), found.grid.len());
    for (place, point) in points(found) {
        let (value, expected) = (found.values[place], depth(point));
        let case = format!("{name}: {value} for {expected} at {point}, bound {:e}", found.bound);
        if value.abs() < found.band {
            let size = if found.undecided.contains(&place) { expected.abs() } else { expected };
            assert!((value - size).abs() <= found.bound + ROUNDING, "{case}");
        } else {
            beyond += 1;
            assert!(expected.abs() >= found.band - found.bound - ROUNDING, "{case}");
            assert_eq!(value.is_sign_negative(), expected < 0.0, "{case}");
        }
    }
    beyond
}

fn depth_of_box(point: DVec3, half: f64) -> f64 {
    let excess = point.abs() - half;
    excess.max(DVec3::ZERO).length() + excess.max_element().min(0.0)
}

#[test]
fn distances_of_bodies_are_those_of_the_formulas() {
    let ball = prepared(&sphere(DVec3::new(1.0, 2.0, 3.0), 2.0).unwrap());
    let of_ball = |point: DVec3| point.distance(DVec3::new(1.0, 2.0, 3.0)) - 2.0;
    let ring = prepared(&torus(3.0, 0.5).unwrap());
    let of_ring = |point: DVec3| (point.truncate().length() - 3.0).hypot(point.z) - 0.5;
    let block = prepared(&Model::from_arrays(None, cube(1.0)).unwrap());
    let of_block = |point: DVec3| depth_of_box(point, 1.0);
    for (name, model, depth) in [
        ("ball", &ball, &of_ball as &dyn Fn(DVec3) -> f64),
        ("ring", &ring, &of_ring),
        ("box", &block, &of_block),
    ] {
        let found = distances(model, &resolution(21)).unwrap();
        assert_eq!(assert_values(name, &found, depth), 0);
        assert!(found.bound < 1.1e-6 * model.bounding_box().diagonal(), "{name}: {:e}", found.bound);
        let undecided = points(&found).filter(|(place, _)| found.undecided.contains(place));
        undecided.for_each(|(_, at)| assert!(depth(at).abs() <= 1e-12, "{name}: {at} has no side"));
        assert!(found.values.iter().any(|value| *value < 0.0));
        let banded = SignedDistanceOptions { band: Some(0.25), ..resolution(40) };
        let found = distances(model, &banded).unwrap();
        // Of the box's grid, of side 2.5, the cube of side 1.5 in its middle alone is more than an eighth.
        assert!(assert_values(name, &found, depth) > found.grid.len() / 8, "{name}");
        // Bricks beyond the band are skipped.
        assert!(found.measured < found.grid.len(), "{name}: {} of {}", found.measured, found.grid.len());
    }
}

/// The points of the faces themselves have no side; the distance of those beside them is exact in float64.
#[test]
fn points_on_the_boundary_are_listed() {
    let block = prepared(&Model::from_arrays(None, cube(1.0)).unwrap());
    let grid = GridOptions {
        origin: Some([-1.5; 3]),
        spacing: Some(0.5),
        counts: Some([7; 3]),
        ..GridOptions::default()
    };
    let found = distances(&block, &SignedDistanceOptions { grid, ..Default::default() }).unwrap();
    assert_values("box", &found, |point| depth_of_box(point, 1.0));
    let on: Vec<usize> =
        points(&found).filter(|(_, at)| depth_of_box(*at, 1.0) == 0.0).map(|(at, _)| at).collect();
    // 5³ less 3³ points.
    assert_eq!(on.len(), 98);
    assert_eq!(found.undecided, on);
}

#[test]
fn a_void_is_outside() {
    let shells = [1.0, 0.6].map(|radius| sphere(DVec3::ZERO, radius).unwrap());
    let hollow = prepared(&together(&[&shells[0], &shells[1]]));
    let depth = |point: DVec3| (point.length() - 0.8).abs() - 0.2;
    for band in [None, Some(0.1)] {
        let found = distances(&hollow, &SignedDistanceOptions { band, ..resolution(33) }).unwrap();
        let beyond = assert_values("hollow ball", &found, depth);
        assert_eq!(beyond > 0, band.is_some());
        assert!(found.undecided.is_empty());
    }
}

#[test]
fn distances_of_a_mesh_are_those_of_its_triangles() {
    let corner = |index: usize| {
        DVec3::from_array([index & 1, index >> 1 & 1, index >> 2].map(|end| 2.0 * end as f64 - 1.0))
    };
    let vertices: Vec<DVec3> = (0..8).map(corner).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[u32; 3]> = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let mesh = |triangles: &[[u32; 3]]| {
        let facets = Facets::Mesh(TriangleMesh::new(&vertices, triangles).unwrap());
        PreparedModel::of_facets(&facets, None).unwrap()
    };
    let block = mesh(&triangles);
    for band in [None, Some(0.2)] {
        let found = distances(&block, &SignedDistanceOptions { band, ..resolution(27) }).unwrap();
        let beyond = assert_values("box of triangles", &found, |point| depth_of_box(point, 1.0));
        assert_eq!(beyond > 0, band.is_some());
        assert!(found.bound < 1e-12);
    }
    let open = distances(&mesh(&triangles[..11]), &resolution(8));
    assert!(matches!(open, Err(Error::NotClosed { found: 3 })), "{open:?}");
}

#[test]
fn models_without_an_inside_are_refused() {
    let open = prepared(&Model::from_arrays(None, cube(1.0)[..5].to_vec()).unwrap());
    let refused = distances(&open, &resolution(8));
    assert!(matches!(refused, Err(Error::NotClosed { found: 4 })), "{refused:?}");
    let cloud = Facets::Cloud(PointCloud::new(vec![DVec3::ZERO, DVec3::ONE]).unwrap());
    let cloud = PreparedModel::of_facets(&cloud, None).unwrap();
    assert_eq!(distances(&cloud, &resolution(8)).unwrap_err().code(), "NOT_CLOSED");
}

#[test]
fn options_out_of_range_are_refused() {
    let ball = prepared(&sphere(DVec3::ZERO, 1.0).unwrap());
    let code = |options: SignedDistanceOptions| distances(&ball, &options).unwrap_err().code();
    for band in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(code(SignedDistanceOptions { band: Some(band), ..resolution(8) }), "OPTION_OUT_OF_RANGE");
    }
    assert_eq!(code(SignedDistanceOptions { tolerance: Some(0.0), ..resolution(8) }), "OPTION_OUT_OF_RANGE");
    assert_eq!(code(resolution(0)), "OPTION_OUT_OF_RANGE");
}

/// Random points of a grid by the questions that are asked of single points.
#[test]
fn distances_agree_with_closest_points_and_sides() {
    let model = prepared(&torus(2.0, 0.7).unwrap());
    let found = distances(&model, &SignedDistanceOptions { band: Some(0.4), ..resolution(48) }).unwrap();
    let all: Vec<(usize, DVec3)> = points(&found).collect();
    let mut random = fastrand::Rng::with_seed(5);
    let chosen: Vec<(usize, DVec3)> = (0..2000).map(|_| all[random.usize(..all.len())]).collect();
    let coordinates: Vec<f64> = chosen.iter().flat_map(|(_, point)| point.to_array()).collect();
    let options = ClosestPointOptions::default();
    let engine = Engine::cpu();
    let closest = engine.closest_points(&model, &coordinates, &options).wait().unwrap();
    for (index, &(place, point)) in chosen.iter().enumerate() {
        let (value, distance) = (found.values[place], closest.distances[index]);
        let bound = found.bound + closest.bounds[index];
        if value.abs() < found.band {
            assert!((value.abs() - distance).abs() <= bound, "{value} {distance} {bound:e}");
        } else {
            assert!(distance >= found.band - bound, "{value} {distance} {bound:e}");
        }
        let side = model.side(point.to_array());
        assert_eq!(value.is_sign_negative(), side == Side::Inside, "{point}");
    }
}

/// 1/3 is no number of float32, so that the bound must grow.
#[test]
fn values_are_rounded_to_float32_within_the_bound() {
    let ball = prepared(&sphere(DVec3::ZERO, 1.0).unwrap());
    let fine = SignedDistanceOptions { relative_tolerance: Some(1e-12), ..resolution(24) };
    let double = distances(&ball, &fine).unwrap();
    let single = distances(&ball, &SignedDistanceOptions { precision: Precision::Float32, ..fine }).unwrap();
    assert_values("ball", &single, |point| point.length() - 1.0);
    assert!(single.values.iter().all(|&value| f64::from(value as f32) == value));
    let furthest = double.values.iter().zip(&single.values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(furthest > 1e-9 && furthest <= single.bound, "{furthest:e} {:e}", single.bound);
    assert!(double.bound < 1e-10 && single.bound < 1e-6);
}

/// A pool of one thread and one of four.
#[test]
fn results_do_not_depend_on_the_threads() {
    let model = prepared(&torus(2.0, 0.7).unwrap());
    let options = SignedDistanceOptions { band: Some(0.4), ..resolution(40) };
    let mut random = fastrand::Rng::with_seed(9);
    let points: Vec<f64> = (0..9000).map(|_| 6.0 * random.f64() - 3.0).collect();
    let closest_options = ClosestPointOptions::default();
    let [one, four] = [1, 4].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let engine = Engine::cpu();
            let closest = engine.closest_points(&model, &points, &closest_options).wait().unwrap();
            (distances(&model, &options).unwrap(), closest)
        })
    });
    assert_eq!(one, four);
}
