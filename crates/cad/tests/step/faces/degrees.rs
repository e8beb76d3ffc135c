//! Curves and surfaces of degrees from 16 to 25, which become pieces of a lower degree.

use crate::support::evaluator::evaluate;
use crate::support::writers::step::{Id, StepText};
use crate::{areas, assert_near, face};
use nurbs_hausdorff::{Axis, Model, ReadReport};
use std::f64::consts::{FRAC_PI_2, PI};

/// A homogeneous control point.
type Control = [f64; 4];

/// The control points of the same curve in a higher degree.
fn elevated(mut controls: Vec<Control>, degree: usize) -> Vec<Control> {
    while controls.len() <= degree {
        let count = controls.len();
        let before = |index: usize, axis: usize| if index == 0 { 0.0 } else { controls[index - 1][axis] };
        let at = |index: usize, axis: usize| if index == count { 0.0 } else { controls[index][axis] };
        let part = |index: usize| index as f64 / count as f64;
        controls = (0..=count)
            .map(|i| [0, 1, 2, 3].map(|axis| part(i) * before(i, axis) + (1.0 - part(i)) * at(i, axis)))
            .collect();
    }
    controls
}

/// A quarter of the circle of radius r about z, turned by quarters.
fn quarter(r: f64, height: f64, turns: usize, degree: usize) -> Vec<Control> {
    let side = 0.5_f64.sqrt();
    let (sin, cos) = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][turns];
    let control =
        |x: f64, y: f64, w: f64| [w * r * (cos * x - sin * y), w * r * (sin * x + cos * y), w * height, w];
    elevated(vec![control(1.0, 0.0, 1.0), control(1.0, 1.0, side), control(0.0, 1.0, 1.0)], degree)
}

fn list(items: impl IntoIterator<Item = String>) -> String {
    format!("({})", items.into_iter().collect::<Vec<_>>().join(","))
}

fn point(text: &mut StepText, [x, y, z, w]: Control) -> String {
    format!("#{}", text.point([x / w, y / w, z / w]))
}

fn weight(&[_, _, _, w]: &Control) -> String {
    format!("{w:?}")
}

/// A Bézier curve.
fn curve(text: &mut StepText, controls: &[Control]) -> Id {
    let points = list(controls.iter().map(|&control| point(text, control)));
    let weights = list(controls.iter().map(weight));
    let degree = controls.len() - 1;
    text.add(format!(
        "(BEZIER_CURVE()BOUNDED_CURVE()B_SPLINE_CURVE({degree},{points},.UNSPECIFIED.,.F.,.F.)CURVE()\
         GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE({weights})REPRESENTATION_ITEM(''))"
    ))
}

/// A Bézier surface of rows of control points.
fn surface(text: &mut StepText, rows: &[Vec<Control>]) -> Id {
    let points = list(rows.iter().map(|row| list(row.iter().map(|&control| point(text, control)))));
    let weights = list(rows.iter().map(|row| list(row.iter().map(weight))));
    let degrees = [rows.len() - 1, rows[0].len() - 1];
    text.add(format!(
        "(BEZIER_SURFACE()BOUNDED_SURFACE()B_SPLINE_SURFACE({},{},{points},.UNSPECIFIED.,.F.,.F.,.F.)\
         GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE({weights})REPRESENTATION_ITEM('')SURFACE())",
        degrees[0], degrees[1]
    ))
}

/// The whole surface as a face, whose degrees the model accepts and whose gap is proven and small.
#[track_caller]
fn whole(mut text: StepText, surface: Id) -> (Model, ReadReport) {
    let whole = text.face(&[], surface, true);
    let (model, report) = face(text, whole);
    assert!(model.surfaces()[0].degree().into_iter().all(|degree| degree <= 15));
    assert!(report.gap_proven && report.gap > 0.0 && report.gap < 1e-7, "{}", report.gap);
    (model, report)
}

/// The largest distance that `distance` gives of the points of a model's only surface, which is at
/// most the gap, and no less than a hundredth of it.
#[track_caller]
fn assert_gap_holds(model: &Model, gap: f64, distance: impl Fn([f64; 2], [f64; 3]) -> f64) {
    let surface = &model.surfaces()[0];
    let [u, v] = [Axis::U, Axis::V].map(|axis| {
        let knots = surface.knots(axis);
        [knots[0], knots[knots.len() - 1]]
    });
    let mut largest = 0.0_f64;
    const PARTS: usize = 97;
    for i in 0..=PARTS {
        for j in 0..=PARTS {
            let [s, t] = [i, j].map(|part| part as f64 / PARTS as f64);
            let at = [u[0] + s * (u[1] - u[0]), v[0] + t * (v[1] - v[0])];
            largest = largest.max(distance(at, evaluate(surface, at[0], at[1], [0.0; 3]).point));
        }
    }
    assert!(largest <= gap, "{largest} is above the gap {gap}");
    assert!(largest >= 1e-2 * gap, "{largest} is far below the gap {gap}");
}

/// A quarter of a cylinder of radius 5 and height 3 in degree 18, along u or along v.
#[test]
fn a_rational_surface_of_degree_18_is_within_its_gap() {
    let (low, high) = (quarter(5.0, 0.0, 0, 18), quarter(5.0, 3.0, 0, 18));
    let along_v = vec![low.clone(), high.clone()];
    let along_u: Vec<Vec<Control>> = low.into_iter().zip(high).map(|(low, high)| vec![low, high]).collect();
    for rows in [along_u, along_v] {
        let mut text = StepText::new();
        let surface = surface(&mut text, &rows);
        let (model, report) = whole(text, surface);
        assert_near(areas(&model)[0], FRAC_PI_2 * 15.0, 1e-8);
        assert_gap_holds(&model, report.gap, |_, [x, y, _]| (x.hypot(y) - 5.0).abs());
    }
}

/// The graph of u²⁵ + v¹⁷ over the unit square.
#[test]
fn polynomials_of_both_degrees_are_within_their_gap() {
    let rows: Vec<Vec<Control>> = (0..=25)
        .map(|i| {
            let height = |j: usize| f64::from(u8::from(i == 25)) + f64::from(u8::from(j == 17));
            (0..=17).map(|j| [i as f64 / 25.0, j as f64 / 17.0, height(j), 1.0]).collect()
        })
        .collect();
    let mut text = StepText::new();
    let surface = surface(&mut text, &rows);
    let (model, report) = whole(text, surface);
    assert_gap_holds(&model, report.gap, |[u, v], [x, y, z]| {
        (x - u).hypot(y - v).hypot(z - u.powi(25) - v.powi(17))
    });
}

/// Swept surfaces have the degree of their profile: a quarter circle of degree 20, extruded and
/// turned about z.
#[test]
fn profiles_of_degree_20_are_swept() {
    let mut text = StepText::new();
    let profile = curve(&mut text, &quarter(5.0, 0.0, 0, 20));
    let direction = text.direction([0.0, 0.0, 1.0]);
    let vector = text.add(format!("VECTOR('',#{direction},1.)"));
    let extruded = text.add(format!("SURFACE_OF_LINEAR_EXTRUSION('',#{profile},#{vector})"));
    let trimmed = text.add(format!("RECTANGULAR_TRIMMED_SURFACE('',#{extruded},0.,1.,0.,4.,.T.,.T.)"));
    let (model, _) = whole(text, trimmed);
    assert_near(areas(&model)[0], FRAC_PI_2 * 20.0, 1e-8);

    // The quarter from (5, 0, 0) to (0, 0, 5) makes half of a sphere.
    let mut text = StepText::new();
    let meridian: Vec<Control> =
        quarter(5.0, 0.0, 0, 20).into_iter().map(|[x, z, _, w]| [x, 0.0, z, w]).collect();
    let profile = curve(&mut text, &meridian);
    let origin = text.point([0.0; 3]);
    let direction = text.direction([0.0, 0.0, 1.0]);
    let axis = text.add(format!("AXIS1_PLACEMENT('',#{origin},#{direction})"));
    let turned = text.add(format!("SURFACE_OF_REVOLUTION('',#{profile},#{axis})"));
    let (model, report) = whole(text, turned);
    assert_near(areas(&model)[0], 2.0 * PI * 25.0, 1e-8);
    assert_gap_holds(&model, report.gap, |_, [x, y, z]| (x.hypot(y).hypot(z) - 5.0).abs());
}

/// A disc within four edges of degree 20.
#[test]
fn edges_of_degree_20_bound_a_disc() {
    let mut text = StepText::new();
    let corners = [[5.0, 0.0, 0.0], [0.0, 5.0, 0.0], [-5.0, 0.0, 0.0], [0.0, -5.0, 0.0]];
    let corners = corners.map(|corner| text.vertex(corner));
    let edges: Vec<(Id, bool)> = (0..4)
        .map(|turns| {
            let curve = curve(&mut text, &quarter(5.0, 0.0, turns, 20));
            (text.edge(curve, [corners[turns], corners[(turns + 1) % 4]], true), true)
        })
        .collect();
    let placement = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let plane = text.add(format!("PLANE('',#{placement})"));
    let path = text.edge_loop(&edges);
    let disc = text.face(&[path], plane, true);
    let (model, report) = face(text, disc);
    assert_near(areas(&model)[0], 25.0 * PI, 1e-8);
    assert_eq!((report.exact, report.fitted), (0, 4));
    assert!(report.gap_proven && report.gap < 1e-7, "{}", report.gap);
}

/// A face of a surface of degree 18 within a loop that is not its box.
#[test]
fn a_trimmed_face_of_degree_18_is_read() {
    let mut text = StepText::new();
    let rows: Vec<Vec<Control>> =
        (0..=18).map(|i| [0.0, 10.0].map(|y| [i as f64, y, 0.0, 1.0]).to_vec()).collect();
    let surface = surface(&mut text, &rows);
    let placement = text.placement([9.0, 5.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let circle = text.circle(placement, 4.0);
    let vertex = text.vertex([13.0, 5.0, 0.0]);
    let rim = text.edge(circle, [vertex, vertex], true);
    let path = text.edge_loop(&[(rim, true)]);
    let disc = text.face(&[path], surface, true);
    let (model, report) = face(text, disc);
    assert_near(areas(&model)[0], 16.0 * PI, 1e-7);
    assert!(report.gap_proven && report.gap < 1e-6, "{}", report.gap);
}
