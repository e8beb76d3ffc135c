//! Senses and tolerances of loops.

use crate::support::writers::step::{Id, StepText, UnitsOf};
use crate::{areas, assert_near, read};
use nurbs_hausdorff_cad::from_step;

/// The number of flags by which a file may reverse a part of a face; two flags cancel each other.
const TURNS: u32 = 5;

/// The square [0, 4]² with the hole [1, 2]² seen from above. Bits of `turns` say: edges run against
/// their lines, the loops run against the face and their bounds turn them, oriented edges against their
/// edges, the surface looks down, the shell uses the face in reverse.
fn plate(text: &mut StepText, turns: u32) -> Id {
    let is_turned = |bit: u32| turns >> bit & 1 == 1;
    let logical = |value: bool| if value { ".T." } else { ".F." };
    let mut loops = Vec::new();
    // The material is on the left, seen from above.
    for corners in
        [[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]], [[1.0, 1.0], [1.0, 2.0], [2.0, 2.0], [2.0, 1.0]]]
    {
        let mut corners = corners.map(|[x, y]| [x, y, 0.0]);
        // Against the face, seen along its normal: the bound says so.
        if is_turned(1) != is_turned(3) {
            corners.reverse();
        }
        let vertices = corners.map(|corner| text.vertex(corner));
        let mut edges = Vec::new();
        for index in 0..4 {
            let next = (index + 1) % 4;
            // The edge runs from `from` to `to`, and its line likewise or in reverse.
            let [from, to] = if is_turned(2) { [next, index] } else { [index, next] };
            let along = [0, 1, 2].map(|axis| corners[to][axis] - corners[from][axis]);
            let along = along.map(|length| if is_turned(0) { -length } else { length });
            let line = text.line(corners[from], along);
            let edge = text.edge(line, [vertices[from], vertices[to]], !is_turned(0));
            edges.push((edge, !is_turned(2)));
        }
        let path = text.edge_loop(&edges);
        loops.push(text.bound(path, !is_turned(1)));
    }
    let normal = if is_turned(3) { -1.0 } else { 1.0 };
    let placement = text.placement([0.0; 3], [0.0, 0.0, normal], [1.0, 0.0, 0.0]);
    let plane = text.add(format!("PLANE('',#{placement})"));
    let face = text.add(format!("ADVANCED_FACE('plate',(#{},#{}),#{plane},.T.)", loops[0], loops[1]));
    if !is_turned(4) {
        return face;
    }
    text.add(format!("ORIENTED_FACE('',*,#{face},{})", logical(false)))
}

#[test]
fn a_face_is_the_same_in_every_sense() {
    for turns in 0..1 << TURNS {
        let mut text = StepText::new();
        let face = plate(&mut text, turns);
        let shell = text.open_shell(&[face]);
        let (model, report) = read(&text.of(&[shell], UnitsOf::Millimetres));
        assert_near(areas(&model)[0], 15.0, 1e-12);
        assert_eq!((report.trims, report.notes.len()), (8, 0), "{turns:b}");
        let found = model.faces().next().unwrap();
        assert_eq!(found.name(), Some("part / plate"));
        assert_eq!(found.to_arrays().reversed, turns >> 4 & 1 == 1, "{turns:b}");
    }
}

/// A loop may run along an edge and back: the slit bounds nothing, and the face is the square.
#[test]
fn a_slit_bounds_nothing() {
    let mut text = StepText::new();
    let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]];
    let vertices = corners.map(|corner| text.vertex(corner));
    let sides: Vec<(Id, bool)> = (0..4)
        .map(|from| {
            let to = (from + 1) % 4;
            let along = [0, 1, 2].map(|axis| corners[to][axis] - corners[from][axis]);
            let line = text.line(corners[from], along);
            (text.edge(line, [vertices[from], vertices[to]], true), true)
        })
        .collect();
    let ends = [[1.0, 1.0, 0.0], [3.0, 2.0, 0.0]].map(|end| text.vertex(end));
    let line = text.line([1.0, 1.0, 0.0], [2.0, 1.0, 0.0]);
    let slit = text.edge(line, ends, true);
    let loops = [text.edge_loop(&sides), text.edge_loop(&[(slit, true), (slit, false)])];
    let placement = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let plane = text.add(format!("PLANE('',#{placement})"));
    let face = text.face(&loops, plane, true);
    let shell = text.open_shell(&[face]);
    let (model, report) = read(&text.of(&[shell], UnitsOf::Millimetres));
    assert_near(areas(&model)[0], 16.0, 1e-12);
    assert_eq!(report.trims, 4);
}

/// A triangle whose two edges at a corner have vertices of their own, apart by this length, in a file
/// of this uncertainty.
fn open_triangle(apart: f64, uncertainty: &str) -> String {
    let mut text = StepText::new();
    let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0], [apart, 0.0, 0.0]];
    let vertices = corners.map(|corner| text.vertex(corner));
    let edges = [[3, 1], [1, 2], [2, 0]].map(|[from, to]: [usize; 2]| {
        let along = [0, 1, 2].map(|axis| corners[to][axis] - corners[from][axis]);
        let line = text.line(corners[from], along);
        (text.edge(line, [vertices[from], vertices[to]], true), true)
    });
    let path = text.edge_loop(&edges);
    let placement = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let plane = text.add(format!("PLANE('',#{placement})"));
    let face = text.face(&[path], plane, true);
    let shell = text.open_shell(&[face]);
    text.of(&[shell], UnitsOf::Millimetres).replace("LENGTH_MEASURE(1.E-6)", uncertainty)
}

/// A loop may be open by the uncertainty that the file states, and the gap contains it.
#[test]
fn the_uncertainty_of_a_file_is_the_tolerance_of_its_loops() {
    let apart = 2e-3;
    let (model, report) = read(&open_triangle(apart, "LENGTH_MEASURE(2.E-3)"));
    assert_near(areas(&model)[0], 6.0, 1e-3);
    assert!((0.5 * apart..=1.1 * apart).contains(&report.gap), "{}", report.gap);
    let error = from_step(open_triangle(apart, "LENGTH_MEASURE(1.E-6)").as_bytes()).unwrap_err();
    assert_eq!(error.code(), "BREP_UNREADABLE");
}
