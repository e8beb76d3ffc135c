//! Revisions of assemblies by known edits: what `diff` says of each part.

use crate::models::{cuboid, faces, moved, of, prepared};
use nurbs_hausdorff::trim::{FaceArrays, TrimCurveArrays};
use nurbs_hausdorff::{
    DQuat, DVec3, DiffOptions, Engine, FaceState, InstanceArrays, Model, ModelArrays, Monitor,
    PartDifference, PartState, PartsUnknown, PreparedModel, RigidTransform, SurfaceArrays, shapes,
};

/// A named part of an assembly, placed by a row-major matrix.
type Placed<'a> = (&'a str, &'a Model, [f64; 12]);

const HERE: [f64; 12] = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];

fn assembly(parts: &[Placed<'_>]) -> PreparedModel {
    let mut arrays = ModelArrays::default();
    for &(name, model, transform) in parts {
        let start = arrays.faces.len();
        for (index, mut face) in faces(model).into_iter().enumerate() {
            face.face_name = Some(format!("{name} / face {index}"));
            arrays.faces.push(face);
        }
        let surfaces = (start..arrays.faces.len()).collect();
        arrays.instances.push(InstanceArrays { surfaces, transform, name: None, solid: None });
    }
    prepared(&Model::from_faces(arrays).unwrap())
}

fn diff(a: &[Placed<'_>], b: &[Placed<'_>]) -> Vec<PartDifference> {
    Engine::cpu().diff(&assembly(a), &assembly(b), &DiffOptions::default()).wait().unwrap().parts
}

fn state_of(parts: &[PartDifference], name: &str) -> PartState {
    let is_of =
        |part: &&PartDifference| part.name_of_a.as_deref().or(part.name_of_b.as_deref()) == Some(name);
    parts.iter().find(is_of).unwrap_or_else(|| panic!("{name} in {parts:?}")).state
}

/// A box whose farthest corner is pushed by this: no turn and no mirror lays it on itself.
fn wedge(push: [f64; 3]) -> Model {
    let (mut corners, _) = cuboid(DVec3::ZERO, DVec3::new(3.0, 2.0, 1.0));
    corners[7] += DVec3::from_array(push);
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let surface = |[a, b, c, d]: [usize; 4]| SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: [a, d, b, c].map(|index| corners[index].extend(1.0).to_array()).to_vec(),
    };
    Model::from_arrays(None, quads.map(surface).to_vec()).unwrap()
}

fn turned(axis: DVec3, degrees: f64, [x, y, z]: [f64; 3]) -> [f64; 12] {
    let turn = DQuat::from_axis_angle(axis, degrees.to_radians());
    let [i, j, k] = DVec3::AXES.map(|axis| turn * axis);
    [i.x, j.x, k.x, x, i.y, j.y, k.y, y, i.z, j.z, k.z, z]
}

const PUSH: [f64; 3] = [0.4, 0.3, 0.2];

#[test]
fn parts_that_stay_move_turn_come_and_go_are_told_apart() {
    let (bracket, cylinder, ball) =
        (wedge(PUSH), shapes::cylinder(0.5, 2.0).unwrap(), shapes::sphere(DVec3::ZERO, 1.0).unwrap());
    let before = [
        ("frame", &bracket, HERE),
        ("arm", &bracket, moved([10.0, 0.0, 0.0])),
        ("lever", &bracket, moved([20.0, 0.0, 0.0])),
        ("pin", &cylinder, moved([0.0, 10.0, 0.0])),
        ("knob", &ball, moved([0.0, 20.0, 0.0])),
    ];
    let axis = DVec3::new(1.0, 2.0, 2.0) / 3.0;
    let after = [
        ("cover", &cylinder, moved([0.0, 0.0, 50.0])),
        ("pin", &cylinder, turned(DVec3::Z, 17.0, [0.0, 10.0, 0.0])),
        ("lever", &bracket, turned(axis, 40.0, [20.0, 0.0, 7.0])),
        ("arm", &bracket, moved([10.0, 0.0, 5.0])),
        ("frame", &bracket, HERE),
    ];
    let parts = diff(&before, &after);
    for (name, expected) in [
        ("frame", PartState::Same),
        ("arm", PartState::Moved),
        ("lever", PartState::Moved),
        ("pin", PartState::Same),
        ("knob", PartState::Removed),
        ("cover", PartState::Added),
    ] {
        assert_eq!(state_of(&parts, name), expected, "{name} in {parts:?}");
    }
    let motion = |name: &str| {
        parts
            .iter()
            .find(|part| part.name_of_a.as_deref() == Some(name))
            .and_then(|part| part.motion)
            .unwrap()
    };
    let arm = motion("arm");
    assert!(
        arm.angle == 0.0 && DVec3::from_array(arm.translation).distance(5.0 * DVec3::Z) < 1e-9,
        "{arm:?}"
    );
    let lever = motion("lever");
    assert!((lever.angle - 40.0).abs() < 1e-6, "{lever:?}");
    assert!(DVec3::from_array(lever.axis).distance(axis) < 1e-7, "{lever:?}");
    // From (20, 0, 0) + x to R x + (20, 0, 7).
    let turn = DQuat::from_axis_angle(axis, 40.0_f64.to_radians());
    let expected = DVec3::new(20.0, 0.0, 7.0) - turn * DVec3::new(20.0, 0.0, 0.0);
    assert!(DVec3::from_array(lever.translation).distance(expected) < 1e-6, "{lever:?}");
}

/// A plane sheet with the outline of an L, at this height; its parameters are x and y, or y and x, and it is cut along
/// the first of them.
fn sheet(height: f64, is_swapped: bool) -> Model {
    let outline = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let swap = |[x, y]: [f64; 2]| if is_swapped { [y, x] } else { [x, y] };
    // Material is on the left in the parameters.
    let mut corners = outline.map(swap);
    if is_swapped {
        corners.reverse();
    }
    let line = |k: usize| TrimCurveArrays {
        degree: 1,
        knots: vec![0.0, 0.0, 1.0, 1.0],
        control_points: [corners[k], corners[(k + 1) % 6]].map(|[u, v]| [u, v, 1.0]).to_vec(),
        ..TrimCurveArrays::default()
    };
    let knots = vec![-1.0, -1.0, 4.0, 4.0];
    let point = |parameters: [f64; 2]| {
        let [x, y] = swap(parameters);
        [x, y, height, 1.0]
    };
    let control_points = [[-1.0, -1.0], [-1.0, 4.0], [4.0, -1.0], [4.0, 4.0]].map(point).to_vec();
    let surface =
        SurfaceArrays { degree: [1, 1], knots: [knots.clone(), knots], counts: [2, 2], control_points };
    let loops = Some(vec![(0..6).map(line).collect()]);
    let face = FaceArrays { reversed: is_swapped, ..FaceArrays::new(surface, loops) };
    let instances = vec![InstanceArrays { surfaces: vec![0], transform: HERE, name: None, solid: None }];
    Model::from_faces(ModelArrays { faces: vec![face], instances, ..ModelArrays::default() }).unwrap()
}

/// A sheet has no centroid and no moments of its volume, the corners of its pieces are those of its cut, and two plane
/// ones whose heights differ in a last digit have boxes without a common point.
#[test]
fn sheets_that_are_cut_in_other_ways_stay_and_move() {
    let ball = shapes::sphere(DVec3::ZERO, 1.0).unwrap();
    let other = ("knob", &ball, moved([0.0, 20.0, 0.0]));
    let (before, after) = (sheet(7.0, false), sheet(7.0 + 1e-10, true));
    let axis = DVec3::new(1.0, 2.0, 2.0) / 3.0;
    for (place, expected) in [
        (HERE, PartState::Renamed),
        (moved([0.5, 4.0, -3.0]), PartState::Moved),
        (turned(axis, 40.0, [1.0, 0.0, 5.0]), PartState::Moved),
    ] {
        let parts = diff(&[other, ("lid", &before, HERE)], &[other, ("cover", &after, place)]);
        let lid = parts.iter().find(|part| part.name_of_a.as_deref() == Some("lid")).unwrap();
        assert_eq!(lid.name_of_b.as_deref(), Some("cover"), "{parts:?}");
        assert_eq!(lid.state, expected, "{parts:?}");
    }
}

#[test]
fn changes_name_their_faces_and_how_far() {
    let (old, new) = (wedge(PUSH), wedge([0.4, 0.3, 0.25]));
    let ball = shapes::sphere(DVec3::ZERO, 1.0).unwrap();
    let other = ("knob", &ball, moved([0.0, 20.0, 0.0]));
    let parts = diff(&[other, ("frame", &old, HERE)], &[other, ("frame", &new, HERE)]);
    assert_eq!([state_of(&parts, "knob"), state_of(&parts, "frame")], [PartState::Same, PartState::Changed]);
    let frame = &parts[1];
    assert!(frame.upper.unwrap() <= 0.0501 && frame.lower.unwrap() > 0.01, "{frame:?}");
    // The ball's faces stand first; of the wedge, the three about the corner changed.
    let first = faces(&ball).len();
    assert_eq!(frame.faces.of_a, [first + 1, first + 3, first + 5]);
    // One that moved, too.
    let parts = diff(&[other, ("frame", &old, HERE)], &[("frame", &new, moved([30.0, 0.0, 0.0])), other]);
    assert_eq!(state_of(&parts, "frame"), PartState::MovedAndChanged, "{parts:?}");
    let frame = parts.iter().find(|part| part.name_of_a.as_deref() == Some("frame")).unwrap();
    assert!(DVec3::from_array(frame.motion.unwrap().translation).distance(30.0 * DVec3::X) < 1e-6);
    assert_eq!(frame.faces.of_a, [first + 1, first + 3, first + 5]);
}

#[test]
fn names_count_only_where_one_is_new() {
    let cylinder = shapes::cylinder(0.5, 2.0).unwrap();
    let at = |x: f64| moved([x, 0.0, 0.0]);
    let before = [("bolt", &cylinder, at(0.0)), ("bolt", &cylinder, at(5.0)), ("bolt", &cylinder, at(10.0))];
    // The first is gone, and the others stand in another order.
    let parts = diff(&before, &[before[2], before[1]]);
    let states: Vec<_> = parts.iter().map(|part| part.state).collect();
    assert_eq!(states, [PartState::Removed, PartState::Same, PartState::Same]);
    let (x, y) = (("left", &cylinder, at(0.0)), ("right", &cylinder, at(5.0)));
    let swapped = [("right", &cylinder, at(0.0)), ("left", &cylinder, at(5.0))];
    let states: Vec<_> = diff(&[x, y], &swapped).iter().map(|part| part.state).collect();
    assert_eq!(states, [PartState::Same, PartState::Same]);
    let parts = diff(&[x, y], &[x, ("starboard", &cylinder, at(5.0))]);
    assert_eq!(state_of(&parts, "right"), PartState::Renamed);
    assert_eq!(parts[1].name_of_b.as_deref(), Some("starboard"));
}

/// Two parts of different shapes exchange their names.
#[test]
fn exchanged_names_of_different_parts_are_named() {
    let (cylinder, ball) = (shapes::cylinder(0.5, 2.0).unwrap(), shapes::sphere(DVec3::ZERO, 1.0).unwrap());
    let far = moved([9.0, 0.0, 0.0]);
    let before = [("left", &cylinder, HERE), ("right", &ball, far)];
    let after = [("right", &cylinder, HERE), ("left", &ball, far)];
    let parts = diff(&before, &after);
    assert_eq!([state_of(&parts, "left"), state_of(&parts, "right")], [PartState::Renamed; 2]);
    assert_eq!(parts[0].name_of_b.as_deref(), Some("right"));
}

/// A ball of radius 1 fills the void of a ball of radius 2. Its boundary is that of the void, so that no face changes if the
/// ball is removed.
#[test]
fn a_part_without_a_face_of_its_own_is_missed() {
    let ball = |radius| shapes::sphere(DVec3::ZERO, radius).unwrap();
    let mut shell = faces(&ball(2.0));
    shell.extend(faces(&ball(1.0)).into_iter().map(|face| FaceArrays { reversed: !face.reversed, ..face }));
    let (hollow, core) = (of(shell), ball(1.0));
    let other = ("knob", &core, moved([0.0, 20.0, 0.0]));
    let [with, without] =
        [&[("shell", &hollow, HERE), other, ("core", &core, HERE)][..], &[("shell", &hollow, HERE), other]]
            .map(assembly);
    let compared = |a, b| Engine::cpu().diff(a, b, &DiffOptions::default()).wait().unwrap();
    for (a, b, state) in [(&with, &without, PartState::Removed), (&without, &with, PartState::Added)] {
        let result = compared(a, b);
        assert_eq!(state_of(&result.parts, "core"), state, "{:?}", result.parts);
        assert!(
            result.faces_of_a.iter().chain(&result.faces_of_b).all(|face| face.state == FaceState::Unchanged)
        );
        assert_eq!([result.state, result.with_gaps], [FaceState::Changed; 2]);
    }
    assert_eq!(compared(&with, &with).state, FaceState::Unchanged);
}

#[test]
fn a_mirror_image_is_no_motion() {
    let bracket = wedge(PUSH);
    let mirror = [-1.0, 0.0, 0.0, 8.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 2.0];
    let other = ("knob", &shapes::sphere(DVec3::ZERO, 1.0).unwrap(), moved([0.0, 20.0, 0.0]));
    let parts = diff(&[("left", &bracket, HERE), other], &[("right", &bracket, mirror), other]);
    assert_eq!(state_of(&parts, "left"), PartState::Mirrored, "{parts:?}");
    let motion = parts[0].motion.unwrap();
    assert!(DVec3::from_array(motion.translation).distance(DVec3::new(8.0, 1.0, 2.0)) < 1e-6, "{motion:?}");
    // Of x from 0 to 3.4 the mirror image reaches from 4.6 to 8.
    assert!(DVec3::from_array(motion.shift).distance(DVec3::new(4.6, 1.0, 2.0)) < 1e-6, "{motion:?}");
    assert!(motion.angle < 1e-6, "{motion:?}");
}

/// A single part has one entry, and the motion of the options is none of its own.
#[test]
fn single_parts_have_one_entry() {
    let bracket = wedge(PUSH);
    let model = prepared(&bracket);
    let options = |x: f64| DiffOptions {
        transform: RigidTransform::translation(DVec3::new(x, 0.0, 0.0)).unwrap(),
        ..DiffOptions::default()
    };
    let of = |b: &PreparedModel, x: f64| Engine::cpu().diff(&model, b, &options(x)).wait().unwrap().parts;
    let placed = assembly(&[("body 1", &bracket, moved([4.0, 0.0, 0.0]))]);
    let [part] = &of(&model, 0.0)[..] else { panic!() };
    assert_eq!((part.state, part.name_of_a.as_deref()), (PartState::Same, Some("body 1")));
    let states = [4.0, 1.0].map(|x| of(&placed, x)[0].state);
    assert_eq!(states, [PartState::Same, PartState::Moved]);
    let motion = of(&placed, 1.0)[0].motion.unwrap();
    assert!(DVec3::from_array(motion.translation).distance(3.0 * DVec3::X) < 1e-9, "{motion:?}");
}

/// A caller that gives up once all faces are compared.
struct AfterFaces {
    is_cancelled: bool,
}

impl Monitor for AfterFaces {
    fn progress(&mut self, fraction: f64) {
        self.is_cancelled |= fraction >= 1.0;
    }

    fn cancelled(&self) -> bool {
        self.is_cancelled
    }
}

#[test]
fn the_search_for_motions_is_cancelled() {
    let bracket = wedge(PUSH);
    let models = [HERE, moved([5.0, 0.0, 0.0])].map(|place| assembly(&[("arm", &bracket, place)]));
    let mut monitor = AfterFaces { is_cancelled: false };
    let (engine, options) = (Engine::cpu(), DiffOptions::default());
    let result = engine.diff(&models[0], &models[1], &options).monitored(&mut monitor).wait();
    assert_eq!(result.map(|found| found.parts).unwrap_err().code(), "CANCELLED");
}

#[test]
fn parts_that_there_was_no_time_for_are_said() {
    let bracket = wedge(PUSH);
    let models = [HERE, moved([5.0, 0.0, 0.0])].map(|place| assembly(&[("arm", &bracket, place)]));
    let of = |max_seconds| {
        let options = DiffOptions { max_seconds, ..DiffOptions::default() };
        let found = Engine::cpu().diff(&models[0], &models[1], &options).wait().unwrap();
        (found.parts.len(), found.parts_unknown)
    };
    assert_eq!(of(Some(1e-9)), (0, Some(PartsUnknown::Budget)));
    assert_eq!(of(None), (1, None));
}
