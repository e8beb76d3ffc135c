//! Maps of shapes at known distances.

use super::*;
use crate::deviation::FarthestPoint;
use crate::engine::DistanceOptions;
use crate::error::Error;
use crate::facets::{Facets, PointCloud};
use crate::model::Model;
use glam::DVec3;

/// The unit square at a height.
fn square(z: f64) -> PreparedModel {
    let text = format!(
        r#"{{"surfaces": [{{"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1],
            "ctrl": [[[0, 0, {z}, 1], [0, 1, {z}, 1]], [[1, 0, {z}, 1], [1, 1, {z}, 1]]]}}]}}"#
    );
    PreparedModel::new(&Model::from_json(&text).unwrap()).unwrap()
}

#[test]
fn the_maps_of_a_page_and_of_a_picture_begin_alike_and_hold_the_farthest_point() {
    // The distance from a point close above the square has nearly a cone.
    let cloud = PointCloud::new(vec![DVec3::new(0.51, 0.52, 0.01)]).unwrap();
    let b = PreparedModel::of_facets(&Facets::Cloud(cloud), None).unwrap();
    let (a, engine) = (square(0.0), Engine::cpu());
    let found = engine.distance(&a, &b, &DistanceOptions::default()).wait().unwrap();
    let witness = &found.witness;
    let place = FarthestPoint { face: witness.a.face, point: witness.a.point, foot: witness.b.point };
    let shown = KnownDeviation { uppers: vec![found.upper], farthest: Some(place) };
    let options = DeviationMapOptions { a: Some(shown.clone()), ..DeviationMapOptions::default() };
    let mut coarse = None;
    let told = |maps: DeviationMaps| coarse = maps.a;
    let screen = engine.deviation_maps_by(&a, &b, &options, Here, told).wait().unwrap().a.unwrap();
    let coarse = coarse.unwrap();
    let pair = MapPair::new(&a, &b, options.transform, false).unwrap();
    let search = pair.search(true, &shown, Fineness::PICTURE).unwrap();
    let picture = engine.measured_map(search).wait().unwrap().map;
    let count = coarse.distances.len();
    assert!(count <= picture.values.len() && picture.values.len() < screen.distances.len());
    // Of each vertex before edges are split for the deviation both have the same.
    for index in 0..count {
        assert_eq!(picture.values[index][1], screen.distances[index]);
    }
    // The farthest point is a vertex of both, and no other is farther.
    let distance = DVec3::from_array(place.point).distance(DVec3::from_array(place.foot));
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    for distances in [&coarse.distances, &screen.distances] {
        assert!((largest(&mut distances.iter().copied()) - distance).abs() < 2e-6 * pair.diagonal());
    }
    assert_eq!(picture.values[picture.worst().unwrap()][1], distance);
}

#[test]
fn maps_of_both_are_in_the_unit_of_a_where_it_was_moved() {
    let inches = square(0.0).with_unit(0.0254, None).unwrap();
    let metres = square(0.0).with_unit(1.0, None).unwrap();
    let transform = RigidTransform::new(glam::DQuat::IDENTITY, DVec3::new(0.0, 0.0, -3.0)).unwrap();
    let both = |scale_units| {
        let nothing = Some(KnownDeviation::default());
        let options = DeviationMapOptions { a: nothing.clone(), b: nothing, scale_units, transform };
        Engine::cpu().deviation_maps(&inches, &metres, &options).wait()
    };
    assert!(matches!(both(false), Err(Error::UnitsDiffer { .. })));
    let maps = both(true).unwrap();
    let (a, b) = (maps.a.unwrap(), maps.b.unwrap());
    // A square of one inch lies 3 inches below the corner of that of a metre.
    assert!(a.distances.iter().all(|distance| (distance - 3.0).abs() < 1e-5));
    assert!(a.feet.as_chunks::<3>().0.iter().all(|foot| foot[2].abs() < 1e-6));
    let side = 1.0 / 0.0254;
    for (point, distance) in b.points.as_chunks::<3>().0.iter().zip(&b.distances) {
        let [x, y] = [point[0], point[1]].map(|coordinate| (coordinate * side - 1.0).max(0.0));
        let expected = DVec3::new(x, y, 3.0).length();
        assert!((distance - expected).abs() < 1e-5, "{distance} {expected} at {point:?}");
    }
    let diagonal = side * 2.0_f64.sqrt();
    assert!((maps.diagonal - diagonal).abs() < 1e-9 * diagonal);
}

#[test]
fn bounds_below_0_and_points_out_of_range_are_refused() {
    let (a, b) = (square(0.0), square(1.0));
    let of = |shown: KnownDeviation| {
        let options = DeviationMapOptions { b: Some(shown), ..DeviationMapOptions::default() };
        Engine::cpu().deviation_maps(&a, &b, &options).wait().unwrap_err()
    };
    let negative = KnownDeviation { uppers: vec![1.0, -1.0], farthest: None };
    assert!(matches!(of(negative), Error::OptionOutOfRange { option: "uppers", .. }));
    // The distance of the second one would overflow.
    for number in [f64::INFINITY, 1e300] {
        let place = FarthestPoint { face: 0, point: [0.0; 3], foot: [0.0, number, 0.0] };
        let far = KnownDeviation { uppers: Vec::new(), farthest: Some(place) };
        assert!(matches!(of(far), Error::PointOutOfRange { index: 1, found } if found == number));
    }
}
