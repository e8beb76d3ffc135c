//! Proofs of cuts: right ones are proved, and each kind of wrong one is refuted.

use crate::cuts::cut;
use crate::proof::cut::{Cut, Finding, Map, Piece, Ruled, check};
use crate::proof::{Deadline, Surface, Verdict};
use crate::support::trims::{arcs, circle, face, plane, rectangle, reversed};
use nurbs_hausdorff::internals::model::trim::TrimCurveArrays;
use nurbs_hausdorff::{Model, ModelArrays};

/// Below the sizes of what is changed, and large enough for proofs of seconds.
const SLACK: f64 = 1e-2;

fn of_plane(trim: Vec<Vec<TrimCurveArrays>>) -> Cut {
    let sheet = plane([1.0, 2.0, 3.0], [1.0, 0.0, 0.0], [0.0, 0.6, 0.8], [[0.0, 10.0], [0.0, 8.0]]);
    let model =
        Model::from_faces(ModelArrays { faces: vec![face(sheet, trim)], ..ModelArrays::default() }).unwrap();
    let face = model.faces().next().unwrap();
    cut(0, &face, 1e-9).unwrap().unwrap()
}

/// A disc with a round hole, of several pieces.
fn ring() -> Cut {
    of_plane(vec![circle([5.0, 4.0], 3.0), reversed(circle([5.5, 4.0], 1.0))])
}

fn verdict(cut: &Cut) -> Finding {
    check(cut, SLACK, &Deadline::after(60.0))
}

#[track_caller]
fn assert_refuted(cut: &Cut, note: &str) {
    let finding = verdict(cut);
    assert_eq!(finding.verdict, Verdict::Refuted, "{finding:?}");
    assert!(finding.note.as_ref().is_some_and(|found| found.contains(note)), "{finding:?}");
}

#[test]
fn right_cuts_are_proved() {
    for cut in [
        ring(),
        of_plane(vec![arcs([5.0, 4.0], 3.0, 0.3, 3)]),
        of_plane(vec![rectangle([1.0, 2.0], [3.0, 7.0])]),
    ] {
        let finding = verdict(&cut);
        assert_eq!(finding.verdict, Verdict::Proved, "{finding:?}");
    }
}

#[test]
fn a_missing_piece_is_noticed() {
    let count = ring().pieces.len();
    assert!(count > 2);
    for index in 0..count {
        let mut cut = ring();
        cut.pieces.remove(index);
        assert_refuted(&cut, "no piece covers the face");
    }
}

#[test]
fn a_piece_of_another_face_is_noticed() {
    let mut cut = ring();
    cut.pieces.extend(of_plane(vec![rectangle([0.5, 0.5], [1.0, 1.0])]).pieces);
    assert_refuted(&cut, "leaves the face");
}

#[test]
fn a_piece_that_is_moved_off_its_place_is_noticed() {
    let mut cut = ring();
    cut.pieces[1].surface.ctrl[0][0][1] += 0.1;
    assert_refuted(&cut, "is off the surface");
}

/// A slit there and back, and a piece without area along it: as a torus was once read.
#[test]
fn loops_around_nothing_are_noticed() {
    let mut cut = ring();
    let [from, to] = [[2.0, 2.0], [8.0, 2.0]];
    let line = |from: [f64; 2], to: [f64; 2]| vec![[from[0], from[1], 1.0], [to[0], to[1], 1.0]];
    cut.loops = vec![vec![line(from, to), line(to, from)]];
    let unit = |[u, v]: [f64; 2]| [u / 10.0, v / 8.0];
    let side = line(unit(from), unit(to));
    let point = |[u, v]: [f64; 2]| [1.0 + u, 2.0 + 0.6 * v, 3.0 + 0.8 * v, 1.0];
    let row = vec![point(from), point(to)];
    let knots = vec![0.0, 0.0, 1.0, 1.0];
    let surface = Surface {
        degree: [1, 1],
        knots_u: knots.clone(),
        knots_v: knots,
        ctrl: vec![row.clone(), row],
        trim: None,
    };
    let map = Map::Ruled(Ruled::new([side.clone(), side], [[0.0, 10.0], [0.0, 8.0]], false));
    cut.pieces = vec![Piece { surface, map }];
    assert_refuted(&cut, "around nothing");
}

#[test]
fn a_face_without_pieces_is_refuted() {
    let mut cut = ring();
    cut.pieces.clear();
    assert_refuted(&cut, "no pieces");
}
