use super::super::measure_by;
use super::super::models::nets;
use nurbs_hausdorff::internals::engine::{Backend, DistanceOptions, Engine};
use nurbs_hausdorff::{HierarchyOptions, Method};

/// Method `hierarchy` on the GPU where B is a point. The truth is the largest
/// distance of a fine sampling of A from it, up to the sampling.
pub(crate) async fn hierarchy_point(engine: &Engine) {
    let [a, b] = nets!(hierarchy_point);
    let options = DistanceOptions {
        method: Method::Hierarchy(HierarchyOptions { grid: 48, ..Default::default() }),
        backend: Backend::Gpu,
        ..DistanceOptions::default()
    };
    let result = measure_by(engine, &a, &b, &options).await;
    assert!(result.lower <= 1.517_852 && 1.517_851 <= result.upper, "[{}, {}]", result.lower, result.upper);
}
