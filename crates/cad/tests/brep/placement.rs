//! Locations: products, powers, instances, and the placement of surfaces within faces.

use crate::support::evaluator;
use crate::support::writers::brep::{BrepText, Child, plus, rectangle};
use crate::{area_of, assert_near, read};
use nurbs_hausdorff::{Error, Model};
use nurbs_hausdorff_cad::from_brep;

/// A quarter turn about z, then a move by (1, 2, 3).
const TURN: &str = "1\n 0 -1 0 1\n 1 0 0 2\n 0 0 1 3";
const MOVE: &str = "1\n 1 0 0 10\n 0 1 0 0\n 0 0 1 0";
const PLANE: &str = "1 0 0 0 0 0 1 1 0 0 0 1 0";

fn corner(model: &Model, face: usize) -> [f64; 3] {
    let surface = &model.surfaces()[face];
    let [u, v] = surface.domain().intervals();
    evaluator::point(surface, u[1], v[0])
}

#[test]
fn a_face_in_several_places_becomes_instances() {
    let mut text = BrepText::new();
    text.location(TURN);
    text.location(MOVE);
    // The square of the move after the turn, as OpenCASCADE lists them: the first is applied
    // first. Then the inverse of the move.
    text.location("2  1 1 2 2 0");
    text.location("2  2 -1 0");
    let plane = text.surface(PLANE);
    let face = text.region(plane, &[rectangle([0.0, 0.0], [3.0, 1.0])]);
    let shell = text.shape("Sh\n", &[plus(face)]);
    let at = |location| Child { shape: shell, sign: '+', location };
    let compound = text.shape("Co\n", &[at(0), at(1), at(3), at(4)]);
    let (model, report) = from_brep(&text.text(plus(compound))).unwrap();
    assert_eq!((report.faces, report.trims, model.faces().len()), (1, 4, 4));
    let corners: Vec<_> = (0..4).map(|face| corner(&model, face)).collect();
    // (3, 0, 0) turned is (0, 3, 0).
    assert_eq!(corners, [[3.0, 0.0, 0.0], [1.0, 5.0, 3.0], [21.0, 5.0, 3.0], [-7.0, 0.0, 0.0]]);
    // Locations of nested compounds multiply.
    let outer = text.shape("Co\n", &[Child { shape: compound, sign: '-', location: 2 }]);
    let model = from_brep(&text.text(plus(outer))).unwrap().0;
    assert_eq!(corner(&model, 1), [11.0, 5.0, 3.0]);
    assert!(model.faces().all(|face| face.is_reversed()));
}

/// A text with [`MOVE`] as its first location, and the faces of the squares [0, 1 + n]² for n from 0 to 2, whose areas tell
/// them apart.
fn squares() -> (BrepText, [usize; 3]) {
    let mut text = BrepText::new();
    text.location(MOVE);
    let plane = text.surface(PLANE);
    let faces = [1.0, 2.0, 3.0].map(|side| text.region(plane, &[rectangle([0.0, 0.0], [side, side])]));
    (text, faces)
}

fn at(shape: usize, location: usize) -> Child {
    Child { shape, sign: '+', location }
}

/// OpenCASCADE uses the base of a prism, moved and reversed, as its top, so that both normals point outward.
#[test]
fn a_face_that_is_used_reversed_elsewhere_is_turned_over_there() {
    let (mut text, [square, ..]) = squares();
    let top = Child { shape: square, sign: '-', location: 1 };
    let shell = text.shape("Sh\n", &[plus(square), top]);
    let (model, report) = from_brep(&text.text(plus(shell))).unwrap();
    let turned: Vec<bool> = model.faces().map(|face| face.is_reversed()).collect();
    let names: Vec<_> = model.faces().map(|face| face.name().unwrap().to_owned()).collect();
    assert_eq!((turned, names, report.faces), (vec![false, true], vec!["face 0".into(), "face 1".into()], 2));
}

/// `TopExp_Explorer` meets the faces of a part at one place, then those of another, then again one
/// at the first place; a face that two shells share is met once more and counted once.
#[test]
fn faces_are_in_the_explorers_order() {
    let (mut text, faces) = squares();
    let shells = [[1, 0], [0, 1]].map(|order| text.shape("Sh\n", &order.map(|index| plus(faces[index]))));
    let last = text.shape("Sh\n", &[plus(faces[2])]);
    let shapes = [at(shells[0], 0), at(shells[1], 1), at(last, 0), at(shells[1], 0), at(last, 1)];
    let compound = text.shape("Co\n", &shapes);
    let (model, report) = from_brep(&text.text(plus(compound))).unwrap();
    let areas: Vec<f64> = model.faces().map(|face| crate::area::area(&face).round()).collect();
    assert_eq!(areas, [4.0, 1.0, 1.0, 4.0, 9.0, 9.0]);
    let places: Vec<f64> = model.faces().map(|face| corner_of(&face)).collect();
    assert_eq!(places, [0.0, 0.0, 10.0, 10.0, 0.0, 10.0]);
    // Faces are named by their first place.
    let names: Vec<_> = model.faces().map(|face| face.name().unwrap().to_owned()).collect();
    assert_eq!(names, ["face 0", "face 1", "face 1", "face 0", "face 4", "face 4"]);
    assert_eq!(report.faces, 3);
}

/// A solid of two shells at two places, and a shell that is of none.
#[test]
fn faces_have_the_numbers_of_their_solids() {
    let (mut text, faces) = squares();
    let shells = faces.map(|face| text.shape("Sh\n", &[plus(face)]));
    let solid = text.shape("So\n", &[plus(shells[0]), plus(shells[1])]);
    let compound = text.shape("Co\n", &[at(solid, 0), at(solid, 1), at(shells[2], 0)]);
    let (model, _) = from_brep(&text.text(plus(compound))).unwrap();
    let solids: Vec<Option<u32>> = model.faces().map(|face| face.solid()).collect();
    let &[Some(a), _, Some(b), _, _] = &solids[..] else { panic!("{solids:?}") };
    assert!(a != b && solids == [Some(a), Some(a), Some(b), Some(b), None], "{solids:?}");
}

/// Two shells of one solid at places of their own, as what a placed tool cut, and the whole at two places.
#[test]
fn shells_at_other_places_are_of_one_solid() {
    let (mut text, faces) = squares();
    let shells = faces.map(|face| text.shape("Sh\n", &[plus(face)]));
    let solid = text.shape("So\n", &[at(shells[0], 0), at(shells[1], 1)]);
    let compound = text.shape("Co\n", &[at(solid, 0), at(solid, 1)]);
    let (model, _) = from_brep(&text.text(plus(compound))).unwrap();
    let solids: Vec<Option<u32>> = model.faces().map(|face| face.solid()).collect();
    let &[Some(a), _, Some(b), _] = &solids[..] else { panic!("{solids:?}") };
    assert!(a != b && solids == [Some(a), Some(a), Some(b), Some(b)], "{solids:?}");
}

/// Solids that share a face have it each, and one that is stated twice at its place has its faces once. A face that stands
/// alone as well, before its solid or after it, is the solid's.
#[test]
fn a_face_that_solids_share_is_one_of_each() {
    let (mut text, faces) = squares();
    let shells = [[0, 1], [1, 2]].map(|pair| text.shape("Sh\n", &pair.map(|index| plus(faces[index]))));
    let solids = shells.map(|shell| text.shape("So\n", &[plus(shell)]));
    let loose = [0, 2].map(|face| text.shape("Sh\n", &[plus(faces[face])]));
    let compound = text.shape("Co\n", &[loose[0], solids[0], solids[1], solids[0], loose[1]].map(plus));
    let (model, report) = from_brep(&text.text(plus(compound))).unwrap();
    let areas: Vec<f64> = model.faces().map(|face| crate::area::area(&face).round()).collect();
    assert_eq!((areas, report.faces), (vec![1.0, 4.0, 4.0, 9.0], 4));
    let solids: Vec<Option<u32>> = model.faces().map(|face| face.solid()).collect();
    assert!(solids[0] == solids[1] && solids[1] != solids[2] && solids[2] == solids[3], "{solids:?}");
}

/// The least x of a face of a plane.
fn corner_of(face: &nurbs_hausdorff::internals::model::Face<'_>) -> f64 {
    let surface = face.surface();
    let [u, v] = surface.domain().intervals();
    evaluator::point(surface, u[0], v[0])[0]
}

#[test]
fn surfaces_are_placed_within_their_faces() {
    let mut text = BrepText::new();
    let turn = text.location(TURN);
    let plane = text.surface(PLANE);
    let mut edges = Vec::new();
    let vertex = text.vertex([0.0; 3]);
    for (entry, [first, last]) in rectangle([0.0, 0.0], [3.0, 1.0]) {
        // A curve for the surface where it is would be taken by mistake: it is twice as large.
        let [right, wrong] = [entry.clone(), entry.replace("1.0", "2.0")].map(|entry| text.p_curve(entry));
        let entries = [
            format!("2 {wrong} {plane} 0 {first:?} {last:?}"),
            format!("2 {right} {plane} {turn} {first:?} {last:?}"),
        ];
        edges.push(plus(text.edge(&entries, [vertex, vertex])));
    }
    let wire = text.wire(&edges);
    let face = text.placed_face(plane, turn, &[wire]);
    let (model, _) = read(&text, face);
    assert_near(area_of(&model), 3.0, 1e-14);
    assert_eq!(corner(&model, 0), [1.0, 5.0, 3.0]);
}

/// A plane without curves whose edges are placed by the wire and by their own location.
#[test]
fn edges_are_placed_before_they_are_projected() {
    let mut text = BrepText::new();
    // 0.003 above the edges: edges a hundredth of their size off a plane are not of a face of it.
    let turn = text.location("1\n 0 -1 0 1\n 1 0 0 2\n 0 0 1 0.003");
    let moved = text.location(MOVE);
    let back = text.location(format!("2  {moved} -1 0"));
    let plane = text.surface(PLANE);
    // In space the square is [10, 11] x [0, 1] turned and moved; the edges' curves are
    // at [0, 1] x [0, 1].
    let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let vertex = text.vertex([0.0; 3]);
    let mut edges = Vec::new();
    for index in 0..4 {
        let ([x0, y0], [x1, y1]) = (points[index], points[(index + 1) % 4]);
        let curve = text.curve(format!("1 {x0:?} {y0:?} 0 {:?} {:?} 0", x1 - x0, y1 - y0));
        let shape = text.edge(&[format!("1 {curve} {moved} 0 1")], [vertex, vertex]);
        edges.push(Child { shape, sign: '+', location: moved });
    }
    let wire = text.wire(&edges);
    let face = text
        .shape(format!("Fa\n0  1e-07 {plane} {turn}\n"), &[Child { shape: wire, sign: '+', location: back }]);
    let (model, report) = read(&text, face);
    // The plane is turned about the axis that is orthogonal to it.
    assert_near(report.gap, 0.003, 1e-14);
    assert_near(area_of(&model), 1.0, 1e-13);
    let [x, y, z] = corner(&model, 0);
    assert!(z == 0.003 && (10.0..=11.0).contains(&x) && (0.0..=1.0).contains(&y), "{x} {y} {z}");
}

#[test]
fn a_short_file_of_many_placements_is_refused() {
    let mut text = BrepText::new();
    let plane = text.surface(PLANE);
    let mut shape = text.region(plane, &[rectangle([0.0, 0.0], [1.0, 1.0])]);
    for _ in 0..60 {
        shape = text.shape("Co\n", &[plus(shape), plus(shape)]);
    }
    let error = from_brep(&text.text(plus(shape))).unwrap_err();
    // They are counted before any is unfolded: 2^60.
    assert!(matches!(error, Error::TooManyFaces { .. }), "{error}");
}
