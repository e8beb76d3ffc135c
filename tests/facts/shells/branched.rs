//! Bodies with edges at which more than two faces meet. Their volumes do not depend on the order of their faces, or no
//! volume is stated.

use crate::models::{
    Quad, box_of_faces, cube_with_pocket, faces, mesh, of, of_quads, prepared, quads_of_box,
};
use crate::overlap::{assert_holds, overlap};
use nurbs_hausdorff::{CheckOptions, DVec3, Engine, NamedModel, PreparedModel, VolumesUnknown};

/// The permitted width of a common volume, relative to the union.
const TOLERANCE: f64 = 1e-3;

fn cube(low: [f64; 3], side: f64) -> [Quad; 6] {
    let low = DVec3::from_array(low);
    quads_of_box(low, low + side)
}

/// Two unit cubes that share an edge.
fn beside_an_edge() -> Vec<Quad> {
    [cube([0.0; 3], 1.0), cube([1.0, 1.0, 0.0], 1.0)].concat()
}

/// A large cube about both.
fn around() -> PreparedModel {
    prepared(&box_of_faces(DVec3::splat(-1.0), DVec3::splat(3.0)))
}

fn triangles_of(quads: &[Quad], random: &mut fastrand::Rng) -> PreparedModel {
    let mut triangles: Vec<[DVec3; 3]> =
        quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    random.shuffle(&mut triangles);
    let corners = triangles.concat();
    let numbers: Vec<[u32; 3]> =
        (0..triangles.len() as u32).map(|index| [0, 1, 2].map(|corner| 3 * index + corner)).collect();
    mesh(&corners, &numbers)
}

/// The model of these faces in some order, as surfaces and as triangles.
fn in_some_order(mut quads: Vec<Quad>, random: &mut fastrand::Rng) -> [PreparedModel; 2] {
    let triangles = triangles_of(&quads, random);
    random.shuffle(&mut quads);
    [prepared(&of_quads(&quads)), triangles]
}

/// Asserts that the volume of a model of this one is in its interval, and so is that of the part in a cube about it.
fn assert_volume(model: &PreparedModel, expected: f64, seed: u64) {
    let volume = model.facts().volume.unwrap();
    assert!(volume.contains(expected) && volume.width() < 1e-9, "{volume:?} of order {seed}");
    let found = overlap(model, &around(), TOLERANCE);
    if found.volumes_unknown != Some(VolumesUnknown::ABodies) {
        assert_holds(&found, [expected, 64.0, expected], TOLERANCE);
    }
}

/// The cubes share two corners and no face: their volume is the sum, whichever faces are taken for neighbours.
#[test]
fn cubes_that_share_an_edge_have_the_volume_of_both() {
    for seed in 0..40 {
        let random = &mut fastrand::Rng::with_seed(seed);
        for model in in_some_order(beside_an_edge(), random) {
            assert_volume(&model, 2.0, seed);
        }
    }
}

/// Half of the faces are turned over by their parameters, and back by what the file says of them.
#[test]
fn sides_are_those_that_the_file_states() {
    for seed in 0..40 {
        let random = &mut fastrand::Rng::with_seed(seed);
        let mut quads = beside_an_edge();
        random.shuffle(&mut quads);
        let reversed: Vec<bool> = quads.iter().map(|_| random.bool()).collect();
        let turned = |(&[a, b, c, d], &reversed): (&Quad, &bool)| {
            if reversed { [d, c, b, a] } else { [a, b, c, d] }
        };
        let turned: Vec<Quad> = quads.iter().zip(&reversed).map(turned).collect();
        let mut faces = faces(&of_quads(&turned));
        faces.iter_mut().zip(&reversed).for_each(|(face, &reversed)| face.reversed = reversed);
        assert_volume(&prepared(&of(faces)), 2.0, seed);
    }
}

/// Their common sides lie on each other.
#[test]
fn flush_cubes_have_the_volume_of_both() {
    for seed in 0..40 {
        let random = &mut fastrand::Rng::with_seed(seed);
        let quads = [cube([0.0; 3], 1.0), cube([1.0, 0.0, 0.0], 1.0)].concat();
        for model in in_some_order(quads, random) {
            assert_volume(&model, 2.0, seed);
        }
    }
}

/// Where faces are turned over at random, it is not known which of the four at the edge belong together: no volume, or the
/// right one.
#[test]
fn no_volume_is_stated_where_sides_are_guessed() {
    let mut stated = 0;
    for seed in 0..40 {
        let random = &mut fastrand::Rng::with_seed(seed);
        let turned = beside_an_edge()
            .into_iter()
            .map(|[a, b, c, d]| if random.bool() { [d, c, b, a] } else { [a, b, c, d] });
        let turned: Vec<Quad> = turned.collect();
        for model in in_some_order(turned, random) {
            let facts = model.facts();
            assert!(
                facts.volume.is_none_or(|volume| volume.contains(2.0)),
                "{:?} of order {seed}",
                facts.volume
            );
            stated += usize::from(facts.volume.is_some());
        }
    }
    assert!(stated < 80, "all are stated");
}

/// A cube that stands twice in a model encloses its space twice. No volume in common is stated: the boundary meets itself,
/// or both copies are bodies that overlap.
#[test]
fn a_cube_that_stands_twice_shares_no_volume() {
    for seed in 0..40 {
        let random = &mut fastrand::Rng::with_seed(seed);
        let quads = [cube([0.0; 3], 1.0), cube([0.0; 3], 1.0)].concat();
        for model in in_some_order(quads, random) {
            let found = overlap(&model, &around(), TOLERANCE);
            assert!(found.volumes.is_none(), "{found:?} of order {seed}");
        }
    }
}

/// The same of triangles that are no copies of each other: the sides of one cube are cut along the other diagonals.
#[test]
fn a_cube_that_stands_twice_in_other_triangles_shares_no_volume() {
    let mut crossed = 0;
    for seed in 0..40 {
        let random = &mut fastrand::Rng::with_seed(seed);
        let other = cube([0.0; 3], 1.0).map(|[a, b, c, d]| [b, c, d, a]);
        let model = triangles_of(&[cube([0.0; 3], 1.0), other].concat(), random);
        let found = overlap(&model, &around(), TOLERANCE);
        assert!(found.volumes.is_none(), "{found:?} of order {seed}");
        crossed += usize::from(found.volumes_unknown == Some(VolumesUnknown::ACrossed));
    }
    assert!(crossed > 0, "all are bodies of their own");
}

/// A pocket through the floor winds -1 times about what is below: no set has the sum of the fluxes as its volume.
#[test]
fn a_body_that_crosses_itself_shares_no_volume() {
    let block = prepared(&box_of_faces(DVec3::new(-5.0, -5.0, 0.0), DVec3::new(5.0, 5.0, 10.0)));
    let (through, within) = (12.0, 8.0);
    let random = &mut fastrand::Rng::with_seed(1);
    for model in in_some_order(cube_with_pocket(through), random) {
        let found = overlap(&model, &block, TOLERANCE);
        assert_eq!(found.volumes_unknown, Some(VolumesUnknown::ACrossed));
        let found = overlap(&block, &model, TOLERANCE);
        assert_eq!(found.volumes_unknown, Some(VolumesUnknown::BCrossed));
        let models = [&model, &block].map(|model| NamedModel { name: None, model });
        let result = Engine::cpu().check(&models, &CheckOptions::default()).wait().unwrap();
        assert!(result.pairs.iter().all(|pair| pair.volume.is_none()), "{:?}", result.pairs);
    }
    for model in in_some_order(cube_with_pocket(within), random) {
        let volume = 1000.0 - 16.0 * within;
        assert_holds(&overlap(&model, &block, TOLERANCE), [volume, 1000.0, volume], TOLERANCE);
    }
}
