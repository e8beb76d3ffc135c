//! Bodies whose boundary meets itself at known places.

use crate::models::{Quad, box_of_faces, cube_with_pocket, mesh, of, of_quads, prepared};
use nurbs_hausdorff::{
    CheckOptions, CheckedBody, DVec3, EmbeddedDoubt, Engine, NamedModel, PreparedModel, SelfOverlap, shapes,
};
use nurbs_hausdorff_cad::from_step;
use std::f64::consts::TAU;

fn triangles_of(quads: &[Quad]) -> PreparedModel {
    let corners: Vec<DVec3> = quads.iter().flat_map(|&[a, b, c, d]| [a, b, c, a, c, d]).collect();
    let triangles: Vec<[u32; 3]> =
        (0..corners.len() as u32 / 3).map(|index| [0, 1, 2].map(|corner| 3 * index + corner)).collect();
    mesh(&corners, &triangles)
}

fn body(model: &PreparedModel) -> CheckedBody {
    let options = CheckOptions::default();
    let result = Engine::cpu().check(&[NamedModel { name: None, model }], &options).wait().unwrap();
    let [body] = &result.bodies[..] else { panic!("{:?}", result.bodies) };
    // One of the three, with what belongs to it.
    assert_eq!(body.embedded_within.is_some(), body.embedded == Some(true), "{body:?}");
    assert_eq!(body.self_overlap.is_some(), body.embedded == Some(false), "{body:?}");
    assert_eq!(body.embedded_unknown.is_some(), body.embedded.is_none(), "{body:?}");
    body.clone()
}

fn self_overlap(model: &PreparedModel) -> Option<SelfOverlap> {
    let body = body(model);
    assert!(body.closed);
    body.self_overlap
}

fn is_embedded(model: &PreparedModel) {
    let body = body(model);
    assert_eq!(body.embedded, Some(true), "{body:?}");
}

/// A band of width 0.8 and height 1 along a closed curve in the plane, in 32 parts.
fn band(curve: impl Fn(f64) -> [f64; 2]) -> Vec<Quad> {
    const PARTS: usize = 32;
    let at = |part: usize| {
        let t = TAU * (part % PARTS) as f64 / PARTS as f64;
        let [point, next] = [t - 1e-6, t + 1e-6].map(|t| DVec3::from((curve(t)[0], curve(t)[1], 0.0)));
        let across = 0.4 * (next - point).cross(DVec3::Z).normalize();
        // Right below, left below, left above, right above.
        [point + across, point - across, point - across + DVec3::Z, point + across + DVec3::Z]
    };
    let sides = |part: usize| {
        let [a, b] = [at(part), at(part + 1)];
        [0, 1, 2, 3].map(|side| [a[side], a[(side + 1) % 4], b[(side + 1) % 4], b[side]])
    };
    (0..PARTS).flat_map(sides).collect()
}

/// The figure of eight crosses itself at the origin, at a slope of 1.5.
fn eight(t: f64) -> [f64; 2] {
    [4.0 * t.sin(), 3.0 * (2.0 * t).sin()]
}

/// No face is turned over, each is, and every third: which way they are turned decides nothing.
const TURNED: [usize; 3] = [0, 1, 3];

/// Turns each face over whose number is a multiple of `every`; none for 0.
fn turned_over(quads: &[Quad], every: usize) -> Vec<Quad> {
    let turned = |(index, &[a, b, c, d]): (usize, &Quad)| {
        if every > 0 && index % every == 0 { [d, c, b, a] } else { [a, b, c, d] }
    };
    quads.iter().enumerate().map(turned).collect()
}

fn is_at_the_crossing(found: &SelfOverlap) {
    let [x, y, z] = found.point;
    // Both strands have the point: each is 0.4 wide to either side, and 3.6 times longer than wide there.
    assert!(x.abs() < 0.8 && y.abs() < 0.8 && 0.0 < z && z < 1.0, "{found:?}");
    assert!(0.0 < found.radius && found.radius < 0.4, "{found:?}");
    assert_eq!(found.winding, 2);
}

#[test]
fn a_band_that_crosses_itself_counts_twice_where_it_does() {
    for every in TURNED {
        let found = self_overlap(&prepared(&of_quads(&turned_over(&band(eight), every)))).unwrap();
        is_at_the_crossing(&found);
        // Each part has four faces; the origin is where parts 31 and 0 meet, and where 15 and 16 do.
        let parts: Vec<usize> = found.faces.iter().map(|face| face / 4).collect();
        let is_of = |strand: [usize; 2]| parts.iter().any(|part| strand.contains(part));
        assert!(is_of([31, 0]) && is_of([15, 16]), "{:?}", found.faces);
    }
    let ring = band(|t| [4.0 * t.cos(), 4.0 * t.sin()]);
    is_embedded(&prepared(&of_quads(&ring)));
}

#[test]
fn a_mesh_that_crosses_itself_is_told_in_the_same_way() {
    let found = self_overlap(&triangles_of(&band(eight))).unwrap();
    is_at_the_crossing(&found);
    assert!(found.faces.is_empty());
    is_embedded(&triangles_of(&band(|t| [4.0 * t.cos(), 4.0 * t.sin()])));
}

#[test]
fn a_pocket_through_the_floor_turns_space_over_below_it() {
    for every in TURNED {
        let found = self_overlap(&prepared(&of_quads(&turned_over(&cube_with_pocket(12.0), every)))).unwrap();
        let [x, y, z] = found.point;
        assert!(x.abs() < 2.0 && y.abs() < 2.0 && -2.0 < z && z < 0.0, "{found:?}");
        assert_eq!(found.winding, -1);
        assert!(found.radius <= 1.0, "{found:?}");
    }
    is_embedded(&prepared(&of_quads(&cube_with_pocket(9.9))));
    // Its floor is in the plane of the bottom.
    let touching = body(&prepared(&of_quads(&cube_with_pocket(10.0))));
    assert_eq!(touching.embedded_unknown.unwrap().why, EmbeddedDoubt::Contact);
}

/// The pocket's rim is 0.3 above the top's, within the gap that the file states: the strip between them is as thick
/// as the pocket is through the floor, so that the gap explains it, and not where it is through by 2.
#[test]
fn what_gaps_explain_is_no_fault() {
    let found = |depth: f64| {
        let mut faces = crate::models::faces(&of_quads(&cube_with_pocket(depth)));
        for (index, face) in faces.iter_mut().enumerate() {
            face.gap = 0.35;
            for point in &mut face.surface.control_points {
                if (8..12).contains(&index) && point[2] == 10.0 {
                    point[2] += 0.3;
                }
            }
        }
        self_overlap(&prepared(&of(faces)))
    };
    assert_eq!(found(10.2), None);
    assert_eq!(found(12.0).unwrap().winding, -1);
}

/// The faces of one body in a file of several have their numbers in the file.
#[test]
fn faces_have_the_numbers_of_the_file() {
    let mut faces = crate::models::faces(&box_of_faces(DVec3::splat(20.0), DVec3::splat(21.0)));
    faces.extend(crate::models::faces(&of_quads(&cube_with_pocket(12.0))));
    let model = prepared(&of(faces));
    let named = [NamedModel { name: None, model: &model }];
    let result = Engine::cpu().check(&named, &CheckOptions::default()).wait().unwrap();
    let [first, second] = &result.bodies[..] else { panic!("{:?}", result.bodies) };
    assert_eq!(first.self_overlap, None);
    let found = second.self_overlap.as_ref().unwrap();
    // Behind the six faces of the box: the cube's bottom is the 13th face of its body, the pocket's walls the 9th to
    // the 12th.
    assert!(found.faces.contains(&(6 + 12)), "{found:?}");
    assert!(found.faces.iter().any(|face| (6 + 8..6 + 12).contains(face)), "{found:?}");
}

#[test]
fn shapes_that_do_not_meet_themselves_have_no_such_place() {
    for model in [
        shapes::sphere(DVec3::new(1.0, 2.0, 3.0), 2.0).unwrap(),
        shapes::torus(3.0, 1.0).unwrap(),
        box_of_faces(DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0)),
    ] {
        is_embedded(&prepared(&model));
    }
}

/// A plate with two bores: faces with holes, whose cuts are tangent to these.
#[test]
fn a_plate_with_bores_is_embedded_as_its_file_has_it_and_as_a_mesh() {
    for bytes in
        [&include_bytes!("../../examples/parts/a.step")[..], include_bytes!("../../examples/parts/b.step")]
    {
        let plate = PreparedModel::new(&from_step(bytes).unwrap().0).unwrap();
        is_embedded(&plate);
        let body = body(&plate);
        // Faces meet at right angles: with the sine of half of these, and nothing but rounding.
        assert!(body.embedded_within.unwrap() < 1e-6 * plate.bounding_box().diagonal(), "{body:?}");
    }
}

/// One corner of an octahedron is drawn through the face on the other side, up to it, and nearly.
#[test]
fn an_octahedron_that_a_corner_pierces_is_not_embedded() {
    let with = |x: f64| {
        let corners = [
            [x, 0.1, 0.1],
            [-1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.0, -1.0],
        ];
        let triangles =
            [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
        mesh(&corners.map(DVec3::from_array), &triangles)
    };
    // The face through the corners at -x, y and z has the point (-0.8, 0.1, 0.1).
    for x in [1.0, 0.3, -0.7999] {
        is_embedded(&with(x));
    }
    for x in [-0.8, -0.81, -0.9] {
        assert_ne!(body(&with(x)).embedded, Some(true), "{x}");
    }
    assert_eq!(body(&with(-0.9)).embedded, Some(false));
    // The corner on the other side is within its triangles: the octahedron is inside out.
    is_embedded(&with(-2.0));
}

/// Sheets have an answer too, and faces have the numbers of the file.
#[test]
fn a_sheet_that_ends_on_itself_may_meet_itself() {
    let at = |x: f64, z: f64| [DVec3::new(x, 0.0, z), DVec3::new(x, 1.0, z)];
    let strip = |reach: f64| {
        let line = [at(0.0, 0.0), at(2.0, 0.0), at(2.0, 1.0), at(1.0, 1.0), at(1.0, reach)];
        let quads: Vec<Quad> =
            line.windows(2).map(|pair| [pair[0][0], pair[1][0], pair[1][1], pair[0][1]]).collect();
        body(&prepared(&of_quads(&quads)))
    };
    let above = strip(1e-3);
    assert!(!above.closed && above.embedded == Some(true), "{above:?}");
    for reach in [0.0, -1.0] {
        let unknown = strip(reach).embedded_unknown.unwrap();
        assert_eq!(unknown.why, EmbeddedDoubt::Contact);
        let mut faces = unknown.faces.clone();
        faces.sort_unstable();
        assert_eq!(faces, [0, 3], "{unknown:?}");
        let [x, y, z] = unknown.point.unwrap();
        assert!((x - 1.0).abs() < 1e-6 && (-1e-6..1.000001).contains(&y) && z.abs() < 1e-6, "{unknown:?}");
    }
}

#[test]
fn a_check_without_time_says_of_no_embedded_body_that_it_meets_itself() {
    let ring = prepared(&of_quads(&band(|t| [4.0 * t.cos(), 4.0 * t.sin()])));
    let options = CheckOptions { max_seconds: Some(1e-9), ..CheckOptions::default() };
    let result = Engine::cpu().check(&[NamedModel { name: None, model: &ring }], &options).wait().unwrap();
    assert_ne!(result.bodies[0].embedded, Some(false));
}
