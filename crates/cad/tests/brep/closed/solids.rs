//! Files of bodies whose faces close, at edges that are closed, thin or of high degree.

use crate::support::models::fault;
use nurbs_hausdorff::{Engine, Overlap, PreparedModel};
use nurbs_hausdorff_cad::{from_brep, from_step};

/// The model of a file of faults, if it is there.
fn prepared(test: &str, path: &str) -> Option<PreparedModel> {
    let bytes = fault(test, path)?;
    let read = if path.ends_with(".brep") {
        from_brep(std::str::from_utf8(&bytes).unwrap())
    } else {
        from_step(&bytes)
    };
    let (model, mut report) = read.unwrap();
    assert_eq!(report.skipped, [], "{path}");
    Some(PreparedModel::new_skipping(model, &mut report).unwrap().1)
}

/// One closed edge of a face is two arcs of another one, whose images agree to 5e-14.
#[test]
fn bodies_with_closed_edges_are_closed() {
    for path in ["step/twist_curved.brep", "step/loft_shelled.brep"] {
        let Some(model) = prepared("bodies_with_closed_edges_are_closed", path) else { continue };
        let solid = model.solid();
        assert!(solid.closed, "{path}: {:?}", solid.free_edges);
    }
}

/// A cube of 1000 with an edge rounded by 1e-3: the loop of the fillet does not run around its cylinder.
#[test]
fn a_body_with_a_small_fillet_is_one() {
    let Some(model) = prepared("a_body_with_a_small_fillet_is_one", "step/small_fillet.step") else { return };
    assert!(model.gap() < 1e-9, "{:e}", model.gap());
    let solid = model.solid();
    assert!(solid.closed && solid.shells.len() == 1, "{:?}", solid.shells);
}

/// A prism whose wall is one patch that closes, about a small box.
#[test]
fn a_box_in_a_prism_of_one_wall_is_contained() {
    let files = ["step/closed_bezier_prism_5_0.0.step", "step/small_box.step"];
    let read = files.map(|path| prepared("a_box_in_a_prism_of_one_wall_is_contained", path));
    let [Some(prism), Some(small)] = read else { return };
    let found = Engine::cpu().clearance(&small, &prism, &Default::default()).wait().unwrap();
    assert!(matches!(found.overlap, Some(Overlap::Contained { .. })), "{found:?}");
}
