use super::super::models::nets;
use super::super::{budgeted, measure};
use nurbs_hausdorff::internals::engine::DistanceOptions;

/// Weight times coordinate is 1e170, whose square is beyond float64. The upper
/// end is from samples: no distance exceeds it.
pub(crate) async fn overflow() {
    let [a, b] = nets!(overflow);
    let options = DistanceOptions { relative_tolerance: Some(1e-4), ..budgeted() };
    let result = measure(&a, &b, &options).await;
    assert!(result.lower <= 6.575e68, "{:e}", result.lower);
    assert!(result.upper.is_finite() && result.upper >= result.lower, "{:e}", result.upper);
}
