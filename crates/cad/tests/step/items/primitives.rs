//! Primitives of constructive solid geometry, by their areas and boxes.

use super::{beside_a_box, named};
use crate::support::writers::step::{Id, StepText, UnitsOf};
use crate::{areas, assert_near, read};
use nurbs_hausdorff::{Model, PreparedModel};
use std::f64::consts::PI;

/// Reads a primitive alone, as the root of a solid too.
fn primitive(add: impl Fn(&mut StepText, Id) -> Id) -> Model {
    let [alone, root] = [false, true].map(|is_root| {
        let mut text = StepText::new();
        let placement = text.placement([1.0, 2.0, 3.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        let made = add(&mut text, placement);
        let item = if is_root { text.add(format!("CSG_SOLID('',#{made})")) } else { made };
        read(&text.of(&[item], UnitsOf::Millimetres)).0
    });
    assert_eq!(alone.faces().len(), root.faces().len());
    alone
}

/// Checks the faces' areas, the corners of the box and that the solid is closed.
#[track_caller]
fn assert_is(model: &Model, expected: &[f64], [low, high]: [[f64; 3]; 2]) {
    let found = areas(model);
    assert_eq!(found.len(), expected.len());
    for (found, &expected) in found.into_iter().zip(expected) {
        assert_near(found, expected, 1e-9);
    }
    let bounds = model.bounding_box();
    for axis in 0..3 {
        assert_near(bounds.min[axis], low[axis], 1e-12);
        assert_near(bounds.max[axis], high[axis], 1e-12);
    }
    let solid = PreparedModel::new(model).unwrap().solid();
    assert!(solid.closed, "{solid:?}");
}

#[test]
fn a_block_has_six_faces() {
    let block = primitive(|text, at| text.add(format!("BLOCK('b',#{at},2.,3.,5.)")));
    // The axes x, y and z of the block are y, z and x of space.
    let expected = [6.0, 6.0, 10.0, 10.0, 15.0, 15.0];
    assert_is(&block, &expected, [[1.0, 2.0, 3.0], [6.0, 4.0, 6.0]]);
}

#[test]
fn a_cylinder_begins_at_its_placement() {
    let cylinder = primitive(|text, at| text.add(format!("RIGHT_CIRCULAR_CYLINDER('c',#{at},7.,2.)")));
    let expected = [2.0 * PI * 2.0 * 7.0, PI * 4.0, PI * 4.0];
    assert_is(&cylinder, &expected, [[1.0, 0.0, 1.0], [8.0, 4.0, 5.0]]);
}

#[test]
fn a_sphere_is_about_its_centre() {
    let sphere = primitive(|text, _| {
        let center = text.point([1.0, 2.0, 3.0]);
        text.add(format!("SPHERE('s',2.,#{center})"))
    });
    assert_is(&sphere, &[16.0 * PI], [[-1.0, 0.0, 1.0], [3.0, 4.0, 5.0]]);
}

#[test]
fn a_torus_is_about_its_axis() {
    let torus = primitive(|text, at| text.add(format!("TORUS('t',#{at},5.,2.)")));
    assert_is(&torus, &[4.0 * PI * PI * 10.0], [[-1.0, -5.0, -4.0], [3.0, 9.0, 10.0]]);
}

/// The face x y of the wedge is a trapezium of area (2 + ltx) / 2 · 3, which is extruded by 5.
#[test]
fn a_wedge_is_a_block_cut_off() {
    for top in [0.5_f64, 0.0] {
        let wedge =
            primitive(|text, at| text.add(format!("RIGHT_ANGULAR_WEDGE('w',#{at},2.,3.,5.,{top:?})")));
        let front = 1.5 * (2.0 + top);
        let slope = 5.0 * (2.0 - top).hypot(3.0);
        let mut found = areas(&wedge);
        found.sort_by(f64::total_cmp);
        let mut expected = vec![front, front, 10.0, 15.0, slope];
        expected.extend((top > 0.0).then_some(5.0 * top));
        expected.sort_by(f64::total_cmp);
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.into_iter().zip(expected) {
            assert_near(found, expected, 1e-12);
        }
        let bounds = wedge.bounding_box();
        // The axes x, y and z of the wedge are y, z and x of space.
        assert_near(bounds.min.x + bounds.min.y + bounds.min.z, 6.0, 1e-12);
        assert_near(bounds.max.x + bounds.max.y + bounds.max.z, 16.0, 1e-12);
        assert!(PreparedModel::new(&wedge).unwrap().solid().closed);
    }
}

/// A cone of half angle arctan 3/4 and height 4 below its smaller end of radius r: its base has the radius r + 3
/// and its side the area π (2 r + 3) 5.
#[test]
fn a_cone_widens_against_its_axis() {
    for radius in [2.0, 0.0] {
        let mut text = StepText::new();
        let at = text.axis([1.0, 2.0, 3.0], [0.0, 0.0, 1.0]);
        let half_angle = 0.75_f64.atan();
        let cone = text.add(format!("RIGHT_CIRCULAR_CONE('c',#{at},4.,{radius:?},{half_angle:?})"));
        let (model, report) = read(&text.of(&[cone], UnitsOf::Millimetres));
        let base = radius + 3.0;
        let mut expected = vec![PI * (2.0 * radius + 3.0) * 5.0, PI * base * base];
        expected.extend((radius > 0.0).then_some(PI * radius * radius));
        assert_is(&model, &expected, [[1.0 - base, 2.0 - base, -1.0], [1.0 + base, 2.0 + base, 3.0]]);
        assert_eq!(report.notes.iter().map(|note| note.code).collect::<Vec<_>>(), ["STEP_CONE"]);
    }
}

/// What is no primitive that is read is named with all that it is made of.
#[test]
fn booleans_and_impossible_primitives_are_named() {
    for case in 0..5 {
        let mut number = 0;
        let (model, report) = beside_a_box(|text| {
            let at = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
            let block = text.add(format!("BLOCK('',#{at},1.,1.,1.)"));
            number = match case {
                0 => text.add(format!("BOOLEAN_RESULT('',.UNION.,#{block},#{block})")),
                1 => text.add(format!("RIGHT_CIRCULAR_CONE('',#{at},2.,1.,1.6)")),
                4 => text.add(format!("RIGHT_ANGULAR_WEDGE('',#{at},2.,1.,1.,2.)")),
                2 => text.add(format!("BLOCK('',#{at},1.,-1.,1.)")),
                _ => text.add(format!("TORUS('',#{at},1.,2.)")),
            };
            if case == 0 { vec![text.add(format!("CSG_SOLID('',#{number})"))] } else { vec![number, block] }
        });
        let found = named(&report);
        let expected = if case == 0 { number + 1 } else { number };
        assert_eq!((found.len(), found[0].1), (1, Some(expected as u64)), "{case}: {report:?}");
        assert_eq!(model.faces().len(), if case == 0 { 6 } else { 12 });
    }
}
