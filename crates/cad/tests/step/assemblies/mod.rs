//! Products, their placements and names.

mod usages;

use crate::faces::polygons::box_faces;
use crate::support::writers::step::{Id, StepText, UnitsOf};
use crate::{areas, assert_near, read};
use nurbs_hausdorff::{Model, face_path};
use nurbs_hausdorff_cad::from_step;

/// The box [0, 1] x [0, 2] x [0, 4] in a representation with these units.
fn part(text: &mut StepText, units: UnitsOf) -> Id {
    let faces = box_faces(text, [1.0, 2.0, 4.0]);
    let solid = text.solid("", &faces);
    let context = text.context(units);
    text.representation(&[solid], context)
}

#[track_caller]
fn assert_bounds(model: &Model, [low, high]: [[f64; 3]; 2]) {
    let bounds = model.bounding_box();
    for axis in 0..3 {
        assert_near(bounds.min[axis], low[axis], 1e-12);
        assert_near(bounds.max[axis], high[axis], 1e-12);
    }
}

/// Two uses of a part: where it is, and turned by a right angle about z and moved.
pub(crate) fn of_two_uses(units: UnitsOf, swapped: bool) -> String {
    let mut text = StepText::new();
    let part = part(&mut text, units);
    let product = text.product("bolt", part);
    let context = text.context(UnitsOf::Millimetres);
    let home = text.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let away = text.placement([10.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]);
    let whole = text.representation(&[home, away], context);
    let assembly = text.product("pair", whole);
    for target in [home, away] {
        let items = if swapped { [target, home] } else { [home, target] };
        let map = text.add(format!("ITEM_DEFINED_TRANSFORMATION('','',#{},#{})", items[0], items[1]));
        let [first, second] = if swapped { [whole, part] } else { [part, whole] };
        let relation = text.add(format!(
            "(REPRESENTATION_RELATIONSHIP('','',#{first},#{second})\
             REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{map})SHAPE_REPRESENTATION_RELATIONSHIP())"
        ));
        let use_of = text.add(format!("NEXT_ASSEMBLY_USAGE_OCCURRENCE('','','',#{assembly},#{product},$)"));
        let shape = text.add(format!("PRODUCT_DEFINITION_SHAPE('','',#{use_of})"));
        text.add(format!("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{relation},#{shape})"));
    }
    text.text()
}

#[test]
fn parts_stand_where_their_assembly_places_them() {
    for swapped in [false, true] {
        let (model, report) = read(&of_two_uses(UnitsOf::Millimetres, swapped));
        // Turned, the box reaches from 8 to 10 in x and from 0 to 1 in y.
        assert_bounds(&model, [[0.0, 0.0, 0.0], [10.0, 2.0, 4.0]]);
        assert_eq!(report.faces, 6);
        assert_eq!(model.faces().len(), 12);
        let total: f64 = areas(&model).iter().sum();
        assert_near(total, 2.0 * 28.0, 1e-12);
        assert_eq!(model.faces().next().unwrap().name(), Some("pair / bolt / face 0"));
        // Each use has a shell of its own.
        let shells: Vec<_> = model.faces().map(|face| face.shell()).collect();
        assert_eq!(shells, [[Some(0); 6], [Some(1); 6]].concat());
        let solids: Vec<_> = model.faces().map(|face| face.solid()).collect();
        assert_eq!(solids, shells);
    }
}

/// A use of the box [0, 1] x [0, 2] x [0, 4] by an operator with these axes and this scale; an axis that is left out is `$`.
fn by_operator(axes: [Option<[f64; 3]>; 3], scale: f64) -> String {
    let mut text = StepText::new();
    let part = part(&mut text, UnitsOf::Millimetres);
    let context = text.context(UnitsOf::Millimetres);
    let home = text.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let map = text.add(format!("REPRESENTATION_MAP(#{home},#{part})"));
    let origin = text.add("CARTESIAN_POINT('',(0.,0.,0.))".to_owned());
    let [x, y, z] = axes.map(|axis| match axis {
        Some([x, y, z]) => format!("#{}", text.add(format!("DIRECTION('',({x:?},{y:?},{z:?}))"))),
        None => "$".to_owned(),
    });
    let operator =
        text.add(format!("CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',{x},{y},#{origin},{scale:?},{z})"));
    let item = text.add(format!("MAPPED_ITEM('',#{map},#{operator})"));
    let whole = text.representation(&[item, home], context);
    text.product("whole", whole);
    text.text()
}

#[test]
fn operators_turn_scale_and_reflect() {
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let back = x.map(|at: f64| -at);
    let right = ([None; 3], 1.0, [[0.0; 3], [1.0, 2.0, 4.0]]);
    let scaled = ([Some(x), Some(y), Some(z)], 2.0, [[0.0; 3], [2.0, 4.0, 8.0]]);
    let turned = ([Some(y), Some(back), Some(z)], 1.0, [[-2.0, 0.0, 0.0], [0.0, 1.0, 4.0]]);
    let reflected = ([Some(back), Some(y), Some(z)], 1.0, [[-1.0, 0.0, 0.0], [0.0, 2.0, 4.0]]);
    for (axes, scale, bounds) in [right, scaled, turned, reflected] {
        assert_bounds(&read(&by_operator(axes, scale)).0, bounds);
    }
    // Without a second axis, ISO 10303-42 has this as a reflection, and others as a turn.
    let (_, report) = from_step(by_operator([Some(back), None, Some(z)], 1.0).as_bytes()).unwrap();
    assert!(report.skipped[0].why.contains("a second axis"), "{:?}", report.skipped);
}

/// A representation of a part of a shape, which a property is about, names a body that stands in another one: the
/// body stands where that is placed, and not at its own place besides. One that stands nowhere else is read.
#[test]
fn a_property_of_a_body_is_no_other_body() {
    let kinds = ["PROPERTY_DEFINITION", "PRODUCT_DEFINITION_SHAPE"];
    for (of_property, expected, kind) in kinds.iter().flat_map(|kind| [(false, 6, kind), (true, 12, kind)]) {
        let mut text = StepText::new();
        let context = text.context(UnitsOf::Millimetres);
        let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
        let solid = text.solid("", &faces);
        let part = text.representation(&[solid], context);
        let product = text.product("bolt", part);
        let named = if of_property {
            let faces = box_faces(&mut text, [3.0, 3.0, 3.0]);
            text.solid("", &faces)
        } else {
            solid
        };
        let again = text.representation(&[named], context);
        let shape = text.add(format!("PRODUCT_DEFINITION_SHAPE('','',#{product})"));
        let aspect = text.add(format!("SHAPE_ASPECT('','solid',#{shape},.F.)"));
        let property = text.add(format!("{kind}('','shape with a volume',#{aspect})"));
        text.add(format!("SHAPE_DEFINITION_REPRESENTATION(#{property},#{again})"));
        let home = text.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        let away = text.placement([10.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]);
        let whole = text.representation(&[home, away], context);
        text.product("whole", whole);
        let map = text.add(format!("ITEM_DEFINED_TRANSFORMATION('','',#{home},#{away})"));
        text.add(format!(
            "(REPRESENTATION_RELATIONSHIP('','',#{part},#{whole})\
             REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{map})SHAPE_REPRESENTATION_RELATIONSHIP())"
        ));
        let (model, report) = read(&text.text());
        assert_eq!((report.faces, model.faces().len()), (expected, expected));
        let low = if of_property { 0.0 } else { 8.0 };
        assert_bounds(&model, [[low, 0.0, 0.0], [10.0, if of_property { 3.0 } else { 1.0 }, 4.0]]);
    }
}

#[test]
fn a_part_in_inches_stands_in_an_assembly_in_millimetres() {
    let (model, _) = read(&of_two_uses(UnitsOf::InchesAndDegrees, false));
    assert_bounds(&model, [[10.0 - 50.8, 0.0, 0.0], [25.4, 50.8, 101.6]]);
}

#[test]
fn mapped_items_place_a_representation() {
    let mut text = StepText::new();
    let part = part(&mut text, UnitsOf::Millimetres);
    let context = text.context(UnitsOf::Millimetres);
    let origin = text.placement([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let map = text.add(format!("REPRESENTATION_MAP(#{origin},#{part})"));
    let target = text.placement([5.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let item = text.add(format!("MAPPED_ITEM('',#{map},#{target})"));
    let whole = text.representation(&[item], context);
    text.product("", whole);
    let (model, _) = read(&text.text());
    // The axes x, y and z of the part become y, z and x, and its height 1 becomes x = 5.
    assert_bounds(&model, [[4.0, 0.0, 0.0], [8.0, 1.0, 2.0]]);
}

/// A drawing that shows a body by a mapped item, and a representation of a property that lists itself, have no bodies of
/// their own: nothing is left out.
#[test]
fn drawings_and_properties_are_no_bodies() {
    let mut text = StepText::new();
    let part = part(&mut text, UnitsOf::Millimetres);
    let context = text.context(UnitsOf::Millimetres);
    let product = text.product("box", part);
    let [origin, target] =
        [0.0, 7.0].map(|x| text.placement([x, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]));
    let map = text.add(format!("REPRESENTATION_MAP(#{origin},#{part})"));
    let item = text.add(format!("MAPPED_ITEM('',#{map},#{target})"));
    text.add(format!("DRAUGHTING_MODEL('',(#{target},#{item}),#{context})"));
    let property = text.add(format!("PROPERTY_DEFINITION('material property','density',#{product})"));
    let density = text.add(format!("REPRESENTATION('density',(#{}),#{context})", property + 1));
    assert_eq!(density, property + 1);
    text.add(format!("PROPERTY_DEFINITION_REPRESENTATION(#{property},#{density})"));
    let (model, report) = read(&text.text());
    assert_eq!((model.faces().len(), report.skipped.len()), (6, 0));
    assert_bounds(&model, [[0.0; 3], [1.0, 2.0, 4.0]]);
}

/// A relationship without a transformation joins the bodies to the product's representation.
#[test]
fn related_representations_are_one() {
    let mut text = StepText::new();
    let part = part(&mut text, UnitsOf::Millimetres);
    let context = text.context(UnitsOf::Millimetres);
    let empty = text.representation(&[], context);
    text.add(format!("SHAPE_REPRESENTATION_RELATIONSHIP('','',#{empty},#{part})"));
    text.product("it''s \\X2\\00DC\\X0\\", empty);
    let (model, report) = read(&text.text());
    assert_eq!((report.faces, model.faces().len()), (6, 6));
    assert_eq!(model.faces().next().unwrap().name(), Some("it's Ü / face 0"));
}

/// An assembly that contains itself is left out, and ends.
#[test]
fn an_assembly_in_itself_is_left_out() {
    let mut text = StepText::new();
    let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
    let solid = text.solid("", &faces);
    let context = text.context(UnitsOf::Millimetres);
    let origin = text.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    // The representation is the third instance after this one.
    let number = text.entities.len() + 3;
    let map = text.add(format!("REPRESENTATION_MAP(#{origin},#{number})"));
    let item = text.add(format!("MAPPED_ITEM('',#{map},#{origin})"));
    assert_eq!(text.representation(&[solid, item], context), number);
    let (model, report) = from_step(text.text().as_bytes()).unwrap();
    assert_eq!(model.faces().len(), 6);
    assert_eq!(report.skipped.len(), 1);
    assert_eq!((report.skipped[0].code, report.skipped[0].entity), ("STEP_NESTING", Some(number as u64)));
}

/// A part whose placement refers to nothing is where it is, and the report says so.
#[test]
fn a_placement_of_nothing_is_reported() {
    let text = of_two_uses(UnitsOf::Millimetres, false);
    let line = text.lines().find(|line| line.contains("(REPRESENTATION_RELATIONSHIP('','',#")).unwrap();
    let number: u64 = line[1..].split_once('=').unwrap().0.parse().unwrap();
    let start = line.find("'',#").unwrap() + 3;
    let end = start + line[start..].find(',').unwrap();
    let broken = format!("{}#99999{}", &line[..start], &line[end..]);
    let (_, report) = from_step(text.replace(line, &broken).as_bytes()).unwrap();
    let found: Vec<_> = report.skipped.iter().map(|skipped| (skipped.code, skipped.entity)).collect();
    assert_eq!(found, [("STEP_REFERENCE", Some(number))]);
}

/// States that a product stands in another one, moved along x, as a use with this name.
fn place(text: &mut StepText, [part, product]: [Id; 2], [whole, assembly]: [Id; 2], x: f64, name: &str) {
    let home = text.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let away = text.placement([x, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let map = text.add(format!("ITEM_DEFINED_TRANSFORMATION('','',#{home},#{away})"));
    let relation = text.add(format!(
        "(REPRESENTATION_RELATIONSHIP('','',#{part},#{whole})\
         REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{map})SHAPE_REPRESENTATION_RELATIONSHIP())"
    ));
    let use_of = format!("NEXT_ASSEMBLY_USAGE_OCCURRENCE('id','{name}','',#{assembly},#{product},$)");
    let use_of = text.add(use_of);
    let shape = text.add(format!("PRODUCT_DEFINITION_SHAPE('','',#{use_of})"));
    text.add(format!("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{relation},#{shape})"));
}

/// Copies that lie on each other are two bodies, with names of their uses or without, and also where no use is moved.
#[test]
fn two_uses_of_a_product_at_one_place_are_two_bodies() {
    for names in [["one", "other"], ["", ""]] {
        for x in [0.0, 3.0] {
            let mut text = StepText::new();
            let part = part(&mut text, UnitsOf::Millimetres);
            let bolt = [part, text.product("bolt", part)];
            let context = text.context(UnitsOf::Millimetres);
            let shape = text.representation(&[], context);
            let whole = [shape, text.product("pair", shape)];
            names.into_iter().for_each(|name| place(&mut text, bolt, whole, x, name));
            let (model, report) = from_step(text.text().as_bytes()).unwrap();
            assert_eq!((model.faces().len(), report.faces), (12, 6), "{names:?} at {x}");
            assert_bounds(&model, [[x, 0.0, 0.0], [x + 1.0, 2.0, 4.0]]);
        }
    }
}

/// A machine of two pumps, each of a housing and of bolts; the bolt's body has its product's name, and
/// the housing's another one. The uses of the bolts have these names.
fn of_two_levels(bolts: &[&str], bolt: &str) -> String {
    let mut text = StepText::new();
    let context = text.context(UnitsOf::Millimetres);
    let product = |text: &mut StepText, name: &str, body: Option<&str>| {
        let items = body.map(|body| {
            let faces = box_faces(text, [1.0, 2.0, 4.0]);
            text.solid(body, &faces)
        });
        let shape = text.representation(&Vec::from_iter(items), context);
        [shape, text.product(name, shape)]
    };
    let bolt = product(&mut text, bolt, Some(bolt));
    let housing = product(&mut text, "housing", Some("cast"));
    let pump = product(&mut text, "pump", None);
    let machine = product(&mut text, "machine", None);
    place(&mut text, housing, pump, 0.0, "");
    for (index, name) in bolts.iter().enumerate() {
        place(&mut text, bolt, pump, 5.0 + 3.0 * index as f64, name);
    }
    place(&mut text, pump, machine, 0.0, "NAUO1");
    place(&mut text, pump, machine, 100.0, "NAUO2");
    text.text()
}

/// Returns the names of parts in the order of the file.
fn parts(text: &str) -> Vec<String> {
    let (model, _) = from_step(text.as_bytes()).unwrap();
    let mut parts: Vec<String> = Vec::new();
    for face in model.faces() {
        let (part, _) = face.name().unwrap().rsplit_once(" / ").unwrap();
        if parts.last().is_none_or(|last| last != part) {
            parts.push(part.to_owned());
        }
    }
    parts
}

#[test]
fn faces_have_the_names_of_all_levels() {
    let text = of_two_levels(&["", ""], "bolt");
    let (model, report) = read(&text);
    assert_eq!((report.faces, model.faces().len()), (12, 36));
    assert_bounds(&model, [[0.0, 0.0, 0.0], [109.0, 2.0, 4.0]]);
    let pump =
        |name: &str| ["housing / cast", "bolt", "bolt (2)"].map(|part| format!("machine / {name} / {part}"));
    assert_eq!(parts(&text), [pump("pump"), pump("pump (2)")].concat());
    assert_eq!(
        face_path(model.faces().next().unwrap().name().unwrap()),
        ["machine", "pump", "housing", "cast", "face 0"]
    );
}

#[test]
fn the_uses_of_a_part_have_their_own_names() {
    let of = |bolts: &[&str]| {
        let parts = parts(&of_two_levels(bolts, "bolt"));
        let own = parts[1..=bolts.len()].iter().map(|part| part.rsplit_once(" / ").unwrap().1.to_owned());
        own.collect::<Vec<_>>()
    };
    // The name of the use stands for the part's if it holds it.
    assert_eq!(of(&["bolt:1", "bolt:2"]), ["bolt:1", "bolt:2"]);
    assert_eq!(of(&["left", "right"]), ["bolt (left)", "bolt (right)"]);
    assert_eq!(of(&["left", "left"]), ["bolt (left)", "bolt (left) (2)"]);
    // A number that is in use already is not given again.
    assert_eq!(of(&["bolt (2)", "", ""]), ["bolt (2)", "bolt", "bolt (3)"]);
    assert_eq!(of(&["=>[0:1:1:2]", "12"]), ["bolt", "bolt (2)"]);
    assert_eq!(of(&["Next assembly relationship"; 2]), ["bolt", "bolt (2)"]);
}

#[test]
fn a_name_with_a_separator_is_one_level() {
    let text = of_two_levels(&["in / out"], "M6 / 20");
    let (model, _) = read(&text);
    let name = model.faces().nth(6).unwrap().name().unwrap();
    assert_eq!(face_path(name), ["machine", "pump", "M6 / 20 (in / out)", "face 6"]);
    assert_eq!(name, "machine / pump / M6 // 20 (in // out) / face 6");
}
