//! All pairs of bodies: assemblies whose answers are known.

use crate::models::{
    box_of_faces, circle, cuboid, faces, mesh, moved, of, of_quads, placed_all, prepared, quads_of_box,
    stretched,
};
use nurbs_hausdorff::trim::FaceArrays;
use nurbs_hausdorff::{
    CheckOptions, CheckResult, CheckRules, DQuat, DVec3, EmbeddedDoubt, Engine, Error, Model, ModelArrays,
    NamedModel, NamesOfPair, PairState, PreparedModel, RequiredDistance, Rule, SurfaceArrays, shapes,
};

fn check(model: &PreparedModel, options: &CheckOptions) -> CheckResult {
    Engine::cpu().check(&[NamedModel { name: None, model }], options).wait().unwrap()
}

fn states(result: &CheckResult) -> Vec<PairState> {
    result.pairs.iter().map(|pair| pair.state).collect()
}

fn below(below: f64) -> CheckOptions {
    CheckOptions { below, ..CheckOptions::default() }
}

fn unit_box_and(min: [f64; 3], max: [f64; 3]) -> PreparedModel {
    let unit = box_of_faces(DVec3::ZERO, DVec3::ONE);
    let other = box_of_faces(DVec3::from_array(min), DVec3::from_array(max));
    prepared(&placed_all(&[(&unit, moved([0.0; 3])), (&other, moved([0.0; 3]))]))
}

/// Every face turned over, as those of a void.
fn turned(model: &Model) -> Model {
    let mut faces = faces(model);
    faces.iter_mut().for_each(|face| face.reversed = !face.reversed);
    Model::from_faces(ModelArrays { faces, ..ModelArrays::default() }).unwrap()
}

#[test]
fn boxes_that_overlap_clash_at_a_point_inside_both() {
    let result = check(&unit_box_and([0.75, 0.5, 0.25], [2.0, 2.0, 2.0]), &below(0.0));
    assert_eq!(states(&result), [PairState::Clash]);
    let pair = &result.pairs[0];
    let common = [(0.75, 1.0), (0.5, 1.0), (0.25, 1.0)];
    assert!(pair.point.iter().zip(common).all(|(&x, (low, high))| low < x && x < high), "{:?}", pair.point);
    assert_eq!((pair.clearance.lower, pair.clearance.upper), (0.0, 0.0));
    let volume = pair.volume.unwrap();
    assert!(volume.contains(0.25 * 0.5 * 0.75) && volume.width() < 1e-3, "{volume:?}");
    // The shortest way out is along x, and a ball of diameter 0.25 is inside both.
    let depth = pair.depth.unwrap();
    assert!(depth.contains(0.25) && depth.width() < 0.05, "{depth:?}");
    assert_eq!((pair.a.as_str(), pair.b.as_str(), result.pair_count), ("body 1", "body 2", 1));
}

#[test]
fn boxes_that_stand_flush_touch_and_do_not_clash() {
    let result = check(&unit_box_and([1.0, 0.25, 0.25], [2.0, 0.75, 0.75]), &below(0.0));
    assert_eq!(states(&result), [PairState::Touching]);
}

/// A box stands on a larger one. Its bottom consists of 40 by 40 patches, and one of their common corners lies 0.5 deep in
/// the larger box, so that four of 1,600 patches reach into it.
#[test]
fn a_spike_among_a_thousand_flush_patches_is_a_clash() {
    const COUNT: usize = 40;
    let size = DVec3::new(COUNT as f64, COUNT as f64, 3.0);
    let knots: Vec<f64> = (0..COUNT + 3).map(|k| (k.clamp(1, COUNT + 1) - 1) as f64).collect();
    let on = |spike: Option<[usize; 2]>| {
        let mut quads = quads_of_box(DVec3::ZERO, size).to_vec();
        // The bottom of the box is the first of its sides.
        quads.remove(0);
        let mut all = faces(&of_quads(&quads));
        // Uneven steps, because knots at even steps would be removed.
        let at = |index: usize| index as f64 + if index % 2 == 1 { 0.25 } else { 0.0 };
        let point = |index: usize| {
            let place = [index / (COUNT + 1), index % (COUNT + 1)];
            let z = if Some(place) == spike { -0.5 } else { 0.0 };
            // The second parameter runs along x, so that the normal is down.
            [at(place[1]), at(place[0]), z, 1.0]
        };
        let bottom = SurfaceArrays {
            degree: [1, 1],
            knots: [knots.clone(), knots.clone()],
            counts: [COUNT + 1; 2],
            control_points: (0..(COUNT + 1) * (COUNT + 1)).map(point).collect(),
        };
        all.push(FaceArrays::new(bottom, None));
        let below = box_of_faces(DVec3::new(-1.0, -1.0, -2.0), DVec3::new(size.x + 1.0, size.y + 1.0, 0.0));
        prepared(&placed_all(&[(&below, moved([0.0; 3])), (&of(all), moved([0.0; 3]))]))
    };
    assert_eq!(states(&check(&on(None), &below(0.0))), [PairState::Touching]);
    for spike in [[7, 12], [20, 20], [33, 5]] {
        let result = check(&on(Some(spike)), &below(0.0));
        assert_eq!(states(&result), [PairState::Clash], "{spike:?}");
        let [x, y, z] = result.pairs[0].point;
        let off = [x - spike[1] as f64, y - spike[0] as f64];
        assert!(off.iter().all(|off| off.abs() < 1.25) && z < 0.0, "{:?}", result.pairs[0].point);
        // The integral of a bilinear hat of height 0.5 over four squares.
        assert!(result.pairs[0].volume.unwrap().contains(0.5), "{:?}", result.pairs[0].volume);
    }
}

/// The proofs of single bodies end with the time, also if each of them is short.
#[test]
fn no_time_leaves_all_bodies_undecided() {
    let ball = shapes::sphere(DVec3::ZERO, 1.0).unwrap();
    let model = prepared(&placed_all(&[(&ball, moved([0.0; 3])), (&ball, moved([5.0, 0.0, 0.0]))]));
    let result = check(&model, &CheckOptions { max_seconds: Some(1e-9), ..below(0.0) });
    for body in &result.bodies {
        assert_eq!(body.embedded, None);
        assert_eq!(body.embedded_unknown.as_ref().unwrap().why, EmbeddedDoubt::Budget);
    }
    assert!(check(&model, &below(0.0)).bodies.iter().all(|body| body.embedded == Some(true)));
}

/// Balls of radius 1 that are 0.5 apart, where intervals may be as wide as the tolerance.
#[test]
fn the_tolerance_itself_tells_what_touches() {
    let ball = shapes::sphere(DVec3::ZERO, 1.0).unwrap();
    let model = prepared(&placed_all(&[(&ball, moved([0.0; 3])), (&ball, moved([1.5, 2.0, 0.0]))]));
    let state = |tolerance: f64| {
        let options = CheckOptions { tolerance: Some(tolerance), ..below(0.0) };
        states(&check(&model, &options))
    };
    for tolerance in [0.5001, 0.51, 0.6, 0.8, 2.0] {
        assert_eq!(state(tolerance), [PairState::Touching], "{tolerance}");
    }
    for tolerance in [0.1, 0.3, 0.45, 0.49, 0.4999] {
        assert!(matches!(state(tolerance)[..], [] | [PairState::Apart]), "{tolerance}");
    }
    assert_eq!(state(0.5), [PairState::Undecided]);
}

/// 0.25 apart: near below 0.5, apart below 0.125, and not even searched.
#[test]
fn boxes_are_near_only_below_the_distance_asked_for() {
    let model = unit_box_and([1.25, 0.0, 0.0], [2.0, 1.0, 1.0]);
    let result = check(&model, &below(0.5));
    assert_eq!(states(&result), [PairState::Near]);
    let clearance = result.pairs[0].clearance;
    assert!(clearance.contains(0.25) && clearance.width() < 1e-5, "{clearance:?}");
    let result = check(&model, &below(0.125));
    assert_eq!((states(&result).len(), result.pair_count), (0, 1));
}

/// A ball of radius 1 in a void of radius 2 of a ball of radius 3, and the same ball without the void.
#[test]
fn a_ball_in_a_void_is_apart_and_one_in_material_clashes() {
    let ball = |radius| shapes::sphere(DVec3::ZERO, radius).unwrap();
    let (inner, void, outer) = (ball(1.0), turned(&ball(2.0)), ball(3.0));
    let here = moved([0.0; 3]);
    let hollow = prepared(&placed_all(&[(&outer, here), (&void, here), (&inner, here)]));
    assert_eq!(hollow.bodies().len(), 2);
    let result = check(&hollow, &below(0.5));
    assert_eq!(states(&result), [PairState::Apart]);
    assert!(result.pairs[0].clearance.lower >= 0.5);
    let result = check(&hollow, &below(1.5));
    assert_eq!(states(&result), [PairState::Near]);
    // Of one model the ball within would be a void, so that it is another model.
    let (solid, within) = (prepared(&outer), prepared(&inner));
    let named = |name, model| NamedModel { name: Some(name), model };
    let models = [named("housing", &solid), named("ball / 1", &within)];
    let options = below(0.5);
    let result = Engine::cpu().check(&models, &options).wait().unwrap();
    assert_eq!(states(&result), [PairState::Clash]);
    let DVec3 { x, y, z } = DVec3::from_array(result.pairs[0].point);
    assert!(x.hypot(y).hypot(z) <= 1.0 + 1e-9);
    // The whole ball, which has to move by 4 to be out.
    let volume = result.pairs[0].volume.unwrap();
    let ball = 4.0 / 3.0 * std::f64::consts::PI;
    assert!(volume.contains(ball) && volume.width() < 1e-6, "{volume:?}");
    let depth = result.pairs[0].depth.unwrap();
    assert!(depth.lower > 1.9 && depth.lower <= 2.0 && depth.contains(4.0), "{depth:?}");
    assert_eq!(result.pairs[0].b, "ball // 1 / body 1");
}

#[test]
fn twins_in_place_clash_and_are_named_as_duplicates() {
    let unit = box_of_faces(DVec3::ZERO, DVec3::ONE);
    let [one, other] = [prepared(&unit), prepared(&unit)];
    let shorter = prepared(&placed_all(&[(&unit, stretched([1.0, 1.0, 0.99]))]));
    let model = |name, model| NamedModel { name: Some(name), model };
    let options = below(0.0);
    let models = [model("one", &one), model("other", &other), model("shorter", &shorter)];
    let result = Engine::cpu().check(&models, &options).wait().unwrap();
    assert_eq!(states(&result), [PairState::Clash; 3]);
    let duplicates: Vec<_> = result.bodies.iter().map(|body| body.duplicates.clone()).collect();
    assert_eq!(duplicates, [vec!["other / body 1".to_owned()], vec!["one / body 1".to_owned()], vec![]]);
}

/// A cylinder without its lid around nothing, far and near: no inside, so that a contact is not judged.
#[test]
fn sheets_are_judged_where_they_are_apart_only() {
    let mut open = faces(&shapes::cylinder(1.0, 2.0).unwrap());
    open.pop();
    let open = of(open);
    let ball = shapes::sphere(DVec3::ZERO, 1.0).unwrap();
    let at = |x: f64| prepared(&placed_all(&[(&open, moved([0.0; 3])), (&ball, moved([x, 0.0, 1.0]))]));
    assert_eq!(states(&check(&at(2.5), &below(1.0))), [PairState::Near]);
    let touching = check(&at(1.5), &below(1.0));
    assert_eq!(states(&touching), [PairState::Undecided]);
    assert!(touching.pairs[0].why.is_some());
    assert!(!touching.bodies[0].closed);
}

/// As of surfaces, between triangles of one mesh.
#[test]
fn bodies_of_a_mesh_are_checked_too() {
    let both = |min: [f64; 3]| {
        let (mut vertices, mut triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
        let (more, others) = cuboid(DVec3::from_array(min), DVec3::from_array(min) + 1.0);
        vertices.extend(more);
        triangles.extend(others.iter().map(|triangle| triangle.map(|corner| corner + 8)));
        mesh(&vertices, &triangles)
    };
    assert_eq!(states(&check(&both([0.5, 0.25, 0.125]), &below(0.0))), [PairState::Clash]);
    assert_eq!(states(&check(&both([1.125, 0.25, 0.125]), &below(0.25))), [PairState::Near]);
}

/// The row-major matrix of a turn about an axis that is none of the coordinates', and a move.
fn tilted() -> [f64; 12] {
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 2.0) / 3.0, 0.7);
    let [x, y, z] = DVec3::AXES.map(|axis| turn * axis);
    [x.x, y.x, z.x, 3.0, x.y, y.y, z.y, -2.0, x.z, y.z, z.z, 0.5]
}

/// A tube about z from 0 to `length`, of four ruled faces.
fn tube(inner: f64, outer: f64, length: f64) -> Model {
    let knots = vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0];
    let ruled = |from: Vec<[f64; 4]>, to: Vec<[f64; 4]>| SurfaceArrays {
        degree: [1, 2],
        knots: [vec![0.0, 0.0, 1.0, 1.0], knots.clone()],
        counts: [2, 9],
        control_points: from.into_iter().chain(to).collect(),
    };
    let faces = vec![
        ruled(circle(inner, 0.0), circle(inner, length)),
        ruled(circle(inner, length), circle(outer, length)),
        ruled(circle(outer, length), circle(outer, 0.0)),
        ruled(circle(outer, 0.0), circle(inner, 0.0)),
    ];
    Model::from_arrays(None, faces).unwrap()
}

/// A shaft of this radius through a bore of radius 1, both tilted.
fn shaft_in_bore(radius: f64) -> PreparedModel {
    let shaft = shapes::cylinder(radius, 4.0).unwrap();
    let [housing, shaft] = [(&tube(1.0, 2.0, 1.0), [0.0; 3]), (&shaft, [0.0, 0.0, -1.5])]
        .map(|(model, offset)| placed_all(&[(model, moved(offset))]));
    prepared(&placed_all(&[(&housing, tilted()), (&shaft, tilted())]))
}

#[test]
fn a_shaft_in_a_bore_is_near_by_its_clearance_and_clashes_where_it_is_thicker() {
    let result = check(&shaft_in_bore(0.99), &below(0.05));
    assert_eq!(states(&result), [PairState::Near], "{:?}", result.pairs);
    let clearance = result.pairs[0].clearance;
    assert!(clearance.lower <= 0.01 + 1e-12 && clearance.upper >= 0.01 - 1e-12, "{clearance:?}");
    assert!(clearance.upper - clearance.lower < 1e-5, "{clearance:?}");
    assert_eq!(states(&check(&shaft_in_bore(1.01), &below(0.05))), [PairState::Clash]);
}

/// After the time is over each clearance is bounded once, which does not tell a hundredth from nothing.
#[test]
fn after_the_time_bounds_hold_and_what_they_do_not_decide_is_undecided() {
    let options = CheckOptions { max_seconds: Some(1e-9), ..below(0.05) };
    let result = check(&shaft_in_bore(0.99), &options);
    assert_eq!((states(&result), result.clean), (vec![PairState::Undecided], None), "{:?}", result.pairs);
    let clearance = result.pairs[0].clearance;
    assert!(clearance.lower <= 0.01 + 1e-12 && clearance.upper >= 0.01 - 1e-12, "{clearance:?}");
    let refused = CheckOptions { max_seconds: Some(0.0), ..CheckOptions::default() };
    let model = shaft_in_bore(0.99);
    let models = [NamedModel { name: None, model: &model }];
    let refused = Engine::cpu().check(&models, &refused).wait();
    assert!(matches!(refused, Err(Error::OptionOutOfRange { .. })), "{refused:?}");
}

/// A press fit of 1e-6 on a radius of 1 clashes wherever the tolerance is smaller.
#[test]
fn a_press_fit_clashes_where_the_tolerance_is_smaller_than_it() {
    for tolerance in [1e-6, 1e-8] {
        let options = CheckOptions { tolerance: Some(tolerance), ..CheckOptions::default() };
        let result = check(&shaft_in_bore(1.0 + 2e-6), &options);
        assert_eq!(states(&result), [PairState::Clash], "{:?}", result.pairs);
        let [x, y, z] = result.pairs[0].point;
        let from = DVec3::new(x - 3.0, y + 2.0, z - 0.5);
        let axis = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 2.0) / 3.0, 0.7) * DVec3::Z;
        let radius = from.reject_from_normalized(axis).length();
        assert!((1.0 - 1e-12..=1.0 + 2e-6 + 1e-12).contains(&radius), "{radius}");
    }
}

/// Boxes in each other by less than the tolerance are parted by a plane; by more, they clash.
#[test]
fn tilted_boxes_that_stand_flush_touch_within_the_tolerance() {
    let unit = box_of_faces(DVec3::ZERO, DVec3::ONE);
    for (height, expected) in
        [(1.0, PairState::Touching), (1.0 - 1e-9, PairState::Touching), (0.999, PairState::Clash)]
    {
        let upper = placed_all(&[(&unit, moved([0.25, 0.25, height]))]);
        let both = prepared(&placed_all(&[(&unit, tilted()), (&upper, tilted())]));
        assert_eq!(states(&check(&both, &below(0.0))), [expected], "{height}");
    }
}

/// Two planes back to back: sheets have no inside, and the plane between parts them.
#[test]
fn sheets_that_a_plane_parts_touch() {
    let square = faces(&box_of_faces(DVec3::ZERO, DVec3::ONE)).remove(1);
    let wall = faces(&box_of_faces(DVec3::new(0.25, 0.25, 1.0), DVec3::splat(2.0))).remove(2);
    let result = check(&prepared(&of(vec![square, wall])), &below(0.0));
    assert_eq!(states(&result), [PairState::Touching], "{:?}", result.pairs);
}

#[test]
fn a_body_without_an_inside_is_degenerate() {
    let (vertices, triangles) = cuboid(DVec3::ZERO, DVec3::new(1.0, 1.0, 1e-9));
    assert!(check(&mesh(&vertices, &triangles), &below(0.0)).bodies[0].degenerate);
    let (vertices, triangles) = cuboid(DVec3::ZERO, DVec3::new(1.0, 1.0, 1e-3));
    let result = check(&mesh(&vertices, &triangles), &below(0.0));
    assert!(!result.bodies[0].degenerate);
    assert_eq!((result.clean, result.pair_count), (Some(true), 0));
}

/// Three boxes in a row: the first two in each other, the third 0.25 away.
#[test]
fn rules_say_what_is_meant_and_what_must_be() {
    let unit = prepared(&box_of_faces(DVec3::ZERO, DVec3::ONE));
    let [second, third] =
        [0.5, 1.75].map(|x| prepared(&box_of_faces(DVec3::new(x, 0.0, 0.0), DVec3::new(x + 1.0, 1.0, 1.0))));
    let named = |name, model| NamedModel { name: Some(name), model };
    let models = [named("pump / shaft", &unit), named("pump / hub", &second), named("cover", &third)];
    let names = |a: &str, b: &str| NamesOfPair { a: a.to_owned(), b: b.to_owned() };
    let apart = |distance| RequiredDistance { a: "cover/*".to_owned(), b: "pump*/**".to_owned(), distance };
    let result = |rules: CheckRules| {
        let options = CheckOptions { rules, ..CheckOptions::default() };
        Engine::cpu().check(&models, &options).wait()
    };
    let clash = result(CheckRules::default()).unwrap();
    assert_eq!((clash.clean, states(&clash)), (Some(false), vec![PairState::Clash]));
    // A slash in the name of a file is no level: that is written `pump // shaft`.
    let intended = vec![names("* // shaft/*", "*hub/*")];
    let rules = CheckRules { intended: intended.clone(), ..CheckRules::default() };
    let fine = result(rules.clone()).unwrap();
    assert_eq!((fine.clean, fine.pairs[0].intended), (Some(true), true));
    for (distance, clean) in
        [(0.125, Some(true)), (0.24, Some(true)), (0.26, Some(false)), (2.0, Some(false))]
    {
        let found = result(CheckRules { at_least: vec![apart(distance)], ..rules.clone() }).unwrap();
        assert_eq!(found.clean, clean, "{distance}: {:?}", found.rules);
        if distance == 0.26 {
            let [unkept] = &found.rules[..] else { panic!("{:?}", found.rules) };
            assert_eq!((unkept.rule, unkept.broken, unkept.distance), (Rule::AtLeast, true, Some(0.26)));
            assert!(unkept.clearance.unwrap().contains(0.25));
            assert!([&unkept.a, &unkept.b].contains(&&"cover / body 1".to_owned()));
        }
    }
    let touch = |a: &str, b: &str| CheckRules { must_touch: vec![names(a, b)], ..rules.clone() };
    assert_eq!(result(touch("*hub/*", "*shaft/*")).unwrap().clean, Some(true));
    let found = result(touch("cover/*", "pump*/*")).unwrap();
    assert_eq!((found.clean, found.rules[0].rule), (Some(false), Rule::MustTouch));
    assert!(matches!(result(touch("lid/*", "pump*/*")), Err(Error::OptionInvalid { .. })));
    // Two patterns of one body are of no pair.
    assert!(matches!(result(touch("cover/*", "cover/**")), Err(Error::OptionInvalid { .. })));
    assert!(result(touch("pump*/**", "pump*/**")).is_ok());
}
