use super::super::models::nets;
use super::super::{budgeted, measure, measure_by};
use nurbs_hausdorff::internals::engine::{Backend, DistanceOptions, Engine};

/// A patch of bidegree (5, 5) against the same with its numbers changed by 1e-4.
pub(crate) async fn gpu_deep() {
    let [a, b] = nets!(gpu_deep);
    let result = measure(&a, &b, &DistanceOptions { relative_tolerance: Some(1e-5), ..budgeted() }).await;
    assert!(result.converged, "[{}, {}]", result.lower, result.upper);
}

/// The same with kernels, which must not take cells 2^-25 of a patch wide: float32
/// does not hold them exactly.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) async fn gpu_deep_with_kernels(engine: &Engine) {
    let [a, b] = nets!(gpu_deep);
    let options = DistanceOptions { relative_tolerance: Some(1e-5), ..budgeted() };
    let on_cpu = measure(&a, &b, &options).await;
    let on_gpu = measure_by(engine, &a, &b, &DistanceOptions { backend: Backend::Gpu, ..options }).await;
    assert!(on_cpu.converged && on_gpu.converged, "[{}, {}]", on_gpu.lower, on_gpu.upper);
    assert!(on_cpu.lower <= on_gpu.upper && on_gpu.lower <= on_cpu.upper);
}
