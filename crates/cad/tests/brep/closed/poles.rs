//! Loops through poles whose edges the file leaves out.

use super::orders;
use crate::support::writers::brep::{BrepText, minus, plus};
use crate::{area_of, assert_near, read};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const SPHERE: &str = "4 0 0 0 0 0 1 1 0 0 0 1 0 10";

/// The sphere's seam from one latitude to another, with curves at u = 2π and 0 or without, and the
/// circle of latitude at its end, begun at the seam.
struct Cap {
    text: BrepText,
    surface: usize,
    seam: usize,
    circle: usize,
}

fn cap([start, end]: [f64; 2], curves: bool) -> Cap {
    let mut text = BrepText::new();
    let surface = text.surface(SPHERE);
    let ends = [start, end].map(|v: f64| text.vertex([10.0 * v.cos(), 0.0, 10.0 * v.sin()]));
    let [meridian, latitude] = [
        "2 0 0 0 0 -1 0 1 0 0 0 0 1 10".to_owned(),
        format!("2 0 0 {:?} 0 0 1 1 0 0 0 1 0 {:?}", 10.0 * end.sin(), 10.0 * end.cos()),
    ]
    .map(|curve| text.curve(curve));
    let mut entries =
        [vec![format!("1 {meridian} 0 {start:?} {end:?}")], vec![format!("1 {latitude} 0 0 {TAU:?}")]];
    if curves {
        let [far, near] = [TAU, 0.0].map(|u| text.p_curve(format!("1 {u:?} 0 0 1")));
        let ring = text.p_curve(format!("1 0 {end:?} 1 0"));
        entries[0].push(format!("3 {far} {near}CN {surface} 0 {start:?} {end:?}"));
        entries[1].push(format!("2 {ring} {surface} 0 0 {TAU:?}"));
    }
    let seam = text.edge(&entries[0], ends);
    let circle = text.edge(&entries[1], [ends[1], ends[1]]);
    Cap { text, surface, seam, circle }
}

/// The part of a sphere below a latitude, 2πR h, in all orders of the wire of its seam and its circle.
#[test]
fn a_cap_is_closed_at_the_pole_that_its_seam_ends_in() {
    let latitude = 0.3_f64;
    for curves in [true, false] {
        let Cap { text, surface, seam, circle } = cap([-FRAC_PI_2, latitude], curves);
        for wire in orders(&[plus(seam), minus(circle), minus(seam)]) {
            let mut text = text.clone();
            let wire = text.wire(&wire);
            let face = text.face(surface, &[wire]);
            let (model, report) = read(&text, face);
            assert_eq!(report.notes, []);
            assert_near(area_of(&model), TAU * 100.0 * (1.0 + latitude.sin()), 1e-10);
        }
    }
}

/// A sphere of its seam alone, with and without curves in the parameters, and less a hole.
#[test]
fn a_sphere_of_a_seam_alone_is_whole() {
    for curves in [true, false] {
        let Cap { mut text, surface, seam, .. } = cap([-FRAC_PI_2, FRAC_PI_2], curves);
        let wire = text.wire(&[plus(seam), minus(seam)]);
        let face = text.face(surface, &[wire]);
        let (model, report) = read(&text, face);
        assert_eq!(report.notes, []);
        assert_near(area_of(&model), 2.0 * TAU * 100.0, 1e-10);
        // The hole at the angle 0.6 about -x, away from the seam.
        let radius = 10.0 * 0.6_f64.sin();
        let circle = text.curve(format!("2 {:?} 0 0 1 0 0 0 1 0 0 0 1 {radius:?}", -10.0 * 0.6_f64.cos()));
        let vertex = text.vertex([0.0; 3]);
        let circle = text.edge(&[format!("1 {circle} 0 0 {TAU:?}")], [vertex, vertex]);
        let hole = text.wire(&[plus(circle)]);
        let face = text.face(surface, &[wire, hole]);
        assert_near(area_of(&read(&text, face).0), TAU * 100.0 * (1.0 + 0.6_f64.cos()), 1e-6);
    }
}

/// A cone of slant height s and radius r, whose apex has no edge: π r s.
#[test]
fn a_cone_is_closed_at_its_apex() {
    let (half_angle, slant) = (0.5_f64, 10.0);
    let radius = slant * half_angle.sin();
    let mut text = BrepText::new();
    // The apex at v = -10, and the foot at v = 0.
    let surface = text.surface(format!("3 0 0 0 0 0 1 1 0 0 0 1 0\n{radius:?} {half_angle:?}"));
    let height = slant * half_angle.cos();
    let [apex, foot] = [[0.0, 0.0, -height], [radius, 0.0, 0.0]].map(|point| text.vertex(point));
    let [far, near] = [TAU, 0.0].map(|u| text.p_curve(format!("1 {u:?} 0 0 1")));
    let ring = text.p_curve("1 0 0 1 0");
    let seam = text.edge(&[format!("3 {far} {near}CN {surface} 0 {:?} 0", -slant)], [apex, foot]);
    let ring = text.edge(&[format!("2 {ring} {surface} 0 0 {TAU:?}")], [foot, foot]);
    for wire in orders(&[plus(seam), minus(ring), minus(seam)]) {
        let mut text = text.clone();
        let wire = text.wire(&wire);
        let face = text.face(surface, &[wire]);
        assert_near(area_of(&read(&text, face).0), PI * radius * slant, 1e-11);
    }
}
