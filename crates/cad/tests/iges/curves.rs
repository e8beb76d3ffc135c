//! Curves of each type as boundaries of a plane.

use crate::support::writers::iges::{Id, IgesText, numbers};
use crate::{areas, assert_near, read};
use std::f64::consts::PI;

/// The area of the plane z = 0 within curves in space.
#[track_caller]
fn area(mut text: IgesText, curves: &[Id]) -> f64 {
    let plane = text.add(108, 0, "0.,0.,1.,0.,0,0.,0.,0.,0.");
    let boundary = text.composite(curves);
    text.trimmed(plane, Some((0, boundary)), &[]);
    let (model, report) = read(&text);
    assert_eq!(report.fitted, 0);
    areas(&model)[0]
}

/// The coefficients of a conic and two points of it.
fn conic(text: &mut IgesText, form: i32, coefficients: [f64; 6], ends: [[f64; 2]; 2]) -> Id {
    let values = [&coefficients[..], &[0.0], &ends.concat()].concat();
    text.add(104, form, numbers(&values))
}

#[test]
fn an_ellipse_is_closed() {
    let mut text = IgesText::new();
    // x² / 9 + y² / 4 = 1, also turned by 45°: of the half axes along (1, 1) and (-1, 1).
    let flat = conic(&mut text, 1, [4.0, 0.0, 9.0, 0.0, 0.0, -36.0], [[3.0, 0.0]; 2]);
    assert_near(area(text, &[flat]), 6.0 * PI, 1e-12);
    let mut text = IgesText::new();
    let end = 3.0 * 0.5_f64.sqrt();
    let turned = conic(&mut text, 1, [6.5, -5.0, 6.5, 0.0, 0.0, -36.0], [[end, end]; 2]);
    assert_near(area(text, &[turned]), 6.0 * PI, 1e-12);
}

#[test]
fn arcs_of_a_parabola_and_a_hyperbola_have_their_ends() {
    // y = x² from (2, 4) to (-2, 4): the chord cuts off two thirds of the rectangle, 32 / 3.
    let mut text = IgesText::new();
    let arc = conic(&mut text, 3, [1.0, 0.0, 0.0, 0.0, -1.0, 0.0], [[2.0, 4.0], [-2.0, 4.0]]);
    let chord = text.line([-2.0, 4.0, 0.0], [2.0, 4.0, 0.0]);
    assert_near(area(text, &[arc, chord]), 32.0 / 3.0, 1e-12);
    // x² - y² = 1 up to x = cosh 1, where the chord cuts off cosh 1 sinh 1 - 1.
    let (x, y) = (1.0_f64.cosh(), 1.0_f64.sinh());
    let mut text = IgesText::new();
    let arc = conic(&mut text, 2, [1.0, 0.0, -1.0, 0.0, 0.0, -1.0], [[-x, y], [-x, -y]]);
    let chord = text.line([-x, -y, 0.0], [-x, y, 0.0]);
    assert_near(area(text, &[arc, chord]), x * y - 1.0, 1e-12);
}

#[test]
fn polygons_of_all_forms_are_read() {
    let corners = [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]];
    let closed = |size: usize| -> Vec<f64> {
        let point = |[x, y]: [f64; 2]| [x, y, 0.0, 1.0, 0.0, 0.0][..size].to_vec();
        [corners[0], corners[1], corners[2], corners[0]].into_iter().flat_map(point).collect()
    };
    for (form, kind, size) in [(11, 1, 2), (12, 2, 3), (13, 3, 6), (63, 1, 2)] {
        let mut text = IgesText::new();
        let height = if kind == 1 { "0.," } else { "" };
        let polygon = text.add(106, form, format!("{kind},4,{height}{}", numbers(&closed(size))));
        assert_near(area(text, &[polygon]), 6.0, 1e-12);
    }
}

/// A parabola by coefficients of powers, in two pieces, and one as a B-spline.
#[test]
fn splines_of_both_kinds_are_read() {
    // y = x² from x = 0 to 2, in pieces of lengths 1/2 and 3/2 of the parameter x.
    let piece = |from: f64| [from, 1.0, 0.0, 0.0, from * from, 2.0 * from, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let mut text = IgesText::new();
    let values = [&[0.0, 0.5, 2.0][..], &piece(0.0), &piece(0.5), &[0.0; 12]].concat();
    let powers = text.add(112, 0, format!("3,1,2,2,{}", numbers(&values)));
    let side = text.line([2.0, 4.0, 0.0], [0.0, 0.0, 0.0]);
    assert_near(area(text, &[powers, side]), 4.0 / 3.0, 1e-12);
    let mut text = IgesText::new();
    let points = [([0.0, 0.0, 0.0], 1.0), ([1.0, 0.0, 0.0], 1.0), ([2.0, 4.0, 0.0], 1.0)];
    let spline = text.spline(2, &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0], &points);
    let side = text.line([2.0, 4.0, 0.0], [0.0, 0.0, 0.0]);
    assert_near(area(text, &[spline, side]), 4.0 / 3.0, 1e-12);
}
