//! What the report says of faces that the file leaves open.

use super::{TORUS, torus_area};
use crate::support::writers::brep::{BrepText, Child, line, minus, plus, rectangle};
use crate::{assert_near, read, region};
use nurbs_hausdorff::{FaceId, ReadReport};
use nurbs_hausdorff_cad::from_brep;
use std::f64::consts::{FRAC_PI_2, TAU};

fn codes(report: &ReadReport) -> Vec<(usize, &str)> {
    let number = |face: &FaceId| match face {
        FaceId::Number(number) => *number,
        other => unreachable!("{other}"),
    };
    report.notes.iter().map(|note| (number(&note.face), note.code)).collect()
}

#[test]
fn a_face_whose_complement_fits_as_well_is_named() {
    let (low, high) = ([1.0, 2.0], [2.5, 3.0]);
    let patch = || [rectangle(low, high)];
    assert_eq!(codes(&region(TORUS, &patch()).1), [(0, "BREP_COMPLEMENT")]);
    let sphere = "4 0 0 0 0 0 1 1 0 0 0 1 0 10";
    let octant = || [rectangle([1.0, 0.1], [2.5, 1.0])];
    assert_eq!(codes(&region(sphere, &octant()).1), [(0, "BREP_COMPLEMENT")]);
    // The rest of a plane or of a cylinder is no face.
    for open in ["1 0 0 0 0 0 1 1 0 0 0 1 0", "2 0 0 0 0 0 1 1 0 0 0 1 0 20"] {
        assert_eq!(codes(&region(open, &patch()).1), []);
    }
}

/// The edge of the pole states which of its angles the face has.
#[test]
fn a_face_with_the_edge_of_a_pole_is_not_named() {
    let mut text = BrepText::new();
    let surface = text.surface("4 0 0 0 0 0 1 1 0 0 0 1 0 10");
    let pole = FRAC_PI_2;
    let corners = [[1.0, 0.1], [2.0, 0.1], [2.0, pole], [1.0, pole]];
    let vertices = [0; 3].map(|_| text.vertex([0.0; 3]));
    let ends = [[0, 1], [1, 2], [2, 2], [2, 0]].map(|ends| ends.map(|index| vertices[index]));
    let edges = [0, 1, 2, 3].map(|index| {
        let (entry, [first, last]) = line(corners[index], corners[(index + 1) % 4]);
        let p_curve = text.p_curve(entry);
        let entries = [format!("2 {p_curve} {surface} 0 {first:?} {last:?}")];
        plus(match index {
            2 => text.degenerate(&entries, vertices[2]),
            _ => text.edge(&entries, ends[index]),
        })
    });
    let wire = text.wire(&edges);
    let face = text.face(surface, &[wire]);
    let (model, report) = read(&text, face);
    assert_near(crate::area_of(&model), 100.0 * (1.0 - 0.1_f64.sin()), 1e-11);
    assert_eq!(codes(&report), []);
}

/// A shell of a patch of a torus and of the rest of it, whose edges both use, the second against
/// their directions, or not.
#[test]
fn neighbours_that_use_the_edges_the_other_way_confirm_a_face() {
    let (low, high) = ([1.0, 2.0], [2.5, 3.0]);
    for (sign, notes) in [('+', vec![]), ('-', vec![(0, "BREP_COMPLEMENT"), (1, "BREP_COMPLEMENT")])] {
        let mut text = BrepText::new();
        let surface = text.surface(TORUS);
        let corners = [0; 4].map(|_| text.vertex([0.0; 3]));
        let mut edges = Vec::new();
        for (index, (entry, [first, last])) in rectangle(low, high).into_iter().enumerate() {
            let p_curve = text.p_curve(entry);
            let entry = format!("2 {p_curve} {surface} 0 {first:?} {last:?}");
            edges.push(text.edge(&[entry], [corners[index], corners[(index + 1) % 4]]));
        }
        let around: Vec<Child> = edges.iter().map(|&edge| plus(edge)).collect();
        let back: Vec<Child> = edges.iter().rev().map(|&edge| minus(edge)).collect();
        let wires = [text.wire(&around), text.wire(&back)];
        let faces = wires.map(|wire| text.face(surface, &[wire]));
        let shell = text.shape("Sh\n", &[plus(faces[0]), Child { shape: faces[1], sign, location: 0 }]);
        let (model, report) = read(&text, shell);
        let areas: Vec<f64> = model.faces().map(|face| crate::area::area(&face)).collect();
        assert_near(areas[0], torus_area(low, high), 1e-11);
        assert_near(areas[0] + areas[1], super::TORUS_AREA, 1e-11);
        assert_eq!(codes(&report), notes);
    }
}

/// Two rings around the tube of a torus, or around its axis, bound one of two bands.
#[test]
fn rings_bound_the_band_on_their_left() {
    let rings = |[low, high]: [f64; 2], axis: usize| {
        let ends = |value: f64, [start, end]: [f64; 2]| match axis {
            0 => [[start, value], [end, value]],
            _ => [[value, start], [value, end]],
        };
        let ways = if axis == 0 { [[0.0, TAU], [TAU, 0.0]] } else { [[TAU, 0.0], [0.0, TAU]] };
        [(low, ways[0]), (high, ways[1])].map(|(value, way)| {
            let [start, end] = ends(value, way);
            vec![line(start, end)]
        })
    };
    for (loops, expected) in [
        (rings([1.0, 2.5], 0), torus_area([0.0, 1.0], [TAU, 2.5])),
        (rings([2.5, 1.0], 0), super::TORUS_AREA - torus_area([0.0, 1.0], [TAU, 2.5])),
        (rings([1.0, 2.5], 1), torus_area([1.0, 0.0], [2.5, TAU])),
        (rings([2.5, 1.0], 1), super::TORUS_AREA - torus_area([1.0, 0.0], [2.5, TAU])),
    ] {
        let (model, report) = region(TORUS, &loops);
        assert_near(crate::area_of(&model), expected, 1e-11);
        assert_eq!(codes(&report), [(0, "BREP_COMPLEMENT")]);
    }
}

/// The band of a torus between two rings and its seam, whichever way the loop turns: the rest of the torus
/// does not touch the seam's edge.
#[test]
fn a_seam_decides_which_part_of_a_torus_its_loop_bounds() {
    let [low, high] = [1.0, 2.5];
    for is_clockwise in [false, true] {
        let mut text = BrepText::new();
        let surface = text.surface(TORUS);
        let [foot, top] = [0; 2].map(|_| text.vertex([0.0; 3]));
        let [far, near] = [TAU, 0.0].map(|u| text.p_curve(format!("1 {u:?} 0 0 1")));
        let sides = if is_clockwise { [near, far] } else { [far, near] };
        let rings = [low, high].map(|v| text.p_curve(format!("1 0 {v:?} 1 0")));
        let [low_ring, high_ring] = [(rings[0], foot), (rings[1], top)]
            .map(|(ring, at)| text.edge(&[format!("2 {ring} {surface} 0 0 {TAU:?}")], [at, at]));
        let entry = format!("3 {} {}CN {surface} 0 {low:?} {high:?}", sides[0], sides[1]);
        let seam = text.edge(&[entry], [foot, top]);
        let children = if is_clockwise {
            [plus(seam), plus(high_ring), minus(seam), minus(low_ring)]
        } else {
            [plus(low_ring), plus(seam), minus(high_ring), minus(seam)]
        };
        let wire = text.wire(&children);
        let face = text.face(surface, &[wire]);
        let (model, report) = read(&text, face);
        assert_near(crate::area_of(&model), torus_area([0.0, low], [TAU, high]), 1e-11);
        let notes = if is_clockwise { vec![(0, "BREP_LOOP_TURNED")] } else { Vec::new() };
        assert_eq!(codes(&report), notes);
    }
}

/// A square tube, closed and not periodic, with a ring at its foot and none at the height at which
/// its seam ends.
#[test]
fn a_seam_that_ends_without_an_edge_is_named() {
    let around = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 1.0]];
    let poles: String = around.map(|[x, y]| format!("{x:?} {y:?} 0 {x:?} {y:?} 5 ")).concat();
    let mut text = BrepText::new();
    let surface = text.surface(format!("9 0 0 0 0 1 1 5 2 5 2 {poles} 0 2 1 1 2 1 3 1 4 2 0 2 5 2"));
    let [foot, top] = [0.0, 3.0].map(|z| text.vertex([1.0, 1.0, z]));
    let [far, near] = [4.0, 0.0].map(|u| text.p_curve(format!("1 {u:?} 0 0 1")));
    let ring = text.p_curve("1 0 0 1 0");
    let seam = text.edge(&[format!("3 {far} {near}CN {surface} 0 0 3")], [foot, top]);
    let ring = text.edge(&[format!("2 {ring} {surface} 0 0 4")], [foot, foot]);
    for wire in super::orders(&[plus(ring), plus(seam), minus(seam)]) {
        let mut text = text.clone();
        let wire = text.wire(&wire);
        let face = text.face(surface, &[wire]);
        let (model, report) = read(&text, face);
        assert_near(crate::area_of(&model), 8.0 * 3.0, 1e-12);
        assert_eq!(codes(&report), [(0, "BREP_SEAM_END")]);
    }
    // Of two edges that are no seam, the line across the surface is no joint.
    let other = text.edge(&[format!("2 {near} {surface} 0 0 3")], [foot, top]);
    let seam = text.edge(&[format!("2 {far} {surface} 0 0 3")], [foot, top]);
    let wire = text.wire(&[plus(ring), plus(seam), minus(other)]);
    let face = text.face(surface, &[wire]);
    let error = from_brep(&text.text(plus(face))).unwrap_err();
    assert!(error.to_string().contains("open by"), "{error}");
}
