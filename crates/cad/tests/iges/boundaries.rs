//! Trimmed and bounded surfaces, and the check of their curves in the parameters.

use crate::support::writers::iges::{Id, IgesText, list};
use crate::{areas, assert_near, read, rectangle};
use std::f64::consts::{PI, TAU};

/// The square [0, 4]² over parameters [0, 1]².
fn square(text: &mut IgesText) -> Id {
    text.bilinear([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [4.0, 4.0, 0.0]])
}

/// A rectangle in the square as curves in the parameters and in space.
fn frame(text: &mut IgesText, low: [f64; 2], high: [f64; 2]) -> (Id, Id) {
    let [a, b] = [low, high].map(|corner| corner.map(|value| value / 4.0));
    (text.polygon(&rectangle(a, b, 0.0)), text.polygon(&rectangle(low, high, 0.0)))
}

#[test]
fn a_trimmed_surface_has_its_hole() {
    let mut text = IgesText::new();
    let surface = square(&mut text);
    let outer = frame(&mut text, [0.0, 0.0], [4.0, 3.0]);
    let hole = frame(&mut text, [1.0, 1.0], [2.0, 2.5]);
    text.trimmed(surface, Some(outer), &[hole]);
    let (model, report) = read(&text);
    assert_near(areas(&model)[0], 12.0 - 1.5, 1e-12);
    assert_eq!((report.trims, report.exact), (8, 8));
    assert!(report.gap < 1e-12 && report.notes.is_empty(), "{report:?}");
}

/// The boundary of the surface itself is the outer one.
#[test]
fn a_hole_in_a_whole_surface_is_cut() {
    let mut text = IgesText::new();
    let surface = square(&mut text);
    let hole = frame(&mut text, [1.0, 1.0], [2.0, 2.5]);
    text.trimmed(surface, None, &[hole]);
    assert_near(areas(&read(&text).0)[0], 16.0 - 1.5, 1e-12);
}

/// Some writers list a hole first.
#[test]
fn the_largest_boundary_is_the_outer_one() {
    let mut text = IgesText::new();
    let surface = square(&mut text);
    let outer = frame(&mut text, [0.0, 0.0], [4.0, 3.0]);
    let hole = frame(&mut text, [1.0, 1.0], [2.0, 2.5]);
    text.trimmed(surface, Some(hole), &[outer]);
    assert_near(areas(&read(&text).0)[0], 12.0 - 1.5, 1e-12);
}

/// Either kind of curve is enough.
#[test]
fn a_boundary_may_state_one_kind_of_curve() {
    for kind in [0, 1] {
        let mut text = IgesText::new();
        let surface = square(&mut text);
        let (parameters, space) = frame(&mut text, [1.0, 1.0], [3.0, 3.5]);
        let boundary = if kind == 0 { (parameters, 0) } else { (0, space) };
        text.trimmed(surface, Some(boundary), &[]);
        let (model, report) = read(&text);
        assert_near(areas(&model)[0], 5.0, 1e-7);
        assert!(report.notes.is_empty(), "{report:?}");
    }
}

/// Curves in the parameters of another rectangle are made anew from those in space, and the
/// report says so.
#[test]
fn wrong_curves_in_the_parameters_are_made_anew() {
    let mut text = IgesText::new();
    let surface = square(&mut text);
    let (wrong, _) = frame(&mut text, [0.0, 0.0], [2.0, 2.0]);
    let (_, space) = frame(&mut text, [1.0, 1.0], [3.0, 3.5]);
    text.trimmed(surface, Some((wrong, space)), &[]);
    let (model, report) = read(&text);
    assert_near(areas(&model)[0], 5.0, 1e-7);
    assert_eq!(report.notes.iter().map(|note| note.code).collect::<Vec<_>>(), ["IGES_P_CURVES"]);
}

/// Curves that differ a little are kept, and the gap is their distance.
#[test]
fn the_gap_is_the_distance_between_both_curves() {
    let mut text = IgesText::new();
    let surface = square(&mut text);
    let (parameters, _) = frame(&mut text, [1.0, 1.0], [3.0, 3.0]);
    let space = text.polygon(&rectangle([1.0, 1.0], [3.0, 3.0], 0.005));
    text.trimmed(surface, Some((parameters, space)), &[]);
    let (_, report) = read(&text);
    assert!((0.005..0.0056).contains(&report.gap), "{}", report.gap);
    assert_eq!(report.fitted, 0);
}

/// The curves in space may run the other way round, and begin elsewhere.
#[test]
fn curves_in_space_are_found_in_any_direction_and_order() {
    let mut text = IgesText::new();
    let surface = square(&mut text);
    let (parameters, _) = frame(&mut text, [1.0, 1.0], [3.0, 3.5]);
    let corners = rectangle([1.0, 1.0], [3.0, 3.5], 0.0);
    let space = text.polygon(&[corners[2], corners[1], corners[0], corners[3]]);
    text.trimmed(surface, Some((parameters, space)), &[]);
    let (model, report) = read(&text);
    assert_near(areas(&model)[0], 5.0, 1e-12);
    assert_eq!((report.exact, report.notes.len()), (4, 0));
}

/// A bounded surface lists its boundaries in any order, each curve with its sense.
#[test]
fn a_bounded_surface_has_its_boundaries() {
    let mut text = IgesText::new();
    let surface = square(&mut text);
    let mut boundaries = Vec::new();
    for (low, high) in [([1.0, 1.0], [2.0, 2.0]), ([0.0, 0.0], [4.0, 3.0])] {
        let corners = rectangle(low, high, 0.0);
        let mut curves = Vec::new();
        for side in 0..4 {
            let ends = [corners[side], corners[(side + 1) % 4]];
            // Every other curve in space runs against the boundary.
            let space = if side % 2 == 0 { text.line(ends[0], ends[1]) } else { text.line(ends[1], ends[0]) };
            let [from, to] = ends.map(|end| end.map(|value| value / 4.0));
            let parameters = text.line(from, to);
            curves.push(format!("{space},{},1,{parameters}", 1 + side % 2));
        }
        boundaries.push(text.add(141, 0, format!("1,1,{surface},4,{}", curves.join(","))));
    }
    text.add(143, 0, format!("1,{surface},{}", list(&boundaries)));
    let (model, report) = read(&text);
    assert_near(areas(&model)[0], 12.0 - 1.0, 1e-12);
    assert_eq!((report.exact, report.trims), (8, 8));
}

/// A plane within a circle, and one by its equation within a curve in space.
#[test]
fn a_plane_has_its_boundary() {
    let mut text = IgesText::new();
    let circle = text.arc(3.0, [[2.0, 0.0], [2.0, 0.0]]);
    text.add(108, 1, format!("0.,0.,2.,6.,{circle},0.,0.,3.,1."));
    let plane = text.add(108, 0, "0.,0.,1.,0.,0,0.,0.,0.,0.");
    let corners = text.polygon(&rectangle([0.0, 0.0], [2.0, 5.0], 0.0));
    text.trimmed(plane, Some((0, corners)), &[]);
    let (model, report) = read(&text);
    assert_near(areas(&model)[0], 4.0 * PI, 1e-12);
    assert_near(areas(&model)[1], 10.0, 1e-12);
    assert_eq!(report.fitted, 0);
}

/// A boundary without curves bounds nothing, which the report says.
#[test]
fn an_empty_boundary_is_noted() {
    let mut text = IgesText::new();
    let surface = square(&mut text);
    let outer = frame(&mut text, [0.0, 0.0], [4.0, 3.0]);
    text.trimmed(surface, Some(outer), &[(0, 0)]);
    let (model, report) = read(&text);
    assert_near(areas(&model)[0], 12.0, 1e-12);
    assert_eq!(report.notes[0].code, "IGES_BOUNDARY");
}

/// The sides of a cylinder's seam are two curves in the parameters and one in space.
#[test]
fn a_cylinder_is_whole_with_its_seam() {
    let mut text = IgesText::new();
    let side = text.line([5.0, 0.0, 1.0], [5.0, 0.0, 21.0]);
    let surface = text.revolution(side, [0.0, TAU]);
    let parameters = text.polygon(&rectangle([0.0, 0.0], [1.0, TAU], 0.0));
    let (low, high) = (text.arc(1.0, [[5.0, 0.0]; 2]), text.arc(21.0, [[5.0, 0.0]; 2]));
    let back = text.line([5.0, 0.0, 21.0], [5.0, 0.0, 1.0]);
    let space = text.composite(&[side, high, back, low]);
    text.trimmed(surface, Some((parameters, space)), &[]);
    let (model, report) = read(&text);
    assert_near(areas(&model)[0], TAU * 5.0 * 20.0, 1e-12);
    assert_eq!((report.fitted, report.notes.len()), (0, 0));
    assert!(report.gap < 1e-9, "{}", report.gap);
}

/// A whole torus within its two seams: nothing is left open about its side.
#[test]
fn a_torus_is_whole_with_its_seams() {
    let mut text = IgesText::new();
    let tube = text.arc(0.0, [[1.0, 0.0]; 2]);
    let beside = text.matrix([[1.0, 0.0, 0.0, 4.0], [0.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0]]);
    text.place(tube, beside);
    let surface = text.revolution(tube, [0.0, TAU]);
    let parameters = text.polygon(&rectangle([0.0, 0.0], [TAU, TAU], 0.0));
    let ring = text.arc(0.0, [[5.0, 0.0]; 2]);
    let space = text.composite(&[tube, ring, tube, ring]);
    text.trimmed(surface, Some((parameters, space)), &[]);
    let (model, report) = read(&text);
    assert_near(areas(&model)[0], TAU * TAU * 4.0, 1e-9);
    assert_eq!(report.notes, []);
}

/// OpenCASCADE leaves out the curves that are points, at the poles of a sphere.
#[test]
fn poles_without_curves_are_closed() {
    let mut text = IgesText::new();
    let meridian = text.arc(0.0, [[0.0, -3.0], [0.0, 3.0]]);
    let upright = text.matrix([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0]]);
    text.place(meridian, upright);
    let surface = text.revolution(meridian, [0.0, TAU]);
    let half = PI / 2.0;
    let sides =
        [text.line([-half, 0.0, 0.0], [half, 0.0, 0.0]), text.line([half, TAU, 0.0], [-half, TAU, 0.0])];
    let parameters = text.composite(&sides);
    let space = text.composite(&[meridian, meridian]);
    text.trimmed(surface, Some((parameters, space)), &[]);
    let (model, _) = read(&text);
    assert_near(areas(&model)[0], 2.0 * TAU * 9.0, 1e-9);
}
