use super::super::models::nets;
use super::super::{MAX_CELLS, budgeted, measure};
use nurbs_hausdorff::internals::engine::DistanceOptions;
use nurbs_hausdorff::{CertifiedOptions, Method};

/// Two cuts of one sheet; no bound holds across pieces that are cut elsewhere.
pub(crate) async fn split_copies() {
    let [a, b] = nets!(split_copies);
    let options = |tolerance| DistanceOptions {
        method: Method::Certified(CertifiedOptions {
            max_cells: Some(MAX_CELLS),
            max_seconds: Some(5.0),
            ..Default::default()
        }),
        relative_tolerance: Some(tolerance),
        ..budgeted()
    };
    let fine = measure(&a, &b, &options(1e-9)).await;
    let coarse = measure(&a, &b, &options(1e-4)).await;
    assert!(coarse.converged, "[{:e}, {:e}]", coarse.lower, coarse.upper);
    assert!(fine.lower <= coarse.upper && coarse.lower <= fine.upper, "{:e} {:e}", fine.lower, coarse.lower);
}
