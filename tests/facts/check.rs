//! All pairs of bodies: assemblies whose answers are known.

use crate::models::{box_of_faces, cuboid, faces, mesh, moved, of, placed_all, prepared, stretched};
use nurbs_hausdorff::{
    CheckOptions, CheckResult, DVec3, Engine, Model, ModelArrays, NamedModel, PairState, PreparedModel,
    shapes,
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
    assert_eq!((pair.clearance.lower, pair.clearance.upper, pair.volume), (0.0, 0.0, None));
    assert_eq!((pair.a.as_str(), pair.b.as_str(), result.pair_count), ("body 1", "body 2", 1));
}

#[test]
fn boxes_that_stand_flush_touch_and_do_not_clash() {
    let result = check(&unit_box_and([1.0, 0.25, 0.25], [2.0, 0.75, 0.75]), &below(0.0));
    assert_eq!(states(&result), [PairState::Touching]);
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
