//! What every result must satisfy.

use nurbs_hausdorff::{DistanceOptions, DistanceResult, Engine, Model, PreparedModel, Result};

/// The distance on the CPU.
pub fn distance(a: &Model, b: &Model, options: &DistanceOptions) -> Result<DistanceResult> {
    let [a, b] = [a, b].map(|model| PreparedModel::new(model).unwrap());
    let engine = Engine::cpu();
    engine.distance(&a, &b, options).wait()
}

/// Panics where a number of the result is NaN, the interval is empty, or the audit refuted a bound.
pub fn assert_numbers(result: &DistanceResult) {
    let DistanceResult { lower, upper, computed, diagonal, .. } = *result;
    assert!(0.0 <= lower && lower <= upper, "{result:?}");
    assert!(lower.is_finite() && !computed.is_nan() && !diagonal.is_nan(), "{result:?}");
    for end in [&result.witness.a, &result.witness.b] {
        let [x, y, z] = end.point;
        assert!([end.u, end.v, x, y, z].iter().all(|number| !number.is_nan()), "{result:?}");
    }
    if let Some(details) = result.certified() {
        assert!(details.tolerance >= 0.0, "{result:?}");
        assert!(details.audit.struck.is_empty(), "{result:?}");
    }
    for direction in [&result.forward, &result.reverse].into_iter().flatten() {
        assert_numbers(direction);
    }
}
