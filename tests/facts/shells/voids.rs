//! Shells that the source orients as voids and that touch the shell about them: whether they are voids is not known, and
//! nothing is stated that depends on it.

use super::{block, check, of_solids, turned};
use crate::models::{Quad, faces, mesh, moved, of, of_quads, placed_all, prepared, quads_of_box};
use nurbs_hausdorff::shapes::{cylinder, sphere};
use nurbs_hausdorff::{
    DVec3, InstanceArrays, Model, ModelArrays, OverlapUnknown, PairState, PreparedModel, Side, VolumeUnknown,
};
use std::f64::consts::PI;

/// Builds one model of several shells. The faces carry the number of their shell and no solid.
fn of_shells(shells: &[Vec<Quad>]) -> PreparedModel {
    let faces = shells.iter().enumerate().flat_map(|(number, quads)| {
        faces(&of_quads(quads)).into_iter().map(move |mut face| {
            face.shell = Some(number as u32);
            face
        })
    });
    prepared(&of(faces.collect()))
}

/// A cube of side 3, and a unit cube in it that touches it: along a side, along an edge, in a corner of it, or beyond it
/// by less than the distance up to which edges are joined.
fn cube_with_touching() -> Vec<[Vec<Quad>; 2]> {
    let whole = block([0.0; 3], [3.0; 3]);
    let places = [[1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0; 3], [1.0, 1.0, -1e-6]];
    places.map(|low| [whole.clone(), block(low, low.map(|at| at + 1.0))]).to_vec()
}

#[test]
fn what_may_be_a_void_leaves_the_volume_open() {
    for [outer, inner] in cube_with_touching() {
        let model = of_shells(&[outer, turned(&inner)]);
        assert_eq!(model.facts().volume_unknown, Some(VolumeUnknown::Nesting));
        assert_eq!(model.facts().volume, None);
        assert_eq!(model.side([2.5; 3]), Side::Inside);
        let middle = inner.iter().flatten().sum::<DVec3>() / 24.0;
        assert_eq!(model.side(middle.to_array()), Side::Undecided);
        let result = check(&model);
        let [pair] = &result.pairs[..] else { panic!("{:?}", result.pairs) };
        assert_eq!((pair.state, pair.why), (PairState::Undecided, Some(OverlapUnknown::Side)));
        assert_eq!((result.clean, pair.volume, pair.depth), (None, None, None));
    }
}

/// The same shells, of which the source orients both as bodies.
#[test]
fn bodies_that_touch_from_within_overlap() {
    for [outer, inner] in cube_with_touching() {
        let model = of_shells(&[outer, inner]);
        assert!(model.facts().volume.is_some_and(|volume| volume.contains(28.0)), "{:?}", model.facts());
        let result = check(&model);
        assert!(matches!(result.pairs[..], [ref pair] if pair.state == PairState::Clash));
        assert_eq!(result.clean, Some(false));
    }
}

/// A shell that does not touch is a void of the body about it however it is oriented.
#[test]
fn a_void_that_is_apart_is_one() {
    let [outer, inner] = [block([0.0; 3], [3.0; 3]), block([1.0; 3], [2.0; 3])];
    for inner in [turned(&inner), inner] {
        let model = of_shells(&[outer.clone(), inner]);
        assert!(model.facts().volume.is_some_and(|volume| volume.contains(26.0)), "{:?}", model.facts());
        assert!(check(&model).pairs.is_empty());
    }
}

/// A ball in a cube, whose control points are outside of it: turned by 45 degrees about an axis of the cube, they reach
/// out to √2 times the radius.
#[test]
fn a_void_whose_control_points_are_outside_is_one() {
    let (half, side) = (0.5_f64.sqrt(), 2.2);
    let turned = [half, -half, 0.0, 0.0, half, half, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let cube = of_quads(&quads_of_box(DVec3::splat(-0.5 * side), DVec3::splat(0.5 * side)));
    let ball = sphere(DVec3::ZERO, 1.0).unwrap();
    let model = prepared(&placed_all(&[(&cube, moved([0.0; 3])), (&ball, turned)]));
    assert_eq!(model.bodies().iter().map(|body| body.voids).collect::<Vec<_>>(), [1]);
    let expected = side.powi(3) - 4.0 * PI / 3.0;
    assert!(model.facts().volume.is_some_and(|volume| volume.contains(expected)), "{:?}", model.facts());
    assert!(check(&model).pairs.is_empty());
    // And one that is beside it, in the box of its control points.
    let small = of_quads(&quads_of_box(DVec3::new(1.0, 1.0, 0.0), DVec3::new(1.05, 1.05, 0.05)));
    let model = prepared(&placed_all(&[(&small, moved([0.0; 3])), (&ball, turned)]));
    assert_eq!(model.bodies().iter().map(|body| body.voids).collect::<Vec<_>>(), [0, 0]);
}

/// A sheet in the material of a cube, whose control points are outside of that: it is neither apart nor near.
#[test]
fn a_sheet_within_a_solid_is_not_judged() {
    let (half, side) = (0.5_f64.sqrt(), 2.2);
    let turned = [half, -half, 0.0, 0.0, half, half, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let cube = of_quads(&quads_of_box(DVec3::splat(-0.5 * side), DVec3::splat(0.5 * side)));
    // The lateral face alone, without the discs.
    let walls = of(faces(&cylinder(1.0, 1.6).unwrap())[..1].to_vec());
    let model = prepared(&placed_all(&[(&cube, moved([0.0; 3])), (&walls, turned)]));
    let closed: Vec<bool> = model.bodies().iter().map(|body| body.closed).collect();
    assert_eq!(closed, [true, false]);
    let result = check(&model);
    assert!(matches!(result.pairs[..], [ref pair] if pair.state == PairState::Undecided), "{result:?}");
}

/// The same of triangles that share no corners: the void touches along an edge.
#[test]
fn triangles_that_may_bound_a_void_have_no_volume() {
    let quads = [block([0.0; 3], [3.0; 3]), turned(&block([1.0, 0.0, 0.0], [2.0, 1.0, 1.0]))].concat();
    let corners: Vec<DVec3> =
        quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).flatten().collect();
    let numbers: Vec<[u32; 3]> =
        (0..corners.len() as u32 / 3).map(|index| [0, 1, 2].map(|corner| 3 * index + corner)).collect();
    let facts = mesh(&corners, &numbers).facts().clone();
    assert_eq!((facts.volume, facts.volume_unknown), (None, Some(VolumeUnknown::Nesting)));
}

/// A housing of side 4 with a cavity of side 2, and a unit cube within the cavity whose lower side is at this height: on its
/// floor, above it, and pressed into it.
fn seated(height: f64) -> [Vec<Quad>; 3] {
    let cavity = turned(&block([1.0; 3], [3.0; 3]));
    [block([0.0; 3], [4.0; 3]), cavity, block([1.5, 1.5, height], [2.5, 2.5, height + 1.0])]
}

/// A part that meets the wall of a cavity is a body, as its faces turn the way that those of the housing do.
#[test]
fn a_part_at_the_wall_of_a_cavity_is_a_body() {
    for (height, expected) in [
        (1.0, PairState::Touching),
        (1.5, PairState::Apart),
        (0.75, PairState::Clash),
        (2.25, PairState::Clash),
    ] {
        let model = of_shells(&seated(height));
        assert_eq!(model.bodies().iter().map(|body| body.voids).collect::<Vec<_>>(), [1, 0], "{height}");
        assert!(model.facts().volume.is_some_and(|volume| volume.contains(57.0)), "{:?}", model.facts());
        // In the part, and where it is in the housing, too; beside it in the cavity, and in the housing.
        let sides = [height + 0.5, height + 0.125].map(|z| model.side([2.0, 2.0, z]));
        assert_eq!(sides, [Side::Inside; 2], "{height}");
        assert_eq!(model.side([1.25, 1.25, 2.0]), Side::Outside);
        assert_eq!(model.side([0.5; 3]), Side::Inside);
        let result = check(&model);
        let states: Vec<PairState> = result.pairs.iter().map(|pair| pair.state).collect();
        assert_eq!(states, [expected], "{height}");
        if expected == PairState::Clash {
            assert!(result.pairs[0].volume.is_some_and(|volume| volume.contains(0.25)), "{result:?}");
        }
    }
}

/// Where faces are turned over, nothing tells the part from a void, nor where it fills the cavity. What two voids have in
/// common would be taken off twice.
#[test]
fn what_the_source_does_not_tell_is_not_stated() {
    let [housing, cavity, mut part] = seated(0.75);
    let void = turned(&part);
    part[0].reverse();
    let full = block([1.0; 3], [3.0; 3]);
    for inner in [part, full, void] {
        let model = of_shells(&[housing.clone(), cavity.clone(), inner]);
        assert_eq!(model.facts().volume_unknown, Some(VolumeUnknown::Nesting));
        assert_eq!(check(&model).clean, None);
    }
}

/// A bolt in a plate without a hole, wherever its faces turn: a solid of its own, and no void.
#[test]
fn a_solid_within_another_one_is_a_body_that_clashes() {
    let (plate, bolt) = (block([0.0; 3], [4.0, 4.0, 2.0]), block([1.0, 1.0, 0.5], [2.0, 2.0, 1.5]));
    for bolt in [turned(&bolt), bolt] {
        let model = of_solids(&[std::slice::from_ref(&plate), &[bolt]]);
        assert!(model.facts().volume.is_some_and(|volume| volume.contains(33.0)), "{:?}", model.facts());
        assert_eq!([[1.5, 1.5, 1.0], [3.0, 3.0, 1.0]].map(|point| model.side(point)), [Side::Inside; 2]);
        let result = check(&model);
        let [pair] = &result.pairs[..] else { panic!("{:?}", result.pairs) };
        assert_eq!(pair.state, PairState::Clash);
        assert!(pair.volume.is_some_and(|volume| volume.contains(1.0)), "{pair:?}");
    }
}

/// A cavity that a placed tool cut: its faces are another instance, of the same solid. Without that statement they are a
/// solid of their own.
#[test]
fn instances_may_be_of_one_solid() {
    let numbered = |quads: &[Quad], shell: u32| {
        faces(&of_quads(quads)).into_iter().map(move |mut face| {
            (face.solid, face.shell) = (Some(0), Some(shell));
            face
        })
    };
    let [outer, inner] = [block([0.0; 3], [4.0; 3]), turned(&block([0.0; 3], [1.0; 3]))];
    for (number, expected) in [(Some(5), 63.0), (None, 65.0)] {
        let instance = |surfaces: std::ops::Range<usize>, at: f64| InstanceArrays {
            surfaces: surfaces.collect(),
            transform: [1.0, 0.0, 0.0, at, 0.0, 1.0, 0.0, at, 0.0, 0.0, 1.0, at],
            name: None,
            solid: number,
        };
        let arrays = ModelArrays {
            faces: numbered(&outer, 0).chain(numbered(&inner, 1)).collect(),
            instances: vec![instance(0..6, 0.0), instance(6..12, 1.5)],
            ..ModelArrays::default()
        };
        let facts = prepared(&Model::from_faces(arrays).unwrap()).facts().clone();
        assert!(facts.volume.is_some_and(|found| found.contains(expected)), "{facts:?}");
    }
}

/// A solid has lost a face of its outer shell, so that its cavity is not known to be a void. The cavity clashes with no
/// other body for certain.
#[test]
fn a_void_of_an_open_solid_is_no_body_for_certain() {
    let [housing, cavity, part] = seated(1.5);
    let model = of_solids(&[&[housing[1..].to_vec(), cavity], &[part]]);
    let result = check(&model);
    assert!(result.pairs.iter().all(|pair| pair.state != PairState::Clash), "{:?}", result.pairs);
    let stated: Vec<bool> = model.body_facts().map(|facts| facts.volume.is_some()).collect();
    assert_eq!(stated, [false, false, true]);
}

/// Two shells that meet in the material of a third one, with its normals, may be voids of it as one alone would be.
#[test]
fn shells_that_meet_in_material_are_not_told() {
    let [housing, _, part] = seated(1.25);
    let model = of_shells(&[housing, part, block([1.5, 1.5, 2.25], [2.5, 2.5, 2.75])]);
    assert_eq!(model.facts().volume_unknown, Some(VolumeUnknown::Nesting));
    assert!(check(&model).pairs.iter().all(|pair| pair.state != PairState::Clash));
    assert_eq!([[2.0, 2.0, 1.5], [2.0, 2.0, 2.5]].map(|point| model.side(point)), [Side::Undecided; 2]);
    assert_eq!(model.side([0.5, 0.5, 0.5]), Side::Inside);
}

/// Of two parts that touch in a cavity one is inside out: it is no void, as the cavity is one.
#[test]
fn no_void_lies_in_a_void() {
    let [housing, cavity, part] = seated(1.25);
    let beside = block([1.5, 1.5, 2.25], [2.5, 2.5, 2.75]);
    for inner in [turned(&beside), beside] {
        let model = of_shells(&[housing.clone(), cavity.clone(), part.clone(), inner.clone()]);
        let volume = model.facts().volume;
        assert!(volume.is_none_or(|volume| volume.contains(57.5)), "{volume:?}");
        assert!(check(&model).pairs.iter().all(|pair| pair.state != PairState::Clash));
    }
}

/// A closed shell that is of no solid, about a solid and within one, is no void and has none.
#[test]
fn a_loose_shell_is_no_void_of_a_solid() {
    let [large, small] = [block([0.0; 3], [4.0; 3]), block([1.0; 3], [2.0; 3])];
    for (loose, solid) in [(&large, &small), (&small, &large)] {
        let mut all = faces(&of_quads(loose));
        all.extend(faces(&of_quads(solid)).into_iter().map(|mut face| {
            (face.solid, face.shell) = (Some(0), Some(0));
            face
        }));
        let model = prepared(&of(all));
        assert_eq!(model.bodies().len(), 2);
        assert_eq!([[1.5; 3], [3.0; 3]].map(|point| model.side(point)), [Side::Inside; 2]);
        assert!(model.facts().volume.is_some_and(|volume| volume.contains(65.0)), "{:?}", model.facts());
    }
}

/// An insert that fills the cavity of its housing, and one that stands in it: the cavity is a void of the housing.
#[test]
fn a_void_is_one_of_its_own_solid() {
    let [housing, cavity, _] = seated(1.0);
    let (full, part) = (block([1.0; 3], [3.0; 3]), block([1.0; 3], [2.0; 3]));
    for (insert, volume) in [(full, 64.0), (part, 57.0)] {
        let model = of_solids(&[&[housing.clone(), cavity.clone()], &[insert]]);
        assert_eq!(model.bodies().iter().map(|body| body.voids).collect::<Vec<_>>(), [1, 0]);
        assert!(model.facts().volume.is_some_and(|found| found.contains(volume)), "{:?}", model.facts());
        assert_eq!(model.side([1.5; 3]), Side::Inside);
        let result = check(&model);
        assert!(matches!(result.pairs[..], [ref pair] if pair.state == PairState::Touching), "{result:?}");
        let beside = if volume > 60.0 { Side::Inside } else { Side::Outside };
        assert_eq!(model.side([2.5; 3]), beside);
    }
}

/// Two bodies with voids that overlap: no volume of one is stated without its void, and no void clashes with its body.
#[test]
fn a_hollow_body_that_stands_twice_has_no_volume_without_its_void() {
    let hollow = [block([0.0; 3], [4.0; 3]), turned(&block([1.5; 3], [2.5; 3]))];
    for offset in [0.0, 1.0] {
        let moved = hollow.clone().map(|quads| quads.iter().map(|quad| quad.map(|at| at + offset)).collect());
        let [a, b] = [hollow.clone(), moved];
        let model = of_shells(&[a, b].concat());
        assert!(model.body_facts().all(|facts| facts.volume.is_none()));
        let result = check(&model);
        // A point found in both bodies may be in a void of one of them.
        let name = |body: usize| result.bodies[body].name.as_str();
        for pair in &result.pairs {
            let is_of_bodies = (pair.a.as_str(), pair.b.as_str()) == (name(0), name(2));
            assert!(is_of_bodies || pair.state != PairState::Clash, "{offset}: {pair:?}");
        }
        assert_ne!(result.clean, Some(true));
    }
}

/// A shell within two bodies that overlap may be a void of either.
#[test]
fn a_void_in_the_common_part_of_two_bodies_may_be_of_either() {
    let [a, b] = [block([0.0; 3], [4.0; 3]), block([1.0; 3], [5.0; 3])];
    let model = of_shells(&[a, b, turned(&block([2.0; 3], [3.0; 3]))]);
    assert!(model.body_facts().all(|facts| facts.volume_unknown == Some(VolumeUnknown::Nesting)));
    assert_eq!(model.body_facts().len(), 3);
    let result = check(&model);
    for pair in &result.pairs {
        let is_of_bodies = pair.a == result.bodies[0].name && pair.b == result.bodies[1].name;
        assert!(is_of_bodies || pair.state == PairState::Undecided, "{pair:?}");
        let is_in_void = pair.point.iter().all(|at| (2.0..=3.0).contains(at));
        assert!(pair.state != PairState::Clash || !is_in_void, "{pair:?}");
        assert_eq!((pair.volume, pair.depth), (None, None));
    }
}
