//! Areas contain the analytic ones and are as narrow as stated.

use crate::support::trims::{circle, cylinder, face, plane, quarter_parameter, rectangle, reversed};
use nurbs_hausdorff::internals::engine::PreparedModel;
use nurbs_hausdorff::shapes::{self, shape};
use nurbs_hausdorff::trim::FaceArrays;
use nurbs_hausdorff::{Area, DVec3, Model, ModelArrays, ModelInfo, SurfaceArrays};
use std::f64::consts::PI;

/// The width of an area, relative to it.
const MAX_RELATIVE_WIDTH: f64 = 1e-6;

fn of(faces: Vec<FaceArrays>) -> PreparedModel {
    let model = Model::from_faces(ModelArrays { faces, ..ModelArrays::default() }).unwrap();
    PreparedModel::new(&model).unwrap()
}

/// Asserts that an area contains `expected`, which `off` may be wrong by, and is narrow.
fn assert_area(found: Area, expected: f64, off: f64) {
    let Area { lower, upper, .. } = found;
    assert!(lower - off <= expected && expected <= upper + off, "{found:?} without {expected}");
    assert!(upper - lower <= MAX_RELATIVE_WIDTH * expected, "{found:?} is wide");
}

fn assert_shape(model: &Model, expected: f64) {
    assert_area(PreparedModel::new(model).unwrap().area(), expected, 1e-14 * expected);
}

#[test]
fn torus_and_cylinder() {
    assert_shape(&shapes::torus(2.0, 0.8).unwrap(), 4.0 * PI * PI * 2.0 * 0.8);
    let (radius, height) = (1.5, 4.0);
    let side = 2.0 * PI * radius * height;
    let closed = side + 2.0 * PI * radius * radius;
    let found = PreparedModel::new(&shapes::cylinder(radius, height).unwrap()).unwrap();
    let expected = if found.face_count() == 1 { side } else { closed };
    assert_area(found.area(), expected, 1e-14 * expected);
}

/// The derivative by the longitude vanishes at both poles.
#[test]
fn a_sphere_has_poles() {
    assert_shape(&shape("sphere").unwrap(), 4.0 * PI * 4.0);
}

#[test]
fn a_disc_and_a_plate_with_a_round_hole() {
    let sheet = plane([1.0, 2.0, 3.0], [1.0, 0.0, 0.0], [0.0, 0.6, 0.8], [[0.0, 10.0], [0.0, 8.0]]);
    let disc = of(vec![face(sheet.clone(), vec![circle([4.0, 4.0], 2.5)])]);
    assert_area(disc.area(), PI * 2.5 * 2.5, 4.0 * PI * 2.5 * disc.deviation());
    let loops = vec![rectangle([1.0, 1.0], [9.0, 7.0]), reversed(circle([4.0, 4.0], 2.5))];
    let plate = of(vec![face(sheet, loops)]);
    assert_area(plate.area(), 48.0 - PI * 2.5 * 2.5, 4.0 * PI * 2.5 * plate.deviation());
}

/// A window between two angles and heights is missing of the cylinder's side.
#[test]
fn a_cylinder_with_a_window() {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let side = cylinder([0.0; 3], axes, 3.0, [0.0, 10.0], 4);
    let [from, to] = [0.7, 2.9].map(quarter_parameter);
    let loops = vec![rectangle([0.0, 0.0], [4.0, 10.0]), reversed(rectangle([from, 2.0], [to, 5.0]))];
    let found = of(vec![face(side, loops)]);
    let expected = 2.0 * PI * 3.0 * 10.0 - (2.9 - 0.7) * 3.0 * 3.0;
    assert_area(found.area(), expected, 1e-12 * expected + 100.0 * found.deviation());
}

/// The area of a cap is that of its height: 2 π r h.
#[test]
fn a_cap_of_a_ball() {
    let model = shape("sphere").unwrap();
    let mut faces: Vec<FaceArrays> = model.faces().map(|face| face.to_arrays()).collect();
    assert_eq!(faces.len(), 1);
    let surface = &model.surfaces()[0];
    let [[u0, u1], [v0, v1]] = surface.domain().intervals();
    let cut = 0.3 * v0 + 0.7 * v1;
    let [_, _, height] = surface.point([u0, cut]);
    faces[0].trim = Some(vec![rectangle([u0, cut], [u1, v1])]);
    let expected = 2.0 * PI * 2.0 * (2.0 - height);
    assert_area(of(faces).area(), expected, 1e-12 * expected);
}

/// A sheet of degree 1 through four corners: those at (s, t) = (0, 0), (0, 1), (1, 0), (1, 1).
fn sheet(corners: [[f64; 3]; 4]) -> PreparedModel {
    let surface = SurfaceArrays {
        degree: [1, 1],
        knots: [0; 2].map(|_| vec![0.0, 0.0, 1.0, 1.0]),
        counts: [2, 2],
        control_points: corners.map(|[x, y, z]| [x, y, z, 1.0]).to_vec(),
    };
    PreparedModel::new(&Model::from_arrays(None, vec![surface]).unwrap()).unwrap()
}

/// Asserts that an area contains `expected` and is as narrow as a rule over whole patches makes it: parts that shrink
/// towards a point leave what is permitted.
fn assert_whole(found: Area, expected: f64) {
    assert_area(found, expected, 1e-14 * expected);
    assert!(found.upper - found.lower <= 0.1 * MAX_RELATIVE_WIDTH * expected, "{found:?} is wide");
}

/// A triangle by a collapsed edge, and one by a corner in the middle of a side: the normal is 0 there.
#[test]
fn plane_sheets_without_an_angle_at_a_corner_are_measured_whole() {
    let side = [3.0, 0.0, 4.0];
    let collapsed = sheet([[0.0; 3], [0.0; 3], side, [0.0, 2.0, 0.0]]);
    assert_whole(collapsed.area(), 5.0);
    let middle = sheet([[0.0; 3], [0.0, 1.0, 0.0], side, [0.0, 2.0, 0.0]]);
    assert_whole(middle.area(), 5.0);
}

/// With the normal (1 - 1.5 s) e_z the sheet is folded at s = 2/3, and both sides count.
#[test]
fn a_fold_is_not_taken_for_a_plane() {
    let folded = sheet([[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, -0.5, 0.0]]);
    assert_area(folded.area(), 5.0 / 12.0, 1e-14);
}

/// A cone's tip and a ball's poles are edges that are points.
#[test]
fn tips_and_poles() {
    let (radius, height) = (1.5_f64, 2.0_f64);
    let circle = shapes::cylinder(radius, height).unwrap();
    let surface = circle.surfaces()[0].clone().into_arrays();
    let mut cone = surface;
    // The controls at the top move to the axis; those of both rows have the same weights.
    let top = cone.control_points.iter().map(|[_, _, z, w]| z / w).fold(f64::NEG_INFINITY, f64::max);
    for [x, y, z, w] in &mut cone.control_points {
        if (*z / *w - top).abs() < 0.5 * height {
            (*x, *y) = (0.0, 0.0);
        }
    }
    let cone = PreparedModel::new(&Model::from_arrays(None, vec![cone]).unwrap()).unwrap();
    assert_area(cone.area(), PI * radius * radius.hypot(height), 1e-13);
    assert_area(
        PreparedModel::new(&shapes::sphere(DVec3::ZERO, 2.0).unwrap()).unwrap().area(),
        16.0 * PI,
        1e-13,
    );
}

#[test]
fn info_states_the_area_of_every_face_and_of_all() {
    let sheet = |z: f64| plane([0.0, 0.0, z], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [[0.0, 2.0], [0.0, 3.0]]);
    let halves =
        [[0.0, 1.0], [0.0, 2.0]].map(|[u0, u1]| face(sheet(u1), vec![rectangle([u0, 0.0], [u1, 3.0])]));
    let model = Model::from_faces(ModelArrays { faces: halves.to_vec(), ..ModelArrays::default() }).unwrap();
    let info = ModelInfo::new(&model).unwrap();
    for (face, expected) in info.faces.iter().zip([3.0, 6.0]) {
        assert_area(face.area, expected, 0.0);
    }
    assert_area(info.area, 9.0, 0.0);
}
