//! Units of length and angle.

use crate::faces::polygons::box_faces;
use crate::support::writers::step::{StepText, UnitsOf};
use crate::{areas, assert_near, read};
use std::f64::consts::PI;

#[test]
fn lengths_are_in_millimetres() {
    for (units, millimetres) in
        [(UnitsOf::Millimetres, 1.0), (UnitsOf::InchesAndDegrees, 25.4), (UnitsOf::Metres, 1000.0)]
    {
        let mut text = StepText::new();
        let faces = box_faces(&mut text, [2.0, 3.0, 5.0]);
        let solid = text.solid("", &faces);
        let (model, _) = read(&text.of(&[solid], units));
        assert_near(model.bounding_box().diagonal(), 38.0_f64.sqrt() * millimetres, 1e-14);
        assert_near(areas(&model).iter().sum(), 62.0 * millimetres * millimetres, 1e-12);
    }
}

/// The half angle of a cone in degrees, with a unit stated to 9 digits.
#[test]
fn angles_are_in_the_files_unit() {
    let mut text = StepText::new();
    let placement = text.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let surface = text.add(format!("CONICAL_SURFACE('',#{placement},0.,30.)"));
    // At the height √3 the radius is 1.
    let height = 3.0_f64.sqrt();
    let rim = text.placement([0.0, 0.0, height], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let circle = text.circle(rim, 1.0);
    let vertex = text.vertex([1.0, 0.0, height]);
    let rim = text.edge(circle, [vertex, vertex], true);
    let path = text.edge_loop(&[(rim, false)]);
    let cone = text.face(&[path], surface, true);
    let shell = text.open_shell(&[cone]);
    let (model, report) = read(&text.of(&[shell], UnitsOf::InchesAndDegrees));
    assert_near(areas(&model)[0], PI * 2.0 * 25.4 * 25.4, 1e-12);
    assert!(report.gap < 1e-9, "{}", report.gap);
}
