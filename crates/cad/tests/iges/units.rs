//! Units of length, and the delimiters of the global section.

use crate::support::writers::iges::IgesText;
use crate::{areas, assert_near, read};
use nurbs_hausdorff_cad::from_iges;
use std::f64::consts::PI;

/// A rectangle of 2 by 3 units with a circular hole of radius 0.5.
fn plate(unit: (u32, &'static str)) -> IgesText {
    let mut text = IgesText { unit, ..IgesText::new() };
    let surface = text.bilinear([[0.0; 3], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [2.0, 3.0, 0.0]]);
    let hole = text.arc(0.0, [[0.5, 0.0]; 2]);
    let moved = text.matrix([[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.5], [0.0, 0.0, 1.0, 0.0]]);
    text.place(hole, moved);
    text.trimmed(surface, None, &[(0, hole)]);
    text
}

#[test]
fn lengths_are_in_millimetres() {
    for (unit, millimetres) in [((1, "INCH"), 25.4), ((2, "MM"), 1.0), ((6, "M"), 1000.0), ((3, "CM"), 10.0)]
    {
        let (model, _) = read(&plate(unit));
        assert_near(areas(&model)[0] / (millimetres * millimetres), 6.0 - PI / 4.0, 1e-7);
        assert_near(model.bounding_box().max[1], 3.0 * millimetres, 1e-12);
    }
}

#[test]
fn an_unknown_unit_is_refused() {
    let error = from_iges(plate((3, "PARSEC")).text().as_bytes()).unwrap_err();
    assert_eq!(error.code(), "IGES_UNREADABLE");
}

/// Other delimiters than comma and semicolon, Fortran's exponents, and lines of other systems.
#[test]
fn delimiters_numbers_and_line_ends_may_be_others() {
    let text = plate((2, "MM")).text();
    let expected = read(&plate((2, "MM"))).0.to_json().unwrap();
    let same = |text: &str| {
        let (model, _) = from_iges(text.as_bytes()).unwrap();
        assert_eq!(model.to_json().unwrap(), expected);
    };
    same(&text.replace('\n', "\r\n"));
    same(&text.replace('\n', ""));
    same(&text.replace("0.5,0.0,0.5", "5D-1,0.0,.5"));
    let other: String = text
        .lines()
        .map(|line| match &line[72..73] {
            "G" => format!(
                "{}\n",
                line.replace("1H,,1H;,", "1H/#1H!#")
                    .replace(',', "/")
                    .replace(';', "!")
                    .replace("1H/#1H!#", "1H//1H!/")
            ),
            "P" => format!("{}\n", line.replace(',', "/").replace(';', "!")),
            _ => format!("{line}\n"),
        })
        .collect();
    same(&other);
}
