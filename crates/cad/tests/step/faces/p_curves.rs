//! Curves in the parameters that the file states.

use crate::support::writers::step::{Id, StepText};
use crate::{areas, assert_near, face};
use nurbs_hausdorff::{Model, ReadReport};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The square [0, 4]² as a B-spline of degree 1, u = x / 4 and v = y / 4, with a round hole whose edge has
/// these curves in the parameters.
fn plate(p_curves: impl FnOnce(&mut StepText) -> Vec<Id>) -> (Model, ReadReport) {
    let mut text = StepText::new();
    let rows = [0.0, 4.0].map(|x| {
        let row = [0.0, 4.0].map(|y| format!("#{}", text.point([x, y, 0.0])));
        format!("({})", row.join(","))
    });
    let surface = text.add(format!(
        "B_SPLINE_SURFACE_WITH_KNOTS('',1,1,({}),.UNSPECIFIED.,.F.,.F.,.F.,(2,2),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.)",
        rows.join(",")
    ));
    let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]];
    let vertices = corners.map(|corner| text.vertex(corner));
    let sides: Vec<(Id, bool)> = (0..4)
        .map(|k| {
            let next = (k + 1) % 4;
            let line = text.line(corners[k], [0, 1, 2].map(|axis| corners[next][axis] - corners[k][axis]));
            (text.edge(line, [vertices[k], vertices[next]], true), true)
        })
        .collect();
    let placement = text.placement([2.0, 2.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let circle = text.circle(placement, 1.5);
    let stated: Vec<String> = p_curves(&mut text)
        .into_iter()
        .map(|curve| {
            let drawing = text.add(format!("DEFINITIONAL_REPRESENTATION('',(#{curve}),$)"));
            format!("#{}", text.add(format!("PCURVE('',#{surface},#{drawing})")))
        })
        .collect();
    let curve = text.add(format!("SURFACE_CURVE('',#{circle},({}),.CURVE_3D.)", stated.join(",")));
    let vertex = text.vertex([3.5, 2.0, 0.0]);
    let hole = text.edge(curve, [vertex, vertex], true);
    let loops = [text.edge_loop(&sides), text.edge_loop(&[(hole, false)])];
    let plate = text.face(&loops, surface, true);
    face(text, plate)
}

/// A circle about the middle of the parameters.
fn circle(text: &mut StepText, radius: f64, start: f64) -> Id {
    let center = text.add("CARTESIAN_POINT('',(0.5,0.5))");
    let x = text.add(format!("DIRECTION('',({:?},{:?}))", start.cos(), start.sin()));
    let placement = text.add(format!("AXIS2_PLACEMENT_2D('',#{center},#{x})"));
    text.add(format!("CIRCLE('',#{placement},{radius:?})"))
}

const AREA: f64 = 16.0 - PI * 2.25;

#[test]
fn a_stated_curve_is_used_where_it_runs_along_the_edge() {
    let (model, report) = plate(|text| vec![circle(text, 0.375, 0.0)]);
    assert_near(areas(&model)[0], AREA, 1e-12);
    assert_eq!((report.exact, report.fitted), (5, 0));
    assert!(report.gap < 1e-10, "{}", report.gap);
}

/// Of another size, or of another start.
#[test]
fn a_stated_curve_beside_the_edge_is_made_anew() {
    let moved = |radius: f64, start: f64| plate(|text| vec![circle(text, radius, start)]);
    for (model, report) in [moved(0.37, 0.0), moved(0.375, FRAC_PI_2), plate(|_| Vec::new())] {
        assert_near(areas(&model)[0], AREA, 1e-7);
        assert_eq!((report.exact, report.fitted), (4, 1));
    }
}

/// A cone from its apex to a ring, whose loop passes the seam twice, and the apex, where its angle is free.
/// The lines of the seam have length 1 in the parameters and in space, which are different speeds, and come in
/// either order.
#[test]
fn the_sides_of_a_seam_come_in_either_order() {
    let (radius, half_angle) = (2.0_f64, 0.5_f64);
    let height = radius / half_angle.tan();
    let slant = radius / half_angle.sin();
    for sides in [[TAU, 0.0], [0.0, TAU]] {
        let mut text = StepText::new();
        let placement = text.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        let surface = text.add(format!("CONICAL_SURFACE('',#{placement},{radius:?},{half_angle:?})"));
        let [apex, foot] = [[0.0, 0.0, -height], [radius, 0.0, 0.0]].map(|point| text.vertex(point));
        let along = [-half_angle.sin(), 0.0, -half_angle.cos()];
        let line = text.line([radius, 0.0, 0.0], along);
        let p_curve = |text: &mut StepText, from: [f64; 2], along: [f64; 2]| {
            let from = text.add(format!("CARTESIAN_POINT('',({:?},{:?}))", from[0], from[1]));
            let along = text.add(format!("DIRECTION('',({:?},{:?}))", along[0], along[1]));
            let vector = text.add(format!("VECTOR('',#{along},1.)"));
            let line = text.add(format!("LINE('',#{from},#{vector})"));
            let drawing = text.add(format!("DEFINITIONAL_REPRESENTATION('',(#{line}),$)"));
            text.add(format!("PCURVE('',#{surface},#{drawing})"))
        };
        let [first, second] = sides.map(|u| p_curve(&mut text, [u, 0.0], [0.0, -1.0]));
        let seam = text.add(format!("SEAM_CURVE('',#{line},(#{first},#{second}),.CURVE_3D.)"));
        let seam = text.edge(seam, [foot, apex], true);
        let circle = text.circle(placement, radius);
        let ring = p_curve(&mut text, [0.0, 0.0], [1.0, 0.0]);
        let ring = text.add(format!("SURFACE_CURVE('',#{circle},(#{ring}),.CURVE_3D.)"));
        let ring = text.edge(ring, [foot, foot], true);
        let path = text.edge_loop(&[(seam, true), (seam, false), (ring, false)]);
        let cone = text.face(&[path], surface, false);
        let (model, report) = face(text, cone);
        assert_near(areas(&model)[0], PI * radius * slant, 1e-9);
        assert_eq!((report.fitted, report.notes.len()), (0, 0), "{:?}", report.notes);
    }
}
