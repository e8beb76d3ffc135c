//! Zones on one side whose least largest distance is known.

use super::super::*;
use super::{cloud, fit, prepared};
use crate::facets::{Facets, TriangleMesh};
use crate::shapes::shape;
use glam::{DQuat, DVec3};

/// A ball with its centre and radius.
fn ball() -> (PreparedModel, DVec3, f64) {
    let ball = PreparedModel::new(&shape("sphere").unwrap()).unwrap();
    let facts = ball.facts();
    let center = DVec3::from_array([0, 1, 2].map(|k| 0.5 * (facts.min[k].middle() + facts.max[k].middle())));
    let radius = 0.5 * facts.extents[0].middle();
    (ball, center, radius)
}

/// The directions of the axes and of the diagonals.
fn directions() -> Vec<DVec3> {
    let signs = || [1.0, -1.0];
    let corners = signs().into_iter().flat_map(|x| {
        signs().into_iter().flat_map(move |y| signs().map(|z| DVec3::new(x, y, z).normalize()))
    });
    DVec3::AXES.iter().flat_map(|&axis| [axis, -axis]).chain(corners).collect()
}

fn options(norm: FitNorm, size: f64, limit: Option<f64>) -> BestFitOptions {
    let rotation = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 0.01);
    let transform = RigidTransform::new(rotation, 0.004 * size * DVec3::new(2.0, -1.0, 1.0)).unwrap();
    let zone = ZoneOptions { translation: Some(0.02 * size), limit, ..ZoneOptions::default() };
    BestFitOptions { start: FitStart::Given, norm, transform, zone, ..BestFitOptions::default() }
}

fn zone(a: &PreparedModel, b: &PreparedModel, options: &BestFitOptions) -> Zone {
    Engine::cpu().best_fit(a, b, options).wait().unwrap().zone.unwrap()
}

/// The zone contains the true one, and is as narrow as one that counts as proven.
fn assert_zone(found: Zone, least: f64) {
    assert!(found.lower <= least && least <= found.upper, "{found:?} of {least}");
    assert!(found.upper - found.lower <= 0.0101 * least.abs(), "{found:?} of {least}");
    assert_eq!(found.refuted, 0);
}

/// A scan 0.02 within a ball with a bump of 0.06 beyond it: shifted by 0.04 both ends stand out by 0.02. Within the ball
/// the points are deepest by 0.02, which no shift makes less.
#[test]
fn a_bump_is_shifted_into_the_body() {
    let (b, center, radius) = ball();
    let mut points: Vec<DVec3> = directions().iter().map(|&along| 0.98 * radius * along).collect();
    points.push(1.06 * radius * DVec3::X);
    let a = cloud(points.iter().map(|&point| center + point).collect());
    // The largest distance on both sides is that outside, of a bump that is moved in.
    for (norm, least) in [(FitNorm::Outside, 0.02), (FitNorm::Inside, 0.02)] {
        let mut options = options(norm, radius, None);
        options.zone.translation = Some(0.06 * radius);
        assert_zone(zone(&a, &b, &options), least * radius);
    }
}

/// A casting with stock of 0.05 everywhere on the radius: no motion leaves more everywhere, and one that leaves
/// 0.04 is known, one that leaves 0.06 is certainly none.
#[test]
fn stock_is_a_distance_below_zero() {
    let (b, center, radius) = ball();
    let a = cloud(directions().iter().map(|&along| center + 1.05 * radius * along).collect());
    for (limit, passes) in [(-0.04, true), (-0.06, false)] {
        let found = zone(&a, &b, &options(FitNorm::Inside, radius, Some(limit * radius)));
        assert!(found.lower <= -0.05 * radius && -0.05 * radius <= found.upper, "{found:?}");
        assert_eq!(found.passes, Some(passes), "{found:?}");
    }
    assert_zone(zone(&a, &b, &options(FitNorm::Inside, radius, None)), -0.05 * radius);
    assert_zone(zone(&a, &b, &options(FitNorm::Outside, radius, None)), 0.05 * radius);
}

/// A cube of triangles whose normals point inwards, as files have them, has the same sides: stock of 0.1 on its faces.
#[test]
fn sides_are_those_of_the_body() {
    let corner =
        |k: usize| DVec3::from_array([0, 1, 2].map(|axis| if (k >> axis) & 1 == 0 { -1.0 } else { 1.0 }));
    let faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let points: Vec<DVec3> = (0..8).map(corner).collect();
    let of_face = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
    let scan = cloud(DVec3::AXES.iter().flat_map(|&axis| [1.1 * axis, -1.1 * axis]).collect());
    for is_turned in [false, true] {
        let turned = |[a, b, c]: [u32; 3]| if is_turned { [a, c, b] } else { [a, b, c] };
        let triangles: Vec<[u32; 3]> = faces.iter().flat_map(|&face| of_face(face)).map(turned).collect();
        let mesh = TriangleMesh::new(&points, &triangles).unwrap();
        let cube = PreparedModel::of_facets(&Facets::Mesh(mesh), None).unwrap();
        assert_zone(zone(&scan, &cube, &options(FitNorm::Inside, 1.0, None)), -0.1);
    }
}

#[test]
fn one_side_needs_a_scan_and_a_body() {
    let (ball, _, radius) = ball();
    let sheet = PreparedModel::new(&shape("wavy-sheet").unwrap()).unwrap();
    let scan = cloud(directions());
    let code = |a: &PreparedModel, b: &PreparedModel| {
        let options = options(FitNorm::Outside, radius, None);
        Engine::cpu().best_fit(a, b, &options).wait().map_err(|error| error.code()).err()
    };
    assert_eq!(code(&scan, &sheet), Some("NOT_CLOSED"));
    assert_eq!(code(&ball, &ball), Some("OPTION_INVALID"));
    let mut with_limit = options(FitNorm::Largest, radius, Some(-1.0));
    assert!(Engine::cpu().best_fit(&scan, &ball, &with_limit).wait().is_err());
    with_limit.zone.limit = Some(f64::NAN);
    with_limit.norm = FitNorm::Inside;
    assert!(Engine::cpu().best_fit(&scan, &ball, &with_limit).wait().is_err());
}

/// All points lie half a unit above the top of a ball. No other point keeps them from moving away without end.
#[test]
fn a_fit_on_one_side_stays_in_reach() {
    let ball = prepared("sphere");
    let size = ball.bounding_box();
    let radius = 0.5 * (size.max.z - size.min.z);
    let above = |index: usize| {
        let angle = 2.4 * index as f64;
        let across = 0.3 * (index as f64 / 400.0).sqrt();
        (radius + 0.5)
            * DVec3::new(across * angle.cos(), across * angle.sin(), (1.0 - across * across).sqrt())
    };
    let points = cloud((0..400).map(above).collect());
    let zone = ZoneOptions { translation: Some(0.25), degrees: 2.0, limit: Some(-3.0), max_boxes: 500 };
    let options =
        BestFitOptions { norm: FitNorm::Inside, zone, start: FitStart::Given, ..BestFitOptions::default() };
    let found = fit(&points, &ball, &options);
    let moved = found.transform.apply(above(0)).distance(above(0));
    // The fit in the mean lays the points on the ball.
    assert!(moved < 2.0, "{found:?}");
    assert_eq!(found.zone.unwrap().passes, Some(false), "{found:?}");
}
