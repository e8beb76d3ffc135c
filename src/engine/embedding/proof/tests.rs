//! Faces that touch or cross themselves within their own surface: what is one point of that need not be one of the face.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use super::*;
use crate::model::Model;

type Loop = Vec<[f64; 2]>;

const UNITS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The text of the face of start + a u + b v within loops of (a, b), each at most `size` from 0.
fn plane([start, u, v]: [[f64; 3]; 3], size: f64, loops: &[Loop]) -> String {
    let at = |a: f64, b: f64| {
        let [x, y, z] = [0, 1, 2].map(|k| start[k] + a * u[k] + b * v[k]);
        format!("[{x:?},{y:?},{z:?},1]")
    };
    let corners = [[-size, -size], [-size, size], [size, -size], [size, size]].map(|[a, b]| at(a, b));
    let [a, b, c, d] = &corners;
    let knots = format!("[{0:?},{0:?},{1:?},{1:?}]", -size, size);
    let trim: Vec<String> = loops.iter().map(lines).collect();
    format!(
        r#"{{"degree":[1,1],"knots_u":{knots},"knots_v":{knots},"ctrl":[[{a},{b}],[{c},{d}]],"trim":[{}]}}"#,
        trim.join(",")
    )
}

fn lines(corners: &Loop) -> String {
    let line = |k: usize| {
        let [[a, b], [c, d]] = [corners[k], corners[(k + 1) % corners.len()]];
        format!(r#"{{"degree":1,"knots":[0,0,1,1],"ctrl":[[{a:?},{b:?},1],[{c:?},{d:?},1]]}}"#)
    };
    format!("[{}]", (0..corners.len()).map(line).collect::<Vec<_>>().join(","))
}

fn embedding(faces: &[String]) -> Embedding {
    let text = format!(r#"{{"surfaces":[{}]}}"#, faces.join(","));
    PreparedModel::new(&Model::from_json(&text).unwrap()).unwrap().embedding(&|| false)
}

fn is_contact(found: &Embedding) -> bool {
    found.embedded_unknown.as_ref().is_some_and(|unknown| unknown.why == EmbeddedDoubt::Contact)
}

/// One box, and two that have a corner in common, whose faces there go through the corner.
#[test]
fn boxes_with_a_corner_in_common_touch_although_each_face_there_is_of_both() {
    let squares = [1.0, -1.0].map(|side| vec![[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]);
    let boxes = |count: usize| -> Vec<String> {
        let faces = (0..3).flat_map(|k| {
            let [u, v] = [UNITS[(k + 1) % 3], UNITS[(k + 2) % 3]];
            let through = plane([[0.0; 3], u, v], 3.0, &squares[..count]);
            let far = (0..count).map(move |of| [1.0, -1.0][of]);
            let opposite: Vec<String> = far
                .zip(&squares)
                .map(|(sign, square)| {
                    plane([UNITS[k].map(|c| sign * c), u, v], 3.0, std::slice::from_ref(square))
                })
                .collect();
            std::iter::once(through).chain(opposite).collect::<Vec<_>>()
        });
        faces.collect()
    };
    assert_eq!(embedding(&boxes(1)).embedded, Some(true));
    assert!(is_contact(&embedding(&boxes(2))));
}

/// A square frame whose lower bar is cut, with faces that are of both ends: these are apart, or lie in each other by less than
/// loops may on a domain as large.
#[test]
fn ends_that_lie_in_each_other_are_found_although_their_faces_are_one() {
    let frame = |into: f64| {
        let [left, right] = [0.5 * into, -0.5 * into];
        let outline = vec![
            [right, 0.0],
            [2.0, 0.0],
            [2.0, 4.0],
            [-2.0, 4.0],
            [-2.0, 0.0],
            [left, 0.0],
            [left, 1.0],
            [-1.0, 1.0],
            [-1.0, 3.0],
            [1.0, 3.0],
            [1.0, 1.0],
            [right, 1.0],
        ];
        let rectangle = |a: f64, b: f64| vec![[a, 0.0], [b, 0.0], [b, 1.0], [a, 1.0]];
        let turned: Loop = outline.iter().rev().map(|&[x, y]| [y, x]).collect();
        let [x, y, z] = UNITS;
        let size = 1e5;
        let mut faces = vec![
            plane([z, x, y], size, std::slice::from_ref(&outline)),
            plane([[0.0; 3], y, x], size, &[turned]),
            plane([[0.0; 3], x, z], size, &[rectangle(-2.0, left), rectangle(right, 2.0)]),
            plane([y, [-1.0, 0.0, 0.0], z], size, &[rectangle(-left, 1.0), rectangle(-1.0, -right)]),
        ];
        for side in [1, 2, 3, 5, 7, 8, 9, 11] {
            let [[a, b], [c, d]] = [outline[side], outline[(side + 1) % outline.len()]];
            faces.push(plane([[a, b, 0.0], [c - a, d - b, 0.0], z], 2.0, &[rectangle(0.0, 1.0)]));
        }
        embedding(&faces)
    };
    assert_eq!(frame(-0.1).embedded, Some(true), "{:?}", frame(-0.1));
    for into in [1e-6, 1e-3, 0.1] {
        assert_eq!(frame(into).embedded, None, "{into}: {:?}", frame(into));
    }
}

/// A quarter of a cone, and two that touch at their apex, with one surface through it.
#[test]
fn a_surface_with_an_inner_line_that_is_a_point_is_not_embedded() {
    let lateral = |heights: &[f64]| {
        let row = |x: f64, y: f64, w: f64| {
            let points = heights.iter().map(|z| {
                let r = z.abs();
                format!("[{:?},{:?},{z:?},{w:?}]", r * x, r * y)
            });
            format!("[{}]", points.collect::<Vec<_>>().join(","))
        };
        let rows = [row(1.0, 0.0, 1.0), row(1.0, 1.0, 0.5_f64.sqrt()), row(0.0, 1.0, 1.0)].join(",");
        let last = heights.len() - 1;
        let inner: Vec<String> = (0..=last).map(|k| k.to_string()).collect();
        let trim = lines(&vec![[0.0, 0.0], [1.0, 0.0], [1.0, last as f64], [0.0, last as f64]]);
        format!(
            r#"{{"degree":[2,1],"knots_u":[0,0,0,1,1,1],"knots_v":[0,{},{last}],"ctrl":[{rows}],"trim":[{trim}]}}"#,
            inner.join(",")
        )
    };
    assert_eq!(embedding(&[lateral(&[0.0, 1.0])]).embedded, Some(true));
    assert!(is_contact(&embedding(&[lateral(&[-1.0, 0.0, 1.0])])));
}

/// A plane face that goes back on itself by many steps, each shorter than what has a direction: the ways between points that are
/// one are twice as long as all of these steps together.
#[test]
fn steps_without_a_direction_add_up() {
    let (count, step) = (250, 1e-11);
    let xs: Vec<f64> = std::iter::once(0.0).chain((0..=count).map(|k| 1.0 - f64::from(k) * step)).collect();
    let rows: Vec<String> = xs.iter().map(|x| format!("[[{x:?},0,0,1],[{x:?},1,0,1]]")).collect();
    let end = f64::from(count + 1);
    let knots: Vec<String> = (0..=count + 1).map(|k| k.to_string()).collect();
    let trim = lines(&vec![[0.0, 0.0], [end, 0.0], [end, 0.9], [end - 0.5, 1.0], [0.0, 1.0]]);
    let face = format!(
        r#"{{"degree":[1,1],"knots_u":[0,{},{end}],"knots_v":[0,0,1,1],"ctrl":[{}],"trim":[{trim}]}}"#,
        knots.join(","),
        rows.join(",")
    );
    let found = embedding(&[face]);
    assert!(found.embedded_within.is_none_or(|within| within >= 2.0 * f64::from(count) * step), "{found:?}");
}

/// A region that touches itself at a point.
#[test]
fn a_rim_that_touches_itself_is_not_embedded() {
    let bow = |apart: f64| {
        let loops = [1.0, -1.0]
            .map(|sign| [[apart, 0.0], [1.0, -1.0], [1.0, 1.0]].map(|[x, y]| [sign * x, sign * y]).to_vec());
        embedding(&[plane([[0.0; 3], UNITS[0], UNITS[1]], 3.0, &loops)])
    };
    assert_eq!(bow(1e-3).embedded, Some(true));
    assert!(is_contact(&bow(0.0)));
}

/// A plane ring that is cut at one place. The sides of the cut are joined to each other: they are nearer than edges are
/// joined, and farther from each other than points that count as one. Where they lie in each other, the face is the whole
/// ring: it has the points about which its loop winds.
#[test]
fn a_cut_ring_is_embedded_although_the_sides_of_its_cut_are_joined() {
    let ring = |into: f64| {
        let [left, right] = [0.5 * into, -0.5 * into];
        let [outer, inner] = [
            [[right, 0.0], [2.0, 0.0], [2.0, 4.0], [-2.0, 4.0], [-2.0, 0.0], [left, 0.0]],
            [[left, 1.0], [-1.0, 1.0], [-1.0, 3.0], [1.0, 3.0], [1.0, 1.0], [right, 1.0]],
        ];
        let outline: Loop = outer.into_iter().chain(inner).collect();
        embedding(&[plane([[0.0; 3], UNITS[0], UNITS[1]], 1e5, &[outline])])
    };
    for into in [-1e-6, 1e-6] {
        assert_eq!(ring(into).embedded, Some(true), "{into}: {:?}", ring(into));
    }
}

/// A plane sheet with a thin notch, whose sides are joined and come together at its end.
#[test]
fn sides_of_a_notch_run_along_each_other() {
    let width = 1e-6;
    let outline =
        vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [width, 1.0], [0.0, 0.0], [-width, 1.0], [-1.0, 1.0]];
    let found = embedding(&[plane([[0.0; 3], UNITS[0], UNITS[1]], 3.0, &[outline])]);
    assert_eq!(found.embedded, Some(true), "{found:?}");
}
