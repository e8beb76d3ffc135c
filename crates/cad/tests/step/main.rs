//! The reader of STEP files, on files of the tests' own making.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

#[path = "../brep/area.rs"]
#[allow(dead_code, reason = "the tests of BREP texts use all of it")]
mod area;
#[path = "../../../../tests/support/mod.rs"]
mod support;

mod assemblies;
mod colors;
mod damage;
mod dialects;
mod faces;
mod faults;
mod items;
mod real_files;
mod said;
mod units;

use nurbs_hausdorff::{Model, ReadReport};
use nurbs_hausdorff_cad::from_step;
use support::writers::step::{StepText, UnitsOf};

/// Reads a text, every face of it.
#[track_caller]
fn read(text: &str) -> (Model, ReadReport) {
    let (model, report) = from_step(text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(report.skipped, [], "{text}");
    assert_eq!(report.unit, Some(1e-3));
    (model, report)
}

/// The model of one face in millimetres.
#[track_caller]
fn face(text: StepText, face: usize) -> (Model, ReadReport) {
    let mut text = text;
    let shell = text.open_shell(&[face]);
    read(&text.of(&[shell], UnitsOf::Millimetres))
}

/// The areas of the faces.
fn areas(model: &Model) -> Vec<f64> {
    model.faces().map(|face| area::area(&face)).collect()
}

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(1.0), "{found} is not {expected}");
}
