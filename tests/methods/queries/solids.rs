//! Sides of points and signs of deviations against bodies known from formulas.

use glam::DVec3;
use nurbs_hausdorff::internals::engine::{Engine, PreparedModel};
use nurbs_hausdorff::shapes::operations::part;
use nurbs_hausdorff::shapes::{cone, cylinder, sphere, torus};
use nurbs_hausdorff::{
    ClosestPointOptions, DeviationField, Facets, FieldOptions, Model, NurbsSurface, Side, Signs,
    SurfaceArrays, TriangleMesh,
};

/// Numbers in [0, 1) from a seed, by SplitMix64.
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(super) fn within(&mut self, half: f64) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|_| half * (2.0 * self.next() - 1.0)))
    }
}

/// A plane face with these corners, the third one twice for a triangle.
pub(super) fn face(corners: [DVec3; 4]) -> SurfaceArrays {
    SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: [corners[0], corners[1], corners[3], corners[2]]
            .map(|corner| [corner.x, corner.y, corner.z, 1.0])
            .to_vec(),
    }
}

/// The faces of the box [-half, half]³, oriented at random: those across x, then y, then z.
pub(super) fn cube(half: f64) -> Vec<SurfaceArrays> {
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let side = |axis: usize, end: f64| {
        let corner = |a: f64, b: f64| match axis {
            0 => at(end, a, b),
            1 => at(a, end, b),
            _ => at(a, b, end),
        };
        face([corner(-half, -half), corner(half, -half), corner(half, half), corner(-half, half)])
    };
    (0..6).map(|index| side(index / 2, if index % 2 == 0 { -half } else { half })).collect()
}

fn tetrahedron(scale: f64) -> Model {
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]]
        .map(|corner| scale * DVec3::from_array(corner));
    let faces = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]]
        .map(|[i, j, k]| face([corners[i], corners[j], corners[k], corners[k]]));
    Model::from_arrays(None, faces.to_vec()).unwrap()
}

fn prepared(model: &Model) -> PreparedModel {
    PreparedModel::new(model).unwrap()
}

pub(super) fn together(models: &[&Model]) -> Model {
    let surfaces: Vec<NurbsSurface> = models.iter().flat_map(|model| model.surfaces()).cloned().collect();
    Model::new(None, surfaces).unwrap()
}

/// The sides of random points by the sign of a function that is negative inside and has slope 1.
fn assert_sides(name: &str, model: &Model, half: f64, depth: impl Fn(DVec3) -> f64) {
    let model = prepared(model);
    assert!(model.solid().closed, "{name}: {:?}", model.solid().free_edges);
    let mut random = Random(11);
    for index in 0..10_000 {
        let mut point = random.within(half);
        if index % 2 == 0 {
            // Toward the boundary, which it then is nearer to than 1e-3, on either side.
            for _ in 0..60 {
                let step = 1e-4;
                let slope = [DVec3::X, DVec3::Y, DVec3::Z]
                    .map(|axis| (depth(point + step * axis) - depth(point - step * axis)) / (2.0 * step));
                point -= 0.5 * depth(point) * DVec3::from_array(slope);
            }
            point += random.within(1e-3);
        }
        let expected = depth(point);
        if expected.abs() < 1e-9 {
            continue;
        }
        let side = if expected < 0.0 { Side::Inside } else { Side::Outside };
        assert_eq!(model.side(point.to_array()), side, "{name}: {point} at {expected:e}");
    }
}

fn depth_of_cube(point: DVec3) -> f64 {
    let excess = point.abs() - 1.0;
    if excess.max_element() > 0.0 { excess.max(DVec3::ZERO).length() } else { excess.max_element() }
}

#[test]
fn points_of_bodies_of_revolution() {
    assert_sides("sphere", &sphere(DVec3::ZERO, 1.0).unwrap(), 1.3, |point| point.length() - 1.0);
    assert_sides("torus", &torus(2.0, 0.6).unwrap(), 2.8, |point| {
        let radius = point.truncate().length() - 2.0;
        radius.hypot(point.z) - 0.6
    });
}

#[test]
fn points_of_bodies_with_plane_faces() {
    assert_sides("cylinder", &cylinder(1.0, 3.0).unwrap(), 1.8, |point| {
        let [out, up] = [point.truncate().length() - 1.0, point.z.abs() - 1.5];
        if out > 0.0 && up > 0.0 { out.hypot(up) } else { out.max(up) }
    });
    // The slant of a cone of radius 1 and height 2 has the normal (2, 1) / √5.
    assert_sides("cone", &cone(1.0, 2.0).unwrap(), 1.3, |point| {
        let radius = point.truncate().length();
        (((radius - 1.0) * 2.0 + (point.z + 1.0)) / 5.0_f64.sqrt()).max(-1.0 - point.z)
    });
}

/// A body with one void, a solid in it, and a second body that is turned inside out.
#[test]
fn solids_in_voids_and_beside_each_other() {
    let balls = [1.0, 0.7, 0.4].map(|radius| sphere(DVec3::ZERO, radius).unwrap());
    let mut reversed = sphere(DVec3::new(3.0, 0.0, 0.0), 1.0).unwrap().surfaces()[0].clone().into_arrays();
    for row in reversed.control_points.chunks_exact_mut(reversed.counts[1]) {
        row.reverse();
    }
    let other = Model::from_arrays(None, vec![reversed]).unwrap();
    let all = together(&[&balls[0], &balls[1], &balls[2], &other]);
    assert_sides("nested and beside", &all, 4.2, |point| {
        let nested = (point.length() - 0.85).abs() - 0.15;
        nested.min(point.length() - 0.4).min(point.distance(DVec3::new(3.0, 0.0, 0.0)) - 1.0)
    });
    let solid = prepared(&all).solid();
    assert_eq!(
        solid.shells.iter().map(|shell| shell.faces.clone()).collect::<Vec<_>>(),
        [[0], [1], [2], [3]]
    );
}

/// Bodies of one file that overlap, or the same body twice, have their common part inside. It is not known whether a ball
/// within both is a void of one of them, nor which of two that overlap within a third one is a void.
#[test]
fn bodies_that_overlap_are_united() {
    let at = |x: f64, radius: f64| sphere(DVec3::new(x, 0.0, 0.0), radius).unwrap();
    let (one, other, small) = (at(0.0, 1.0), at(0.8, 1.0), at(0.4, 0.1));
    let depth = |point: DVec3| (point.length() - 1.0).min(point.distance(DVec3::new(0.8, 0.0, 0.0)) - 1.0);
    assert_sides("two balls", &together(&[&one, &other]), 1.9, depth);
    assert_sides("a ball twice", &together(&[&one, &one]), 1.3, |point| point.length() - 1.0);
    let twice = [cube(1.0), cube(1.0)].concat();
    assert_sides("a box twice", &Model::from_arrays(None, twice).unwrap(), 1.4, depth_of_cube);
    let three = prepared(&together(&[&one, &other, &small]));
    assert_eq!(three.solid().shells.len(), 3);
    assert_eq!(three.side([0.4, 0.0, 0.0]), Side::Undecided);
    assert_eq!(three.side([0.4, 0.2, 0.0]), Side::Inside);
    assert_eq!(three.side([-0.8, 0.0, 0.0]), Side::Inside);
    let three = prepared(&together(&[&one, &other, &at(0.4, 3.0)]));
    assert_eq!([-0.8, 0.4, 1.6].map(|x| three.side([x, 0.0, 0.0])), [Side::Undecided; 3]);
    assert_eq!(
        [-2.0, 3.0, 3.5].map(|x| three.side([x, 0.0, 0.0])),
        [Side::Inside, Side::Inside, Side::Outside]
    );
}

/// A box in the corner of another one, flush with three of its faces: no void touches its shell.
#[test]
fn bodies_that_stand_flush_in_each_other_are_united() {
    let mut small = cube(0.5);
    for control in small.iter_mut().flat_map(|face| &mut face.control_points) {
        (0..3).for_each(|axis| control[axis] += 0.5);
    }
    let both = [cube(1.0), small].concat();
    let model = Model::from_arrays(None, both).unwrap();
    assert_eq!(prepared(&model).solid().shells.len(), 2);
    assert_sides("flush boxes", &model, 1.4, depth_of_cube);
}

/// A mesh that stands twice in its file, and two overlapping boxes of one mesh.
#[test]
fn meshes_that_stand_twice_or_overlap_are_united() {
    let at = |x: f64| -> Vec<[DVec3; 3]> {
        let faces = cube(1.0).into_iter().flat_map(|face| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| {
                let [px, y, z, _] = face.control_points[k];
                DVec3::new(px + x, y, z)
            });
            [[a, b, d], [a, d, c]]
        });
        faces.collect()
    };
    let model = |triangles: &[[DVec3; 3]]| {
        let vertices = triangles.concat();
        let indices: Vec<[u32; 3]> =
            (0..triangles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        let mesh = TriangleMesh::new(&vertices, &indices).unwrap();
        PreparedModel::of_facets(&Facets::Mesh(mesh), None).unwrap()
    };
    let each_twice: Vec<_> = at(0.0).into_iter().flat_map(|triangle| [triangle, triangle]).collect();
    let mut random = Random(5);
    for (name, triangles, shift) in [
        ("twice", [at(0.0), at(0.0)].concat(), 0.0),
        ("each triangle twice", each_twice, 0.0),
        ("overlapping", [at(0.0), at(0.6)].concat(), 0.6),
    ] {
        let model = model(&triangles);
        assert_eq!(model.solid().shells.len(), 2, "{name}");
        for _ in 0..1000 {
            let point = random.within(1.7);
            let depth = depth_of_cube(point).min(depth_of_cube(point - shift * DVec3::X));
            let side = if depth < 0.0 { Side::Inside } else { Side::Outside };
            assert_eq!(model.side(point.to_array()), side, "{name}: {point}");
        }
    }
}

/// Numbers that are not finite are points of no side.
#[test]
fn a_point_that_is_not_finite_has_no_side() {
    let model = prepared(&sphere(DVec3::ZERO, 1.0).unwrap());
    for coordinate in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(model.side([0.0, coordinate, 0.0]), Side::Undecided);
    }
}

#[test]
fn points_of_a_box_of_faces_oriented_either_way() {
    let model = Model::from_arrays(None, cube(1.0)).unwrap();
    assert_sides("box", &model, 1.4, depth_of_cube);
}

/// On lines through edges and corners, and through the bisectors of the faces.
#[test]
fn points_beside_edges_and_corners() {
    let model = prepared(&Model::from_arrays(None, cube(1.0)).unwrap());
    let corners =
        [DVec3::ONE, DVec3::new(1.0, -1.0, 1.0), DVec3::new(1.0, 1.0, 0.3), DVec3::new(0.0, -1.0, -1.0)];
    for corner in corners {
        let outward = corner.normalize();
        for distance in [1e-1, 1e-3, 1e-6, 1e-9] {
            for (sign, side) in [(1.0, Side::Outside), (-1.0, Side::Inside)] {
                let found = model.side((corner + sign * distance * outward).to_array());
                assert_eq!(found, side, "{distance:e} from {corner}");
            }
        }
    }
    assert_eq!(model.side([1.0, 1.0, 1.0]), Side::Undecided);
    assert_eq!(model.side([f64::NAN, 0.0, 0.0]), Side::Undecided);
    assert_eq!(model.side([1.0, 0.2, 0.3]), Side::Undecided);
}

#[test]
fn a_void_is_outside_and_shells_are_counted() {
    let shell = together(&[&sphere(DVec3::ZERO, 1.0).unwrap(), &sphere(DVec3::ZERO, 0.5).unwrap()]);
    assert_sides("hollow sphere", &shell, 1.3, |point| (point.length() - 0.75).abs() - 0.25);
    let solid = prepared(&shell).solid();
    assert_eq!(solid.shells.len(), 2);
    assert!(solid.shells.iter().all(|shell| shell.closed && shell.faces.len() == 1));
}

#[test]
fn an_open_model_names_its_free_edges_and_has_no_sides() {
    let mut faces = cube(1.0);
    faces.pop();
    let model = prepared(&Model::from_arrays(None, faces).unwrap());
    let solid = model.solid();
    assert!(!solid.closed && solid.shells.len() == 1 && !solid.shells[0].closed);
    assert_eq!(solid.free_edges.len(), 4);
    assert!(solid.free_edges.iter().all(|edge| edge.middle[2] == 1.0), "{:?}", solid.free_edges);
    assert_eq!(model.side([0.0; 3]), Side::Undecided);
    let half =
        part(&sphere(DVec3::ZERO, 1.0).unwrap().surfaces()[0], [[0.0, 1.0], [0.0, 0.5]].into()).unwrap();
    let half = prepared(&Model::new(None, vec![half]).unwrap()).solid();
    assert!(!half.closed && !half.free_edges.is_empty());
}

/// A wall of the box in three faces: two beside each other and one above both.
#[test]
fn edges_that_meet_inside_others_are_joined() {
    let mut faces = cube(1.0);
    faces.pop();
    let at = |x: f64, y: f64| DVec3::new(x, y, 1.0);
    for [low, high] in
        [[at(-1.0, -1.0), at(0.2, 0.5)], [at(0.2, -1.0), at(1.0, 0.5)], [at(-1.0, 0.5), at(1.0, 1.0)]]
    {
        faces.push(face([low, at(high.x, low.y), high, at(low.x, high.y)]));
    }
    assert_sides("box of eight faces", &Model::from_arrays(None, faces).unwrap(), 1.4, depth_of_cube);
}

/// A crack narrower than the reach of joining closes, and a wider one does not.
#[test]
fn cracks_within_the_gap_close() {
    for (crack, closed) in [(1e-6, true), (1e-3, false)] {
        let mut faces = cube(1.0);
        for control in &mut faces[5].control_points {
            control[2] += crack;
        }
        let model = prepared(&Model::from_arrays(None, faces).unwrap());
        assert_eq!(model.solid().closed, closed, "{crack}");
        if closed {
            assert_eq!(model.side([0.3, 0.1, 0.9]), Side::Inside);
            assert_eq!(model.side([1.0, 1.0, 1.1]), Side::Outside);
            // In the crack no ray is certain, and the deviation is 0.
            let between = [1.0, 0.1, 1.0 + 0.5 * crack];
            assert_eq!(model.side(between), Side::Undecided);
            let options = ClosestPointOptions::default();
            let found = Engine::cpu().closest_points(&model, &between, &options).wait().unwrap();
            assert_eq!((found.signs, found.signed[0]), (Signs::Solid, 0.0));
            assert!((found.distances[0] - 0.5 * crack).abs() < 1e-12);
        }
    }
}

fn field(a: &Model, b: &Model) -> DeviationField {
    let engine = Engine::cpu();
    let options = FieldOptions { samples: 24, ..FieldOptions::default() };
    engine.field(&prepared(a), &prepared(b), &options).wait().unwrap()
}

/// The feet of most samples are edges and corners of the tetrahedron, where the normal of a face
/// has either sign.
#[test]
fn deviations_from_a_tetrahedron_have_the_sign_of_the_solid() {
    let (inner, outer) = (sphere(DVec3::ZERO, 0.5).unwrap(), sphere(DVec3::ZERO, 2.0).unwrap());
    for (ball, sign) in [(outer, 1.0), (inner, -1.0)] {
        let found = field(&ball, &tetrahedron(1.0));
        for part in &found.deviations {
            assert_eq!(part.signs, Signs::Solid);
            for (signed, distance) in part.signed.iter().zip(&part.distances) {
                assert_eq!(*signed, sign * distance);
            }
        }
        let mean = found.statistics.unwrap();
        assert!((mean.signed_mean - sign * mean.mean).abs() < 1e-12);
    }
}

/// Rays that start beside each other share their side, across the boundary too.
#[test]
fn samples_that_cross_the_boundary_change_their_sign() {
    let cutting = cylinder(0.9, 6.0).unwrap();
    let found = field(&cutting, &Model::from_arrays(None, cube(1.0)).unwrap());
    let mut counts = [0, 0];
    for part in &found.deviations {
        for (point, signed) in part.points.chunks_exact(3).zip(&part.signed) {
            let expected = depth_of_cube(DVec3::new(point[0], point[1], point[2]));
            counts[usize::from(expected > 0.0)] += 1;
            assert!((signed - expected).abs() < 1e-8 || expected.abs() < 1e-9, "{signed} and {expected}");
        }
    }
    assert!(counts.iter().all(|&count| count > 100), "{counts:?}");
}
