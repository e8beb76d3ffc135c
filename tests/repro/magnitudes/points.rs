use super::super::models::{bilinear, model};
use super::super::{assert_contains, assert_ends, budgeted, measure};
use nurbs_hausdorff::internals::engine::{DistanceOptions, Stop};

/// Two points: the models' diagonals are 0, and so is a relative tolerance.
pub(crate) async fn points() {
    let point = |x: f64, y: f64, z: f64| model(vec![bilinear([[x, y, z, 1.0]; 4])]);
    let [a, b] = [point(0.3, 0.2, 0.1), point(1.3, 0.6, 0.1)];
    let truth = 1.0_f64.hypot(0.4);
    assert_ends(&a, &b, Some(truth), "points").await;
    // No interval is 0 wide: the result says so, and which tolerance can be reached.
    let result = measure(&a, &b, &budgeted()).await;
    let details = result.certified().unwrap();
    assert_eq!((details.tolerance, details.stop, result.converged), (0.0, Stop::Precision, false));
    assert!(result.notice.unwrap().contains("single points"));
    let absolute = DistanceOptions { tolerance: Some(details.min_tolerance), ..budgeted() };
    let result = measure(&a, &b, &absolute).await;
    assert_contains(&result, truth, "points");
    assert!(result.converged && result.notice.is_none());
}
