//! Uses of products: each is placed and has a shape, or is named.

use super::{assert_bounds, part, place};
use crate::read;
use crate::support::writers::step::{Id, StepText, UnitsOf};
use nurbs_hausdorff::ReadReport;
use nurbs_hausdorff_cad::from_step;

fn named(report: &ReadReport) -> Vec<(&'static str, Option<u64>)> {
    report.skipped.iter().map(|skipped| (skipped.code, skipped.entity)).collect()
}

/// A part and an assembly without a use of it, each as its representation and product.
fn two_products(text: &mut StepText) -> [[Id; 2]; 2] {
    let part = part(text, UnitsOf::Millimetres);
    let product = text.product("bolt", part);
    let context = text.context(UnitsOf::Millimetres);
    let origin = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let whole = text.representation(&[origin], context);
    let assembly = text.product("pair", whole);
    [[part, product], [whole, assembly]]
}

fn usage(text: &mut StepText, assembly: Id, product: Id) -> Id {
    text.add(format!("NEXT_ASSEMBLY_USAGE_OCCURRENCE('','','',#{assembly},#{product},$)"))
}

#[test]
fn a_use_that_nothing_places_is_named() {
    let mut text = StepText::new();
    let [part, whole] = two_products(&mut text);
    place(&mut text, part, whole, 5.0, "");
    let second = usage(&mut text, whole[1], part[1]);
    let (model, report) = from_step(text.text().as_bytes()).unwrap();
    assert_eq!(named(&report), [("STEP_PLACE", Some(second as u64))]);
    assert_bounds(&model, [[5.0, 0.0, 0.0], [6.0, 2.0, 4.0]]);
}

/// The part stands at an unknown place in an assembly that is placed, and not where it is itself.
#[test]
fn a_part_at_an_unknown_place_is_not_drawn() {
    let mut text = StepText::new();
    let [part, sub] = two_products(&mut text);
    let [fixed, whole] = two_products(&mut text);
    let inner = usage(&mut text, sub[1], part[1]);
    place(&mut text, sub, whole, 100.0, "");
    place(&mut text, fixed, whole, 10.0, "");
    let (model, report) = from_step(text.text().as_bytes()).unwrap();
    assert_eq!(named(&report), [("STEP_PLACE", Some(inner as u64))]);
    assert_bounds(&model, [[10.0, 0.0, 0.0], [11.0, 2.0, 4.0]]);
}

/// As of a part in another file: it is placed, and has placements alone.
#[test]
fn a_part_without_a_shape_is_named() {
    let mut text = StepText::new();
    let [part, whole] = two_products(&mut text);
    place(&mut text, part, whole, 5.0, "");
    let context = text.context(UnitsOf::Millimetres);
    let origin = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let blank = text.representation(&[origin], context);
    let elsewhere = text.product("elsewhere", blank);
    text.add(format!("APPLIED_DOCUMENT_REFERENCE($,'',(#{elsewhere}))"));
    place(&mut text, [blank, elsewhere], whole, 9.0, "");
    let empty = text.representation(&[origin], context);
    let nothing = text.product("nothing", empty);
    place(&mut text, [empty, nothing], whole, 9.0, "");
    let line = text.line([0.0; 3], [1.0, 0.0, 0.0]);
    let wire = text.representation(&[line], context);
    let cable = text.product("cable", wire);
    place(&mut text, [wire, cable], whole, 9.0, "");
    let (model, report) = from_step(text.text().as_bytes()).unwrap();
    assert_eq!((report.skipped.len(), model.faces().len()), (1, 6));
    assert_eq!(report.skipped[0].code, "STEP_PLACE");
    assert!(report.skipped[0].why.contains("\"elsewhere\""), "{}", report.skipped[0].why);
    // A component without a body is said too, and keeps no verdict back.
    assert_eq!((report.notes.len(), report.notes[0].code), (1, "STEP_EMPTY_PART"));
    assert!(report.notes[0].why.contains("\"nothing\""), "{}", report.notes[0].why);
}

/// The same of a part that a mapped item places.
#[test]
fn a_mapped_part_without_a_shape_is_named() {
    let mut text = StepText::new();
    let [part, whole] = two_products(&mut text);
    place(&mut text, part, whole, 5.0, "");
    let context = text.context(UnitsOf::Millimetres);
    let origin = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let blank = text.representation(&[origin], context);
    let elsewhere = text.product("elsewhere", blank);
    text.add(format!("APPLIED_EXTERNAL_IDENTIFICATION_ASSIGNMENT('',$,$,(#{elsewhere}))"));
    let map = text.add(format!("REPRESENTATION_MAP(#{origin},#{blank})"));
    let item = text.add(format!("MAPPED_ITEM('',#{map},#{origin})"));
    let other = text.representation(&[item], context);
    text.product("other", other);
    let (_, report) = from_step(text.text().as_bytes()).unwrap();
    assert_eq!(named(&report), [("STEP_PLACE", Some(item as u64))]);
}

/// A product without any representation.
#[test]
fn a_product_without_a_representation_is_named() {
    let mut text = StepText::new();
    let [part, whole] = two_products(&mut text);
    place(&mut text, part, whole, 5.0, "");
    let product = text.add("PRODUCT('id','nothing','',())");
    let formation = text.add(format!("PRODUCT_DEFINITION_FORMATION('','',#{product})"));
    let nothing = text.add(format!("PRODUCT_DEFINITION('','',#{formation},$)"));
    let use_of = usage(&mut text, whole[1], nothing);
    let (_, report) = from_step(text.text().as_bytes()).unwrap();
    assert_eq!(named(&report), [("STEP_PLACE", Some(use_of as u64))]);
}

/// Mapped items place parts too, each one use.
#[test]
fn mapped_items_place_uses() {
    for uses in [2, 3] {
        let mut text = StepText::new();
        let part = part(&mut text, UnitsOf::Millimetres);
        let product = text.product("bolt", part);
        let context = text.context(UnitsOf::Millimetres);
        let origin = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
        let map = text.add(format!("REPRESENTATION_MAP(#{origin},#{part})"));
        let items = [3.0, 6.0].map(|x| {
            let target = text.axis([x, 0.0, 0.0], [0.0, 0.0, 1.0]);
            text.add(format!("MAPPED_ITEM('',#{map},#{target})"))
        });
        let whole = text.representation(&items, context);
        let assembly = text.product("pair", whole);
        let last = (0..uses).map(|_| usage(&mut text, assembly, product)).last();
        let (model, report) = from_step(text.text().as_bytes()).unwrap();
        let expected = if uses == 2 { vec![] } else { vec![("STEP_PLACE", last.map(|last| last as u64))] };
        assert_eq!(named(&report), expected);
        assert_bounds(&model, [[3.0, 0.0, 0.0], [7.0, 2.0, 4.0]]);
    }
}

/// Some writers exchange the items of a transformation; which representation each is of shows it.
#[test]
fn exchanged_items_of_a_transformation_are_seen() {
    for exchanged in [false, true] {
        let mut text = StepText::new();
        let context = text.context(UnitsOf::Millimetres);
        let faces = crate::faces::polygons::box_faces(&mut text, [1.0, 2.0, 4.0]);
        let solid = text.solid("", &faces);
        let home = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
        let away = text.axis([0.0, 0.0, 5.0], [0.0, 0.0, 1.0]);
        let part = text.representation(&[solid, home], context);
        let whole = text.representation(&[away], context);
        text.product("part", part);
        text.product("whole", whole);
        let items = if exchanged { [away, home] } else { [home, away] };
        let map = text.add(format!("ITEM_DEFINED_TRANSFORMATION('','',#{},#{})", items[0], items[1]));
        text.add(format!(
            "(REPRESENTATION_RELATIONSHIP('','',#{part},#{whole})\
             REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{map})SHAPE_REPRESENTATION_RELATIONSHIP())"
        ));
        let (model, _) = read(&text.text());
        assert_bounds(&model, [[0.0, 0.0, 5.0], [1.0, 2.0, 9.0]]);
    }
}

/// An assembly of two uses of an assembly of two uses, and so on: short to write, and more places than memory holds.
#[test]
fn places_are_counted_before_they_are_made() {
    let levels = 24;
    let mut text = StepText::new();
    let mut inner = part(&mut text, UnitsOf::Millimetres);
    let context = text.context(UnitsOf::Millimetres);
    let origin = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    for level in 0..levels {
        let map = text.add(format!("REPRESENTATION_MAP(#{origin},#{inner})"));
        let items = [0.0, 1.0].map(|part| {
            let target = text.axis([10.0 * part * f64::from(1 << level), 0.0, 0.0], [0.0, 0.0, 1.0]);
            text.add(format!("MAPPED_ITEM('',#{map},#{target})"))
        });
        inner = text.representation(&items, context);
    }
    let error = from_step(text.text().as_bytes()).unwrap_err();
    assert_eq!(error.code(), "TOO_MANY_FACES");
    assert!(error.to_string().contains(&format!("{} faces", 6 << levels)), "{error}");
}
