//! The reader of BREP texts, on texts of the tests' own making.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

#[path = "../../../../tests/support/mod.rs"]
mod support;

mod area;
mod closed;
mod elementary;
mod loops;
mod missing;
mod offsets;
mod placement;
mod real_files;
mod splines;
mod swept;
mod syntax;

use nurbs_hausdorff::{Model, ReadReport};
use nurbs_hausdorff_cad::from_brep;
use support::writers::brep::{BrepText, plus};

/// The model of a text whose root is this shape.
fn read(text: &BrepText, root: usize) -> (Model, ReadReport) {
    let written = text.text(plus(root));
    let (model, report) = from_brep(&written).unwrap_or_else(|error| panic!("{error}\n{written}"));
    assert_eq!(report.skipped, [], "{written}");
    assert_eq!(report.faces, model.faces().len());
    (model, report)
}

/// The model of one surface with these loops of curves in its parameters.
fn region(surface: &str, loops: &[Vec<(String, [f64; 2])>]) -> (Model, ReadReport) {
    let mut text = BrepText::new();
    let surface = text.surface(surface);
    let face = text.region(surface, loops);
    read(&text, face)
}

fn area_of(model: &Model) -> f64 {
    let faces: Vec<_> = model.faces().collect();
    assert_eq!(faces.len(), 1);
    area::area(&faces[0])
}

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(1.0), "{found} is not {expected}");
}
