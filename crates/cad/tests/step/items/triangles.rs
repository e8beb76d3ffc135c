//! Tessellated items, alone and beside faces.

use super::{beside_a_box, named};
use crate::support::writers::step::{Id, StepText, UnitsOf};
use nurbs_hausdorff::{Error, Facets, TriangleMesh};
use nurbs_hausdorff_cad::from_step;
use nurbs_hausdorff_meshes::{MeshFile, MeshFormat};

/// The corners of a square at this height, in the order of a strip.
fn corners(text: &mut StepText, height: f64) -> Id {
    text.add(format!(
        "COORDINATES_LIST('',4,((0.,0.,{height:?}),(1.,0.,{height:?}),(0.,1.,{height:?}),(1.,1.,{height:?})))"
    ))
}

/// The same square as each kind of triangles: the entity, and its attributes from the link or the list of
/// indices on. The last one has strips that a corner given twice joins.
const SQUARES: [(&str, &str); 6] = [
    ("TRIANGULATED_FACE", "$,(),((1,2,4),(1,4,3))"),
    ("TRIANGULATED_FACE", "$,(4,2,3,1),((1,3,2),(3,4,2))"),
    ("COMPLEX_TRIANGULATED_FACE", "$,(),((1,2,3,4)),()"),
    ("COMPLEX_TRIANGULATED_FACE", "$,(),(),((1,2,4,3))"),
    ("TRIANGULATED_SURFACE_SET", "(),((1,2,4),(1,4,3))"),
    ("COMPLEX_TRIANGULATED_SURFACE_SET", "(),((1,2,3,3,3,2,4)),()"),
];

fn square(text: &mut StepText, (kind, rest): (&str, &str), height: f64) -> Id {
    let points = corners(text, height);
    text.add(format!("{kind}('tri',#{points},4,((0.,0.,1.)),{rest})"))
}

/// Reads a text without faces as a mesh.
fn mesh(text: &str) -> TriangleMesh {
    let error = from_step(text.as_bytes()).unwrap_err();
    assert_eq!(error.code(), "STEP_TRIANGLES", "{error}");
    let file = MeshFile::read(text.as_bytes(), MeshFormat::Step).unwrap();
    assert_eq!(file.unit, Some(1e-3));
    match file.facets {
        Facets::Mesh(mesh) => mesh,
        _ => panic!("a cloud"),
    }
}

fn area(mesh: &TriangleMesh) -> f64 {
    let points = mesh.vertices();
    let double = mesh.triangles().iter().map(|corners| {
        let [a, b, c] = corners.map(|corner| points[corner as usize]);
        (b - a).cross(c - a).z
    });
    0.5 * double.sum::<f64>()
}

#[test]
fn triangles_alone_are_a_mesh() {
    for kind in SQUARES {
        let mut text = StepText::new();
        let square = square(&mut text, kind, 5.0);
        let mesh = mesh(&text.of(&[square], UnitsOf::Millimetres));
        assert_eq!((mesh.triangles().len(), mesh.vertices().len()), (2, 4), "{kind:?}");
        // All triangles are seen counterclockwise from above.
        assert_eq!(area(&mesh), 1.0, "{kind:?}");
        assert!(mesh.vertices().iter().all(|point| point.z == 5.0));
    }
}

/// Items that are repositioned, as a set and within one: each placement moves what it has, and those about it too.
#[test]
fn repositioned_triangles_are_where_their_placements_move_them() {
    let mut text = StepText::new();
    let points = corners(&mut text, 5.0);
    let inner = text.axis([0.0, 7.0, 0.0], [0.0, 0.0, 1.0]);
    let face = text.add(format!(
        "(GEOMETRIC_REPRESENTATION_ITEM() REPOSITIONED_TESSELLATED_ITEM(#{inner}) REPRESENTATION_ITEM('tri') \
         TESSELLATED_FACE(#{points},4,((0.,0.,1.)),$) TESSELLATED_ITEM() \
         TESSELLATED_STRUCTURED_ITEM() TRIANGULATED_FACE((),((1,2,4),(1,4,3))))"
    ));
    let outer = text.axis([0.0, 0.0, 4.0], [0.0, 0.0, 1.0]);
    let set = text.add(format!(
        "(GEOMETRIC_REPRESENTATION_ITEM() REPOSITIONED_TESSELLATED_ITEM(#{outer}) REPRESENTATION_ITEM('set') \
         TESSELLATED_GEOMETRIC_SET((#{face})) TESSELLATED_ITEM())"
    ));
    let mesh = mesh(&text.of(&[set], UnitsOf::Millimetres));
    assert_eq!((mesh.triangles().len(), area(&mesh)), (2, 1.0));
    assert!(mesh.vertices().iter().all(|point| point.z == 9.0 && (7.0..=8.0).contains(&point.y)));
}

#[test]
fn triangles_beside_faces_are_named() {
    for kind in SQUARES {
        let mut number = 0;
        let (model, report) = beside_a_box(|text| {
            number = square(text, kind, 9.0);
            vec![number]
        });
        assert_eq!(named(&report), [("STEP_TRIANGLES", Some(number as u64))], "{kind:?}");
        assert_eq!(model.faces().len(), 6);
        assert!(report.skipped[0].why.contains("is 2 triangles"), "{}", report.skipped[0].why);
    }
}

/// Triangles that are a picture of what is read, as a whole or face by face, are no other body; those of which a
/// part is none, or is one of what is not read, are.
#[test]
fn pictures_of_what_is_read_are_not_named() {
    for (case, is_named) in [("whole", false), ("faces", false), ("part", true), ("unread", true)] {
        let mut number = 0;
        let (model, report) = beside_a_box(|text| {
            let solid = text.entities.len();
            let face =
                text.entities.iter().position(|entity| entity.starts_with("ADVANCED_FACE")).unwrap() + 1;
            let points = corners(text, 0.0);
            let plane = text.entities.iter().position(|entity| entity.starts_with("PLANE")).unwrap() + 1;
            let of = |text: &mut StepText, link: String| {
                text.add(format!("TRIANGULATED_FACE('',#{points},4,(),{link},(),((1,2,3)))"))
            };
            let parts = match case {
                "faces" => [of(text, format!("#{face}")), of(text, format!("#{face}"))],
                "unread" => [of(text, format!("#{plane}")), of(text, format!("#{face}"))],
                _ => [of(text, "$".to_owned()), of(text, format!("#{face}"))],
            };
            let link = if case == "whole" { format!("#{solid}") } else { "$".to_owned() };
            number = text.add(format!("TESSELLATED_SOLID('',(#{},#{}),{link})", parts[0], parts[1]));
            vec![number]
        });
        let expected = if is_named { vec![("STEP_TRIANGLES", Some(number as u64))] } else { vec![] };
        assert_eq!((named(&report), model.faces().len()), (expected, 6), "{case}");
    }
}

/// A solid of triangles at two places.
#[test]
fn triangles_stand_where_they_are_mapped() {
    let mut text = StepText::new();
    let context = text.context(UnitsOf::Millimetres);
    let faces = [square(&mut text, SQUARES[0], 0.0), square(&mut text, SQUARES[2], 2.0)];
    let shell = text.add(format!("TESSELLATED_SHELL('part',(#{},#{}),$)", faces[0], faces[1]));
    let part = text.representation(&[shell], context);
    let origin = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let map = text.add(format!("REPRESENTATION_MAP(#{origin},#{part})"));
    let items = [0.0, 10.0].map(|x| {
        let target = text.axis([x, 0.0, 0.0], [0.0, 0.0, 1.0]);
        text.add(format!("MAPPED_ITEM('',#{map},#{target})"))
    });
    let whole = text.representation(&items, context);
    text.product("", whole);
    let mesh = mesh(&text.text());
    assert_eq!((mesh.triangles().len(), area(&mesh)), (8, 4.0));
    let right = mesh.vertices().iter().filter(|point| point.x >= 10.0).count();
    assert_eq!((mesh.vertices().len(), right), (16, 8));
}

/// An operator whose third axis is turned mirrors in z, and one whose first and second are in x.
#[test]
fn triangles_that_are_mirrored_keep_their_outside() {
    for (axes, expected) in [([1.0, 1.0], 1.0), ([1.0, -1.0], -1.0), ([-1.0, 1.0], 1.0), ([-1.0, -1.0], -1.0)]
    {
        let mut text = StepText::new();
        let context = text.context(UnitsOf::Millimetres);
        let face = square(&mut text, SQUARES[0], 1.0);
        let part = text.representation(&[face], context);
        let origin = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
        let map = text.add(format!("REPRESENTATION_MAP(#{origin},#{part})"));
        let [x, y, z, point] = [
            format!("DIRECTION('',({:?},0.,0.))", axes[0]),
            "DIRECTION('',(0.,1.,0.))".to_owned(),
            format!("DIRECTION('',(0.,0.,{:?}))", axes[1]),
            "CARTESIAN_POINT('',(0.,0.,0.))".to_owned(),
        ]
        .map(|entity| text.add(entity));
        let target =
            text.add(format!("CARTESIAN_TRANSFORMATION_OPERATOR_3D('',$,'',#{x},#{y},#{point},1.,#{z})"));
        let item = text.add(format!("MAPPED_ITEM('',#{map},#{target})"));
        let whole = text.representation(&[item], context);
        text.product("", whole);
        // The side that is seen is that of the image of the normal.
        assert_eq!(area(&mesh(&text.text())), expected, "{axes:?}");
    }
}

/// A repositioned item without a placement is named, and its triangles are not read where they are defined.
#[test]
fn repositioned_triangles_without_a_placement_are_named() {
    for location in ["$", ""] {
        let mut number = 0;
        let (model, report) = beside_a_box(|text| {
            let face = square(text, SQUARES[0], 9.0);
            number = text.add(format!(
                "(GEOMETRIC_REPRESENTATION_ITEM() REPOSITIONED_TESSELLATED_ITEM({location}) REPRESENTATION_ITEM('') \
                 TESSELLATED_GEOMETRIC_SET((#{face})) TESSELLATED_ITEM())"
            ));
            vec![number]
        });
        assert_eq!(named(&report), [("STEP_ENTITY", Some(number as u64))], "{location}");
        assert_eq!(model.faces().len(), 6);
    }
}

#[test]
fn damaged_triangles_are_named() {
    for rest in [
        "(),((1,2,5))",
        "(),((0,1,2))",
        "(9,9,9),((1,2,3))",
        "(4,3,2),((1,2,4))",
        "(),((1,2))",
        "(),((1,2,3,4))",
        "$,$",
        "(),((1,2,2.5))",
    ] {
        let mut number = 0;
        let (_, report) = beside_a_box(|text| {
            let points = corners(text, 0.0);
            number = text.add(format!("TRIANGULATED_FACE('',#{points},4,(),$,{rest})"));
            vec![number]
        });
        assert_eq!(named(&report), [("STEP_ATTRIBUTE", Some(number as u64))], "{rest}");
    }
}

#[test]
fn a_file_with_faces_is_no_mesh() {
    let mut text = StepText::new();
    let faces = crate::faces::polygons::box_faces(&mut text, [1.0, 2.0, 4.0]);
    let solid = text.solid("", &faces);
    let text = text.of(&[solid], UnitsOf::Millimetres);
    let error = MeshFile::read(text.as_bytes(), MeshFormat::Step).unwrap_err();
    assert!(matches!(error, Error::StepUnreadable { .. }), "{error}");
}
