//! The reader of IGES files, on files of the tests' own making.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

#[path = "../brep/area.rs"]
#[allow(dead_code, reason = "the tests of BREP texts use all of it")]
mod area;
#[path = "../../../../tests/support/mod.rs"]
mod support;

mod assemblies;
mod boundaries;
mod curves;
mod damage;
mod left_out;
mod real_files;
mod solids;
mod surfaces;
mod units;

use nurbs_hausdorff::{Model, ReadReport};
use nurbs_hausdorff_cad::from_iges;
use support::writers::iges::IgesText;

/// Reads a file, every face of it.
#[track_caller]
fn read(text: &IgesText) -> (Model, ReadReport) {
    let text = text.text();
    let (model, report) = from_iges(text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(report.skipped, [], "{text}");
    assert_eq!(report.unit, Some(1e-3));
    (model, report)
}

/// The areas of the faces.
fn areas(model: &Model) -> Vec<f64> {
    model.faces().map(|face| area::area(&face)).collect()
}

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(1.0), "{found} is not {expected}");
}

/// The corners of a rectangle in the plane z = height.
fn rectangle([x0, y0]: [f64; 2], [x1, y1]: [f64; 2], height: f64) -> [[f64; 3]; 4] {
    [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|[x, y]| [x, y, height])
}

/// A solid, a trimmed surface of revolution, and a subfigure used twice.
fn boundaries_text() -> String {
    let mut text = IgesText::new();
    let solid = solids::brick(&mut text, [1.0, 2.0, 4.0]);
    let definition = text.add(308, 0, format!("0,4Hpart,{}", support::writers::iges::list(&[solid])));
    for x in ["0.", "3."] {
        text.add(408, 0, format!("{definition},{x},0.,0.,1."));
    }
    let side = text.line([5.0, 0.0, 1.0], [5.0, 0.0, 21.0]);
    let surface = text.revolution(side, [0.0, 3.0]);
    let hole = text.polygon(&[[0.25, 1.0, 0.0], [0.5, 1.0, 0.0], [0.5, 2.0, 0.0], [0.25, 2.0, 0.0]]);
    text.trimmed(surface, None, &[(hole, 0)]);
    text.text()
}
