//! What a file states and the model is not made of is said, with its number and kind.

use crate::faces::polygons::box_faces;
use crate::support::writers::step::{Id, StepText, UnitsOf};
use crate::{areas, assert_near};
use nurbs_hausdorff::{Facets, Model, ReadReport};
use nurbs_hausdorff_cad::from_step;
use nurbs_hausdorff_meshes::{MeshFile, MeshFormat};

/// The codes and reasons of the notes.
fn notes(report: &ReadReport) -> Vec<(&'static str, &str)> {
    report.notes.iter().map(|note| (note.code, note.why.as_str())).collect()
}

/// A polygon in the plane z = 0, as a loop.
fn polygon(text: &mut StepText, corners: &[[f64; 2]]) -> Id {
    let points: Vec<String> = corners.iter().map(|&[x, y]| format!("#{}", text.point([x, y, 0.0]))).collect();
    text.add(format!("POLY_LOOP('',({}))", points.join(",")))
}

/// A square of this size whose lower left corner is at x on the x axis, seen counterclockwise or clockwise.
fn square(text: &mut StepText, x: f64, size: f64, counterclockwise: bool) -> Id {
    let mut corners = [[x, 0.0], [x + size, 0.0], [x + size, size], [x, size]];
    if !counterclockwise {
        corners.reverse();
    }
    polygon(text, &corners)
}

fn plane(text: &mut StepText) -> Id {
    let at = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    text.add(format!("PLANE('',#{at})"))
}

/// A face is connected: a bound beside the outer one is said if it bounds a region by its direction, and refused if
/// it is a hole outside of the face.
#[test]
fn a_bound_outside_of_the_outer_one_is_said() {
    for (counterclockwise, expected) in [(true, "BREP_SEVERAL_REGIONS"), (false, "BREP_LOOP_DIRECTIONS")] {
        let mut text = StepText::new();
        let loops = [square(&mut text, 0.0, 2.0, true), square(&mut text, 5.0, 1.0, counterclockwise)];
        let plane_of_face = plane(&mut text);
        let face = text.face(&loops, plane_of_face, true);
        let other = square(&mut text, 20.0, 3.0, true);
        let other_plane = plane(&mut text);
        let other = text.face(&[other], other_plane, true);
        let shell = text.open_shell(&[face, other]);
        let (model, report) = from_step(text.of(&[shell], UnitsOf::Millimetres).as_bytes()).unwrap();
        if counterclockwise {
            assert_eq!(report.skipped, []);
            assert_eq!(areas(&model), [5.0, 9.0]);
            assert_eq!(report.notes[0].code, expected);
            assert!(report.notes[0].why.contains("loops 0, 1"), "{report:?}");
        } else {
            assert_eq!((report.skipped[0].code, report.skipped[0].entity), (expected, Some(face as u64)));
            assert_eq!(areas(&model), [9.0]);
        }
    }
}

/// A box, with this uncertainty in its context and this instance more among the units.
fn boxed(uncertainty: f64, more: &str) -> (Model, ReadReport) {
    let mut text = StepText::new();
    let faces = box_faces(&mut text, [6.0, 6.0, 7.0]);
    let solid = text.solid("", &faces);
    let context = text.context(UnitsOf::Millimetres);
    let representation = text.representation(&[solid], context);
    text.product("part", representation);
    let text = text.text();
    let text = text.replace("LENGTH_MEASURE(1.E-6)", &format!("LENGTH_MEASURE({uncertainty:?})"));
    let text =
        text.replace("GLOBAL_UNIT_ASSIGNED_CONTEXT((", &format!("GLOBAL_UNIT_ASSIGNED_CONTEXT(({more}"));
    from_step(text.as_bytes()).unwrap()
}

/// The diagonal of the box is 11.
#[test]
fn an_uncertainty_of_the_size_of_the_part_is_not_believed() {
    for uncertainty in [1e-6, 0.1] {
        assert_eq!(notes(&boxed(uncertainty, "").1), [], "{uncertainty}");
    }
    for uncertainty in [0.12, 1000.0] {
        let (model, report) = boxed(uncertainty, "");
        assert_near(areas(&model).iter().sum(), 72.0 + 24.0 * 7.0, 1e-12);
        let [(code, why)] = notes(&report)[..] else { panic!("{report:?}") };
        assert_eq!(code, "STEP_UNCERTAINTY");
        assert!(why.contains("diagonal of the file's points, 11.0 mm"), "{why}");
    }
}

#[test]
fn what_is_no_unit_among_the_units_is_said() {
    let (_, report) = boxed(1e-6, "#1,");
    let [(code, why)] = notes(&report)[..] else { panic!("{report:?}") };
    assert_eq!(code, "STEP_UNIT");
    assert!(why.starts_with("#1, ") && why.ends_with("and is no unit"), "{why}");
}

/// A face between a curve of degree 1 from (0, 0) to (1, 0) and three straight lines. The curve has a knot of
/// multiplicity 2 in its middle, whose control points are `jump` apart.
fn with_knot(jump: f64) -> (Model, ReadReport) {
    let mut text = StepText::new();
    let xs = [0.0, 0.5, 0.5 + jump, 1.0];
    let poles: Vec<String> = xs.iter().map(|&x| format!("#{}", text.point([x, 0.0, 0.0]))).collect();
    let curve = text.add(format!(
        "B_SPLINE_CURVE_WITH_KNOTS('',1,({}),.UNSPECIFIED.,.F.,.F.,(2,2,2),(0.,0.5,1.),.UNSPECIFIED.)",
        poles.join(",")
    ));
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let vertices = corners.map(|[x, y]| text.vertex([x, y, 0.0]));
    let mut edges = vec![(text.edge(curve, [vertices[0], vertices[1]], true), true)];
    for from in 1..4 {
        let to = (from + 1) % 4;
        let [[x, y], [end_x, end_y]] = [corners[from], corners[to]];
        let line = text.line([x, y, 0.0], [end_x - x, end_y - y, 0.0]);
        edges.push((text.edge(line, [vertices[from], vertices[to]], true), true));
    }
    let path = text.edge_loop(&edges);
    let surface = plane(&mut text);
    let face = text.face(&[path], surface, true);
    let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
    let shell = text.open_shell(&[&[face], faces.as_slice()].concat());
    from_step(text.of(&[shell], UnitsOf::Millimetres).as_bytes()).unwrap()
}

#[test]
fn an_edge_whose_curve_is_torn_is_named() {
    let (model, report) = with_knot(0.0);
    assert_eq!(report.skipped, []);
    assert_near(areas(&model)[0], 1.0, 1e-12);
    for jump in [0.1, 1e-4, -0.1] {
        let (_, report) = with_knot(jump);
        let codes: Vec<_> = report.skipped.iter().map(|face| face.code).collect();
        assert_eq!(codes, ["BREP_EDGE_TORN"], "{jump}: {report:?}");
    }
}

/// A surface over the offset of a line, whose reference direction is along the line or across it.
#[test]
fn an_offset_along_its_own_curve_is_named() {
    for (direction, is_read) in
        [([1.0, 0.0, 0.0], false), ([1.0, 0.0, 1e-12], false), ([0.0, 0.0, 1.0], true)]
    {
        let mut text = StepText::new();
        let line = text.line([0.0; 3], [1.0, 0.0, 0.0]);
        let part = text.add(format!(
            "TRIMMED_CURVE('',#{line},(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(2.)),.T.,.PARAMETER.)"
        ));
        let reference = text.direction(direction);
        let offset = text.add(format!("OFFSET_CURVE_3D('',#{part},3.,.F.,#{reference})"));
        let up = text.direction([0.0, 0.0, 1.0]);
        let up = text.add(format!("VECTOR('',#{up},1.)"));
        let swept = text.add(format!("SURFACE_OF_LINEAR_EXTRUSION('',#{offset},#{up})"));
        let whole = text.add(format!("RECTANGULAR_TRIMMED_SURFACE('',#{swept},0.,2.,0.,5.,.T.,.T.)"));
        let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
        let solid = text.solid("", &faces);
        let (model, report) = from_step(text.of(&[solid, whole], UnitsOf::Millimetres).as_bytes()).unwrap();
        let codes: Vec<_> = report.skipped.iter().map(|face| (face.code, face.entity)).collect();
        if is_read {
            assert_eq!(codes, []);
            assert_near(areas(&model)[6], 10.0, 1e-12);
            assert_near(model.bounding_box().max.y, 3.0, 1e-12);
        } else {
            assert_eq!(codes, [("BREP_OFFSET_PARALLEL", Some(whole as u64))], "{direction:?}");
        }
    }
}

/// A file of more levels than are read is refused by that reason, whichever way its instances are ordered.
#[test]
fn an_assembly_of_too_many_levels_is_refused_by_name() {
    for levels in [60, 70, 5000] {
        let mut text = StepText::new();
        let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
        let solid = text.solid("", &faces);
        let context = text.context(UnitsOf::Millimetres);
        let origin = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
        let mut inner = text.representation(&[solid], context);
        for _ in 1..levels {
            let map = text.add(format!("REPRESENTATION_MAP(#{origin},#{inner})"));
            let item = text.add(format!("MAPPED_ITEM('',#{map},#{origin})"));
            inner = text.representation(&[item], context);
        }
        text.product("part", inner);
        match from_step(text.text().as_bytes()) {
            Ok((model, report)) => {
                assert_eq!((levels, model.faces().len(), report.skipped.len()), (60, 6, 0))
            }
            Err(error) => {
                assert!(levels > 64, "{levels}: {error}");
                assert!(error.to_string().contains("more than 64 levels of assemblies"), "{error}");
            }
        }
    }
}

/// A product whose definition names a document, without a representation, beside a part; that of a document is
/// none.
#[test]
fn a_product_of_another_file_is_named() {
    for context in ["part definition", "digital document definition"] {
        let mut text = StepText::new();
        let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
        let solid = text.solid("", &faces);
        let product = text.add("PRODUCT('id','far\\X\\0A','',())");
        let formation = text.add(format!("PRODUCT_DEFINITION_FORMATION('','',#{product})"));
        let frame = text.add(format!("PRODUCT_DEFINITION_CONTEXT('{context}',$,'design')"));
        let document = text.add("DOCUMENT_FILE('far.stp','','',$,'',$)");
        let definition = text.add(format!(
            "PRODUCT_DEFINITION_WITH_ASSOCIATED_DOCUMENTS('','',#{formation},#{frame},(#{document}))"
        ));
        let (model, report) = from_step(text.of(&[solid], UnitsOf::Millimetres).as_bytes()).unwrap();
        assert_eq!(model.faces().len(), 6);
        let skipped: Vec<_> = report.skipped.iter().map(|face| (face.code, face.entity)).collect();
        let expected = [("STEP_EXTERNAL", Some(definition as u64))];
        assert_eq!(skipped, if context.starts_with("part") { expected.to_vec() } else { vec![] });
        assert!(report.skipped.iter().all(|face| !face.why.contains('\n')), "{report:?}");
    }
}

fn triangle(text: &mut StepText) -> Id {
    let points = text.add("COORDINATES_LIST('',3,((0.,0.,0.),(1.,0.,0.),(0.,1.,0.)))");
    text.add(format!("TRIANGULATED_FACE('',#{points},3,((0.,0.,1.)),$,(),((1,2,3)))"))
}

/// Triangles that no representation contains are the mesh of a file that has nothing else, in the unit of its
/// contexts if it has any; beside others they are named.
#[test]
fn triangles_that_stand_nowhere_are_read_where_they_are_all() {
    for (context, other, unit) in [
        (None, false, None),
        (Some(UnitsOf::Metres), false, Some(1e-3)),
        (Some(UnitsOf::Millimetres), true, Some(1e-3)),
    ] {
        let mut text = StepText::new();
        let face = triangle(&mut text);
        let shell = text.add(format!("TESSELLATED_SHELL('loose',(#{face}),$)"));
        let context = context.map(|units| text.context(units));
        let size = if unit.is_some() && !other { 1000.0 } else { 1.0 };
        if let (true, Some(context)) = (other, context) {
            let face = triangle(&mut text);
            text.representation(&[face], context);
        }
        let text = text.text();
        assert_eq!(from_step(text.as_bytes()).unwrap_err().code(), "STEP_TRIANGLES");
        let file = MeshFile::read(text.as_bytes(), MeshFormat::Step).unwrap();
        let Facets::Mesh(mesh) = &file.facets else { panic!("a cloud") };
        assert_eq!((mesh.triangles().len(), file.unit), (1, unit));
        assert_eq!(mesh.vertices().iter().map(|point| point.x).fold(0.0, f64::max), size);
        let codes = |read: &[(&'static str, String)]| {
            assert!(
                read.iter().all(|(_, why)| why.contains(&format!("#{shell}, TESSELLATED_SHELL"))),
                "{read:?}"
            );
            read.iter().map(|&(code, _)| code).collect::<Vec<_>>()
        };
        let notes: Vec<_> = file.notes.iter().map(|note| (note.code, note.why.clone())).collect();
        let skipped: Vec<_> = file.skipped.iter().map(|part| (part.code, part.why.clone())).collect();
        let expected = if other { [vec![], vec!["STEP_LOOSE"]] } else { [vec!["STEP_LOOSE"], vec![]] };
        assert_eq!([codes(&notes), codes(&skipped)], expected);
    }
}
