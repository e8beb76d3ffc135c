//! What results say of units.

use crate::models::{placed, prepared, stretched};
use nurbs_hausdorff::shapes::{self, shape};
use nurbs_hausdorff::{
    ClearanceOptions, DVec3, DiffOptions, DistanceOptions, Engine, Facets, Model, OverlapOptions, PointCloud,
    PreparedModel, ScoreOptions, StatisticsOptions, TriangleMesh,
};

/// The corners of a box of 1, 2, 3, and triangles between them; of these models only the extents matter.
fn mesh(scale: f64, unit: Option<f64>) -> PreparedModel {
    let (vertices, triangles) = crate::models::cuboid(DVec3::splat(scale), scale * DVec3::new(2.0, 3.0, 4.0));
    let mesh = TriangleMesh::new(&vertices, &triangles).unwrap();
    PreparedModel::of_facets(&Facets::Mesh(mesh), unit).unwrap()
}

fn hint(a: &PreparedModel, b: &PreparedModel) -> Option<String> {
    let options = ClearanceOptions { scale_units: true, ..ClearanceOptions::default() };
    Engine::cpu().clearance(a, b, &options).wait().unwrap().hint
}

#[test]
fn one_unit_that_is_not_stated_is_said() {
    assert_eq!(hint(&mesh(1.0, None), &mesh(1.5, None)), None);
    assert_eq!(hint(&mesh(1.0, Some(1e-3)), &mesh(1.5, Some(1e-3))), None);
    let found = hint(&mesh(1.0, Some(1e-3)), &mesh(1.5, None)).unwrap();
    assert_eq!(found, "A is in millimetres, and B states no unit: it is taken in A's");
    let found = hint(&mesh(1.0, None), &mesh(1.5, Some(0.0254))).unwrap();
    assert_eq!(found, "B is in inches, and A states no unit: it is taken in B's");
    let found = hint(&mesh(1.0, Some(0.5)), &mesh(1.5, None)).unwrap();
    assert!(found.starts_with("A is in units of 0.5 m"), "{found}");
}

#[test]
fn extents_that_agree_after_a_factor_of_units_are_said() {
    let names = [
        (25.4, "inches", "millimetres"),
        (1000.0, "metres", "millimetres"),
        (1000.0 / 25.4, "metres", "inches"),
        (10.0, "centimetres", "millimetres"),
        (100.0, "metres", "centimetres"),
        (304.8, "feet", "millimetres"),
    ];
    for (factor, larger, smaller) in names {
        let found = hint(&mesh(1.0, None), &mesh(factor, None)).unwrap();
        assert!(found.ends_with(&format!("as if A was in {larger} and B in {smaller}")), "{found}");
        let found = hint(&mesh(factor, None), &mesh(1.0, None)).unwrap();
        assert!(found.ends_with(&format!("as if B was in {larger} and A in {smaller}")), "{found}");
        // Within 1e-3, and not beyond.
        assert!(hint(&mesh(1.0, None), &mesh(factor * 1.0009, None)).is_some());
        assert_eq!(hint(&mesh(1.0, None), &mesh(factor * 1.0011, None)), None);
    }
    // Sizes of models that state their units are compared: 25.4 mm are one inch.
    assert_eq!(hint(&mesh(1.0, Some(0.0254)), &mesh(25.4, Some(1e-3))), None);
    assert!(hint(&mesh(1.0, Some(1e-3)), &mesh(1.0, Some(0.0254))).is_some());
}

/// The boxes of control points differ from the extents, which count.
#[test]
fn extents_are_those_of_the_faces() {
    let torus = shapes::torus(4.0, 1.0).unwrap();
    let inches = prepared(&placed(&torus, stretched([1.0 / 25.4; 3])));
    let corners = [DVec3::new(-5.0, -5.0, -1.0), DVec3::new(5.0, 5.0, 1.0)];
    let cloud =
        PreparedModel::of_facets(&Facets::Cloud(PointCloud::new(corners.to_vec()).unwrap()), None).unwrap();
    let options = StatisticsOptions::default();
    let found = Engine::cpu().statistics(&cloud, &inches, &options).wait().unwrap().hint.unwrap();
    assert!(found.starts_with("the extents of A are 25.4000 times those of B"), "{found}");
}

#[test]
fn every_result_of_two_models_says_it() {
    let ball = shape("sphere").unwrap();
    let larger: Model = placed(&ball, stretched([10.0; 3]));
    let (a, b) = (prepared(&ball), prepared(&larger));
    let engine = Engine::cpu();
    let hints = [
        engine.distance(&a, &b, &DistanceOptions::default()).wait().unwrap().hint,
        engine
            .distance(&a, &b, &DistanceOptions { symmetric: true, ..DistanceOptions::default() })
            .wait()
            .unwrap()
            .hint,
        engine.diff(&a, &b, &DiffOptions::default()).wait().unwrap().hint,
        engine.statistics(&a, &b, &StatisticsOptions::default()).wait().unwrap().hint,
        engine.gaps(&a, &b, &nurbs_hausdorff::GapOptions::default()).wait().unwrap().hint,
        engine.overlap(&a, &b, &OverlapOptions::default()).wait().unwrap().hint,
        engine.score(&a, &b, &ScoreOptions::default()).wait().unwrap().hint,
    ];
    for hint in hints {
        let hint = hint.unwrap();
        assert!(hint.contains("centimetres"), "{hint}");
    }
}
