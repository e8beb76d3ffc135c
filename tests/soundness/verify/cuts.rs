//! Proofs of cuts: right ones are proved, and each kind of wrong one is refuted.

use crate::cuts::cut;
use crate::proof::Verdict;
use crate::proof::cut::{Cut, Finding, check};
use crate::support::trims::{arcs, circle, face, plane, rectangle, reversed};
use nurbs_hausdorff::model::trim::TrimCurveArrays;
use nurbs_hausdorff::{Model, ModelArrays};
use std::time::{Duration, Instant};

/// Far below the sizes of what is changed, far above rounding.
const SLACK: f64 = 1e-3;

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
    check(cut, SLACK, Instant::now() + Duration::from_secs(60))
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

#[test]
fn loops_around_nothing_are_noticed() {
    let mut cut = ring();
    cut.loops.truncate(1);
    let back: Vec<Vec<[f64; 3]>> =
        cut.loops[0].iter().rev().map(|curve| curve.iter().rev().copied().collect()).collect();
    cut.loops.push(back);
    cut.pieces.clear();
    let finding = verdict(&cut);
    assert_eq!(finding.verdict, Verdict::Refuted, "{finding:?}");
}
