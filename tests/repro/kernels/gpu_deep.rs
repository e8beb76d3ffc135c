use super::super::models::nets;
use super::super::{budgeted, measure};
use nurbs_hausdorff::internals::engine::DistanceOptions;

/// A patch of bidegree (5, 5) against the same with its numbers changed by 1e-4.
pub(crate) async fn gpu_deep() {
    let [a, b] = nets!(gpu_deep);
    let result = measure(&a, &b, &DistanceOptions { relative_tolerance: Some(1e-5), ..budgeted() }).await;
    assert!(result.converged, "[{}, {}]", result.lower, result.upper);
}
